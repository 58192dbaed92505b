"""What actions ask of a person and tell them, with Qt's dialogs."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID
from floorcast_app.translation import tr
from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow


BOX_WIDTH = 400  # px of a box that asks for a word


class QtInterface:
    """Dialogs above the main window."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        self._shows: dict[str, Callable[..., Any]] = {
            "picture": window.save_picture,
            "copy_picture": window.copy_picture,
            "pane": window.show_pane,
            "quit": window.close,
        }

    def ask_open(self, title: str, filters: str) -> Path | None:
        self._needs_somebody(title)
        if filters == "folder":
            chosen = QFileDialog.getExistingDirectory(self._window, tr(title))
        else:
            chosen, _ = QFileDialog.getOpenFileName(self._window, tr(title), "", open_filters())
        return Path(chosen) if chosen else None

    def ask_save(self, title: str, filters: str, suggested: str) -> Path | None:
        self._needs_somebody(title)
        patterns = export_filters() if filters == "export" else filters
        chosen, used = QFileDialog.getSaveFileName(
            self._window, tr(title), suggested, patterns, _filter_of(suggested, patterns)
        )
        return _with_suffix(Path(chosen), used) if chosen else None

    def ask_text(self, title: str, label: str, text: str) -> str | None:
        self._needs_somebody(title)
        box = QInputDialog(self._window)
        box.setWindowTitle(tr(title))
        box.setLabelText(tr(label))
        box.setTextValue(text)
        box.resize(BOX_WIDTH, box.sizeHint().height())
        layout = box.layout()
        if layout is not None:
            layout.setContentsMargins(3 * GRID, 2 * GRID, 3 * GRID, 2 * GRID)
        return box.textValue() if box.exec() else None

    def ask_yes(self, text: str, detail: str) -> bool:
        if self._window.unattended:
            return True
        box = QMessageBox(self._window)
        box.setIconPixmap(icons.pixmap("triangle-alert", 32, theme.colours().warning))
        box.setText(tr(text))
        box.setInformativeText(tr(detail))
        box.setStandardButtons(QMessageBox.StandardButton.Discard | QMessageBox.StandardButton.Cancel)
        box.setDefaultButton(QMessageBox.StandardButton.Cancel)
        return bool(box.exec() == QMessageBox.StandardButton.Discard)

    def _needs_somebody(self, title: str) -> None:
        """A script would wait for ever for an answer."""
        if self._window.unattended:
            raise UsageError(f"{title}: give it as an argument; a script has nobody to ask.")

    def tell(self, text: str, kind: str = "info") -> None:
        self._window.tell(text, kind)

    def show(self, what: str, **arguments: Any) -> Any:
        """A picture, the end, or the dialog ``floorcast_app.dialogs.<what>`` (its function ``show``)."""
        if what in self._shows:
            return self._shows[what](**arguments)
        try:
            module = import_module(f"floorcast_app.dialogs.{what}")
        except ModuleNotFoundError as error:
            raise UsageError(f"There is no dialog {what!r}.") from error
        return module.show(self._window, **arguments)


def open_filters() -> str:
    """Everything that the readers know, as a file dialog has it."""
    from floorplan_core.plugins import default_registry

    suffixes = {s for reader in default_registry().readers for s in reader.suffixes}
    suffixes |= {".floorcast", ".png", ".pgm", ".yaml"}
    patterns = " ".join(f"*{s}" for s in sorted(suffixes))
    return f"{tr('Surveys and projects')} ({patterns});;{tr('All files')} (*)"


def export_filters() -> str:
    """Everything that the exporters write."""
    from floorplan_core.plugins import default_registry

    return ";;".join(
        f"{e.name} ({' '.join(f'*{s}' for s in e.suffixes)})" for e in default_registry().exporters
    )


def _filter_of(name: str, patterns: str) -> str:
    """The pattern that a file of this name belongs to: the dialog begins with it."""
    suffix = Path(name).suffix
    return next((p for p in patterns.split(";;") if suffix and suffix in _suffixes(p)), "")


def _with_suffix(path: Path, pattern: str) -> Path:
    """A name that was typed without a suffix gets that of the pattern that was chosen."""
    suffixes = _suffixes(pattern)
    return path if path.suffix or not suffixes else path.with_name(f"{path.name}{suffixes[0]}")


def _suffixes(pattern: str) -> list[str]:
    return re.findall(r"\*(\.[\w.]+)", pattern)
