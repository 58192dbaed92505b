"""The files that were opened lately, newest first, with a thumbnail of the plan where there is one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QSettings

MOST = 8


class RecentFiles:
    """Kept in the user's settings."""

    def __init__(self, settings: QSettings, most: Callable[[], int] = lambda: MOST) -> None:
        """``most`` says how many are kept."""
        self._settings, self._most = settings, most

    def paths(self) -> list[Path]:
        """Those that still exist, newest first."""
        kept = self._settings.value("recent/paths", [])
        names = [kept] if isinstance(kept, str) else list(kept or [])
        return [Path(name) for name in names if Path(name).exists()][: self._most()]

    def put(self, path: Path) -> None:
        """Make ``path`` the newest."""
        path = Path(path).resolve()
        rest = [p for p in self.paths() if p != path]
        self._settings.setValue("recent/paths", [str(p) for p in [path, *rest][: self._most()]])
