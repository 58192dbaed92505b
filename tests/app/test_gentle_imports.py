"""An import in a thread rests before each module; one in the main thread does not."""

from __future__ import annotations

import sys
import threading

import pytest

from floorcast_app import gentle_imports
from floorcast_app.gentle_imports import GentleImports, import_gently


def test_only_other_threads_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    rests: list[float] = []
    monkeypatch.setattr(gentle_imports.time, "sleep", rests.append)
    finder = GentleImports()
    assert finder.find_spec("anything", None) is None
    assert rests == []
    thread = threading.Thread(target=finder.find_spec, args=("anything", None))
    thread.start()
    thread.join()
    assert rests == [gentle_imports.REST]


def test_it_is_asked_first_and_there_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "meta_path", [f for f in sys.meta_path if not isinstance(f, GentleImports)])
    import_gently()
    import_gently()
    assert [isinstance(finder, GentleImports) for finder in sys.meta_path].count(True) == 1
    assert isinstance(sys.meta_path[0], GentleImports)
