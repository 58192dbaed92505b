"""A Qt model over the regions, doors or planes of a plan, and the filter and order above it."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, QSortFilterProxyModel, Qt
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
MOST_MEASURED = 300  # rows whose texts decide how wide a column is
LOCKABLE = ("plane", "door")


class ItemModel(QAbstractTableModel):
    """Rows are things of one kind; columns: eye, lock, then :data:`COLUMNS`."""

    def __init__(self, workbench: Workbench, kind: str, parent: Any = None) -> None:
        super().__init__(parent)
        self.kind, self.columns = kind, COLUMNS[kind]
        self._workbench = workbench
        self._things: tuple[Any, ...] = ()
        self._keys: dict[int, list[Any]] = {}  # by column
        self._words: list[str] = []  # by row

    def reload(self) -> None:
        """Another plan, other units or another theme."""
        self.beginResetModel()
        self._things = things(self._workbench.plan, self.kind)
        self._keys, self._words = {}, []
        self.endResetModel()

    def repaint_marks(self) -> None:
        """Eyes and locks changed."""
        for mark in (EYE, LOCK):
            self._keys.pop(mark, None)
        if self._things:
            self.dataChanged.emit(self.index(0, EYE), self.index(len(self._things) - 1, LOCK))

    def texts(self, column: Column) -> set[str]:
        """What stands in the first rows of a column, each text once."""
        units = self._workbench.view.look.units
        return {self._text(column, thing, units) for thing in self._things[:MOST_MEASURED]}

    def sort_keys(self, column: int) -> list[Any]:
        """What the rows are sorted by, made once: a sort compares each row a dozen times."""
        if column not in self._keys:
            self._keys[column] = (
                [self.index(r, column).data(SORT_ROLE) or False for r in range(len(self._things))]
                if column < OWN
                else [self.columns[column - OWN].key(thing) for thing in self._things]
            )
        return self._keys[column]

    def row_words(self, row: int) -> str:
        """All texts of a row, for the filter."""
        if not self._words:
            units = self._workbench.view.look.units
            texts = [[self._text(c, t, units) for c in self.columns] for t in self._things]
            self._words = [" ".join(cells).casefold() for cells in texts]
        return self._words[row]

    def item(self, row: int) -> Item:
        """What stands in ``row``."""
        return Item(self.kind, self._things[row].id)

    def row_of(self, item: Item | None) -> int:
        """The row of ``item``; -1 where it is not here."""
        if item is None or item.kind != self.kind:
            return -1
        return next((i for i, thing in enumerate(self._things) if thing.id == item.id), -1)

    # ---- Qt ---------------------------------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._things)

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
        return None

    def data(self, index: Index, role: int = int(Qt.ItemDataRole.DisplayRole)) -> Any:
        thing = self._things[index.row()]
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


class ItemFilter(QSortFilterProxyModel):
    """Rows that contain all typed words, in the order of the sorted column's keys."""

    def __init__(self, parent: Any = None) -> None:
        super().__init__(parent)
        self._typed: list[str] = []

    def set_text(self, text: str) -> None:
        """Show only rows with all words of ``text``."""
        self._typed = text.casefold().split()
        self.invalidate()

    def filterAcceptsRow(self, row: int, parent: Index) -> bool:
        if not self._typed:
            return True
        model = self.sourceModel()
        assert isinstance(model, ItemModel)
        words = model.row_words(row)
        return all(typed in words for typed in self._typed)

    def lessThan(self, left: Index, right: Index) -> bool:
        model = self.sourceModel()
        assert isinstance(model, ItemModel)
        keys = model.sort_keys(left.column())
        return bool(keys[left.row()] < keys[right.row()])


def _words(text: str) -> str:
    return tr(text) if text else ""


def _alignment(number: bool) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if number else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
