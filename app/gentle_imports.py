"""Modules that a thread imports leave room for the window. No Qt.

An import asks the file system thousands of small questions. Each lets go of the interpreter lock for
microseconds, too short for the window's thread to take it, yet every time its wait begins anew: a thread that
imports scipy held the window up for 0.2 s. So a thread rests for a moment before each module.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

REST = 0.001  # s: long enough for a thread that waits for the lock to take it


class GentleImports(MetaPathFinder):
    """Finds nothing, and rests before it says so, except in the main thread."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """None: others know where modules are."""
        if threading.current_thread() is not threading.main_thread():
            time.sleep(REST)
        return None


def import_gently() -> None:
    """From now on; nothing happens the second time."""
    if not any(isinstance(finder, GentleImports) for finder in sys.meta_path):
        sys.meta_path.insert(0, GentleImports())
