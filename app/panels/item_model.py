"""A Qt model over the regions, doors or planes of a plan, in an order and through a filter of its own.

No proxy of Qt above it: that asks Python for every comparison, 0.1 s for a sort of 1,000 planes.
"""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor

from floorcast_app import icons, theme
from floorcast_app.panels.by_hand import by_hand, hand_note, is_locked, machine_note
from floorcast_app.panels.item_columns import COLUMNS, CORRECTION, Column, things
from floorcast_app.selection import Item
from floorcast_app.translation import tr, tr_text
from floorcast_app.workbench import Workbench

Index = QModelIndex | QPersistentModelIndex
EYE, LOCK = 0, 1  # columns before those of item_columns
OWN = 2
SORT_ROLE = int(Qt.ItemDataRole.UserRole)
ITEM_ROLE = SORT_ROLE + 1
MOST_MEASURED = 120  # rows, evenly spread, whose texts decide how wide a column is
LOCKABLE = ("plane", "door")


class ItemModel(QAbstractTableModel):
    """Rows are things of one kind; columns: eye, lock, then :data:`COLUMNS`."""

    def __init__(self, workbench: Workbench, kind: str, parent: Any = None) -> None:
        super().__init__(parent)
        self.kind, self.columns = kind, COLUMNS[kind]
        self._workbench = workbench
        self._things: tuple[Any, ...] = ()
        self._keys: dict[int, list[Any]] = {}  # by column, of each thing
        self._words: list[str] = []  # of each thing
        self._typed: list[str] = []  # words of which every row has all
        self._sorted = (OWN, Qt.SortOrder.AscendingOrder)
        self._rows: list[int] = []  # the thing in each row
        self._row_of: dict[str, int] = {}  # the row of each thing that is shown, by id

    def reload(self) -> None:
        """Another plan, other units or another theme."""
        self._things = things(self._workbench.plan, self.kind)
        self._keys, self._words = {}, []
        self._arrange()

    def set_filter(self, text: str) -> None:
        """Show only rows with all words of ``text``."""
        self._typed = text.casefold().split()
        self._arrange()

    def sort(self, column: int, order: Qt.SortOrder = Qt.SortOrder.AscendingOrder) -> None:
        """Qt's: the header was clicked. Among equal rows the plan's order stays."""
        self._sorted = (column, order)
        self._arrange()

    def repaint_marks(self) -> None:
        """Eyes and locks changed."""
        for mark in (EYE, LOCK):
            self._keys.pop(mark, None)
        if self._sorted[0] in (EYE, LOCK):
            self._arrange()
        elif self._rows:
            self.dataChanged.emit(self.index(0, EYE), self.index(len(self._rows) - 1, LOCK))

    def _arrange(self) -> None:
        """Take up the rows that pass the filter, in their order."""
        column, order = self._sorted
        keys = self._sort_keys(column)
        passing = [n for n in range(len(self._things)) if self._passes(n)]
        self.beginResetModel()
        self._rows = sorted(passing, key=keys.__getitem__, reverse=order == Qt.SortOrder.DescendingOrder)
        self._row_of = {self._things[n].id: row for row, n in enumerate(self._rows)}
        self.endResetModel()

    def texts(self, column: Column) -> set[str]:
        """What stands in some rows of a column, each text once."""
        units, step = self._workbench.view.look.units, 1 + len(self._things) // MOST_MEASURED
        return {self._text(column, thing, units) for thing in self._things[::step]}

    def _sort_keys(self, column: int) -> list[Any]:
        """What the things are sorted by, made once."""
        if column not in self._keys:
            self._keys[column] = (
                [self._mark(thing, column, SORT_ROLE) or False for thing in self._things]
                if column < OWN
                else [self.columns[column - OWN].key(thing) for thing in self._things]
            )
        return self._keys[column]

    def _passes(self, number: int) -> bool:
        """True where the texts of a thing hold all words that were typed."""
        if self._typed and not self._words:
            units = self._workbench.view.look.units
            texts = [[self._text(c, t, units) for c in self.columns] for t in self._things]
            self._words = [" ".join(cells).casefold() for cells in texts]
        return all(typed in self._words[number] for typed in self._typed)

    def item(self, row: int) -> Item:
        """What stands in ``row``."""
        return Item(self.kind, self._things[self._rows[row]].id)

    def row_of(self, item: Item | None) -> int:
        """The row of ``item``; -1 where it is not shown."""
        return -1 if item is None or item.kind != self.kind else self._row_of.get(item.id, -1)

    # ---- Qt ---------------------------------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else OWN + len(self.columns)

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = int(Qt.ItemDataRole.DisplayRole)
    ) -> Any:
        if orientation != Qt.Orientation.Horizontal or section < OWN:
            return None
        column = self.columns[section - OWN]
        if role == Qt.ItemDataRole.DisplayRole:
            return tr(column.title)
        if role == Qt.ItemDataRole.ToolTipRole and column.tip:
            return tr(column.tip)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(column.number)
        if role == Qt.ItemDataRole.FontRole and column.number:
            return theme.font(figures=True)
        return None

    def data(self, index: Index, role: int = int(Qt.ItemDataRole.DisplayRole)) -> Any:
        thing = self._things[self._rows[index.row()]]
        if role == ITEM_ROLE:
            return Item(self.kind, thing.id)
        if index.column() < OWN:
            return self._mark(thing, index.column(), role)
        column = self.columns[index.column() - OWN]
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(column, thing, self._workbench.view.look.units)
        if role == SORT_ROLE:
            return column.key(thing)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(column.number)
        if role == Qt.ItemDataRole.FontRole and column.number:
            return theme.font(figures=True)
        if index.column() == OWN:
            return self._first(thing, role)
        if role == Qt.ItemDataRole.ForegroundRole and getattr(thing, "speculated", False):
            return QColor(theme.colours().muted)
        return None

    def _text(self, column: Column, thing: Any, units: str) -> str:
        text = column.text(thing, units, _words)
        if column is not CORRECTION or not text:
            return text
        machine = machine_note(self._workbench, Item(self.kind, thing.id), tr_text)
        return f"{text}. {machine}" if machine else text

    def _first(self, thing: Any, role: int) -> Any:
        """The first own column carries the pin of what a person corrected."""
        if not by_hand(thing):
            return None
        if role == Qt.ItemDataRole.DecorationRole:
            return icons.icon("pin", theme.colours().accent)
        if role == Qt.ItemDataRole.ToolTipRole:
            note = hand_note(thing, tr)
            machine = machine_note(self._workbench, Item(self.kind, thing.id), tr_text)
            return "\n".join(filter(None, (note, machine)))
        return None

    def _mark(self, thing: Any, column: int, role: int) -> Any:
        holds = theme.colours()
        if column == EYE:
            shut = (self.kind, thing.id) in self._workbench.view.look.hidden
            if role == Qt.ItemDataRole.DecorationRole:
                return icons.icon("eye-off" if shut else "eye", holds.faint if shut else holds.muted)
            if role == Qt.ItemDataRole.ToolTipRole:
                return tr("Show it in the panes") if shut else tr("Hide it in the panes")
            return shut if role == SORT_ROLE else None
        if self.kind not in LOCKABLE:
            return None
        locked = is_locked(thing)
        if role == Qt.ItemDataRole.DecorationRole:
            return icons.icon(
                "lock" if locked else "lock-open", holds.accent if locked else holds.line_strong
            )
        if role == Qt.ItemDataRole.ToolTipRole:
            return (
                tr("Kept whatever the machine finds") if locked else tr("Keep it whatever the machine finds")
            )
        return locked if role == SORT_ROLE else None


def _words(text: str) -> str:
    return tr(text) if text else ""


def _alignment(number: bool) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if number else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
