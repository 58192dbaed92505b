"""A Qt model over the ground-truth table; the laser meter's column can be typed into."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QColor

from floorcast_app import theme
from floorcast_app.actions.measure_actions import CheckRow, check_rows
from floorcast_app.format import DASH, length, parse_length, small
from floorcast_app.selection import Item
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench

Index = QModelIndex | QPersistentModelIndex
ID, PLAN, LASER, DIFFERENCE, PERCENT, BAND, NOTE = range(7)
TITLES = ("Check", "From plan", "Laser meter", "Δ", "%", "LOA", "Note")
TIPS = (
    "",
    "Distance between the two points on the plan",
    "What the laser meter said: double-click and type, like 3.2, 320 cm or 10' 6\"",
    "Plan less laser meter",
    "Of the measured length",
    "Level of accuracy (USIBD) that the difference meets",
    "",
)
NUMBERS = (PLAN, LASER, DIFFERENCE, PERCENT)
POOR_PERCENT = 5.0  # a difference beyond this is shown in the colour of a warning


class CheckModel(QAbstractTableModel):
    """Rows in the order in which they were measured."""

    def __init__(self, workbench: Workbench, parent: Any = None) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._rows: tuple[CheckRow, ...] = ()
        self.reload()

    def reload(self) -> None:
        """Another document, plan or unit."""
        self.beginResetModel()
        to_plan = self._workbench.to_plan if self._workbench.plan is not None else None
        self._rows = check_rows(self._workbench.state.checks, to_plan)
        self.endResetModel()

    def item(self, row: int) -> Item:
        """The check in ``row``."""
        return Item("check", self._rows[row].id)

    def row_of(self, item: Item) -> int:
        """The row of a check; -1 where it is not here."""
        return next((i for i, r in enumerate(self._rows) if Item("check", r.id) == item), -1)

    # ---- Qt ---------------------------------------------------------------------------------------------

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(TITLES)

    def headerData(
        self, section: int, orientation: Qt.Orientation, role: int = int(Qt.ItemDataRole.DisplayRole)
    ) -> Any:
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return tr(TITLES[section])
        if role == Qt.ItemDataRole.ToolTipRole and TIPS[section]:
            return tr(TIPS[section])
        return _alignment(section) if role == Qt.ItemDataRole.TextAlignmentRole else None

    def data(self, index: Index, role: int = int(Qt.ItemDataRole.DisplayRole)) -> Any:
        row, column = self._rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(row, column)
        if role == Qt.ItemDataRole.EditRole:
            return self._edited_text(row, column)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _alignment(column)
        if role == Qt.ItemDataRole.FontRole and column in NUMBERS:
            return theme.font(figures=True)
        if role == Qt.ItemDataRole.ForegroundRole:
            return self._colour(row, column)
        return None

    def flags(self, index: Index) -> Qt.ItemFlag:
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.column() in (LASER, NOTE) else flags

    def setData(self, index: Index, value: Any, role: int = int(Qt.ItemDataRole.EditRole)) -> bool:
        row, text = self._rows[index.row()], str(value).strip()
        if role != Qt.ItemDataRole.EditRole:
            return False
        if index.column() == NOTE:
            self._workbench.try_run("measure.set", id=row.id, metres=row.measured, note=text)
            return True
        metres = parse_length(text) if text else None
        if text and metres is None:
            self._workbench.ui.tell(f"{text} is no length; type one like 3.2, 320 cm or 10' 6\".", "error")
            return False
        self._workbench.try_run("measure.set", id=row.id, metres=metres)
        return True

    # ---- inside -----------------------------------------------------------------------------------------

    def _text(self, row: CheckRow, column: int) -> str:
        units = self._workbench.view.look.units
        if column == LASER and row.measured is None:
            return tr("type it here")
        percent = DASH if row.percent is None else f"{row.percent:+.2f} %"
        difference = DASH if row.difference is None else small(row.difference, units)
        texts = (
            row.id,
            length(row.plan, units),
            length(row.measured, units),
            difference,
            percent,
            row.band.replace("none", DASH),
            row.note,
        )
        return texts[column]

    def _edited_text(self, row: CheckRow, column: int) -> str:
        if column == NOTE:
            return row.note
        units = self._workbench.view.look.units
        return "" if row.measured is None else length(row.measured, units).removesuffix(" m")

    def _colour(self, row: CheckRow, column: int) -> QColor | None:
        holds = theme.colours()
        if column == LASER and row.measured is None:
            return QColor(holds.faint)
        if column in (DIFFERENCE, PERCENT) and row.percent is not None and abs(row.percent) > POOR_PERCENT:
            return QColor(holds.warning)
        return None


def _alignment(column: int) -> Qt.AlignmentFlag:
    side = Qt.AlignmentFlag.AlignRight if column in NUMBERS else Qt.AlignmentFlag.AlignLeft
    return side | Qt.AlignmentFlag.AlignVCenter
