"""All shortcuts and gestures on one sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QVBoxLayout, QWidget

from floorcast_app.dialogs.base import Dialog
from floorcast_app.dialogs.palette import MENU_WORDS
from floorcast_app.panels.base import GRID, label, row, scrolling
from floorcast_app.translation import tr, tr_action
from floorcast_app.workbench import Workbench

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

COLUMNS = 3
GESTURES = (
    ("Click", "Select; with Ctrl add to the selection"),
    ("Double click", "Bring it into view"),
    ("Wheel", "Zoom to the pointer"),
    ("Middle or right drag", "Pan"),
    ("Left drag in 3D", "Orbit"),
    ("Drag a selected wall", "Move it; it snaps to evidence"),
    ("Drag the end of a selected door", "Resize it"),
    ("Right click", "What can be done with it"),
    ("Esc", "Cancel the work, then the gesture, then the selection"),
)


class ShortcutsSheet(Dialog):
    """Groups by menu."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(tr("Shortcuts"), parent)
        columns = [QVBoxLayout() for _ in range(COLUMNS)]
        heights = [0] * COLUMNS
        for title, rows in groups(workbench):
            at = heights.index(min(heights))
            heights[at] += len(rows) + 2
            columns[at].addWidget(_group(title, rows))
        inner = QWidget()
        line = QHBoxLayout(inner)
        line.setContentsMargins(0, 0, GRID, 0)
        line.setSpacing(4 * GRID)
        for layout in columns:
            layout.setSpacing(2 * GRID)
            layout.addStretch(1)
            line.addLayout(layout, 1)
        self.body.addWidget(label(tr("Shortcuts and gestures"), "heading"))
        self.body.addWidget(scrolling(inner), 1)
        self.add_close(tr("Close"))
        self.resize(980, 620)

    def open_over(self, parent: QWidget) -> None:
        size = self.size()
        super().open_over(parent)
        self.resize(size)


def groups(workbench: Workbench) -> list[tuple[str, list[tuple[str, str]]]]:
    """(title, [(keys, what they do)]) of every menu that has shortcuts, and of the gestures."""
    out: list[tuple[str, list[tuple[str, str]]]] = []
    for menu, word in MENU_WORDS.items():
        actions = [a for a in workbench.actions if a.shortcut and a.id.startswith(f"{menu}.")]
        rows = [(a.shortcut, tr_action(a)[0].rstrip("…")) for a in actions]
        if rows:
            out.append((tr(word), rows))
    out.append((tr("Mouse"), [(tr(keys), tr(what)) for keys, what in GESTURES]))
    return out


def show(window: MainWindow) -> ShortcutsSheet:
    """Open the sheet."""
    sheet = ShortcutsSheet(window.workbench, window)
    sheet.open_over(window)
    return sheet


def _group(title: str, rows: list[tuple[str, str]]) -> QWidget:
    holder = QWidget()
    layout = QVBoxLayout(holder)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(GRID)
    layout.addWidget(label(title, "section"))
    grid = QGridLayout()
    grid.setHorizontalSpacing(2 * GRID)
    grid.setVerticalSpacing(6)
    grid.setColumnStretch(1, 1)
    for i, (keys, what) in enumerate(rows):
        grid.addLayout(_keys(keys), i, 0, Qt.AlignmentFlag.AlignTop)
        grid.addWidget(label(what, wrap=True), i, 1, Qt.AlignmentFlag.AlignTop)
    layout.addLayout(grid)
    return holder


def _keys(keys: str) -> QHBoxLayout:
    form = QKeySequence.SequenceFormat.NativeText
    shown = [QKeySequence(k).toString(form) or k for k in keys.split(" | ")]
    line = row(*(label(k, "key") for k in shown), gap=4)
    line.addStretch(1)
    return line
