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
LONGEST_KEYS = 18  # characters of a shortcut that stands beside what it does
KEYS_WIDTH = 128  # px
WIDTH = 1040  # px of the sheet
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
        for title, rows in sorted(groups(workbench), key=lambda g: -_height(g[1])):
            at = heights.index(min(heights))
            heights[at] += _height(rows)
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
        self._inner, self._area = inner, scrolling(inner)
        self.body.addWidget(self._area, 1)
        self.add_close(tr("Close"))

    def open_over(self, parent: QWidget) -> None:
        self.ensurePolished()
        around = self.sizeHint().height() - self._area.sizeHint().height()
        tall = self._inner.sizeHint().height() + around
        self.setMinimumSize(WIDTH, min(tall, parent.height() - 8 * GRID))
        super().open_over(parent)


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
    long = _long(rows)
    for i, (keys, what) in enumerate(rows):
        below = (2 * i + 1, 0) if long else (i, 1)
        grid.addLayout(_keys(keys), 2 * i if long else i, 0, Qt.AlignmentFlag.AlignTop)
        grid.addWidget(label(what, "small" if long else "", wrap=True), *below, Qt.AlignmentFlag.AlignTop)
    grid.setColumnStretch(0 if long else 1, 1)
    if not long:
        grid.setColumnMinimumWidth(0, KEYS_WIDTH)  # groups above each other line up
    layout.addLayout(grid)
    return holder


def _long(rows: list[tuple[str, str]]) -> bool:
    """True for gestures, which are words: what they do stands below them."""
    return max(len(max(keys.split(" | "), key=len)) for keys, _ in rows) > LONGEST_KEYS


def _height(rows: list[tuple[str, str]]) -> int:
    """Lines that a group takes: the largest are laid out first."""
    return len(rows) * (2 if _long(rows) else 1) + 2


def _keys(keys: str) -> QHBoxLayout:
    form = QKeySequence.SequenceFormat.NativeText
    shown = [QKeySequence(k).toString(form) or k for k in keys.split(" | ")]
    line = row(*(label(k, "key") for k in shown), gap=4)
    line.addStretch(1)
    return line
