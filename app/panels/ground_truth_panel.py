"""The ground-truth table of the paper: what the plan says, what a laser meter said, and the means."""

from __future__ import annotations

from PySide6.QtCore import QItemSelectionModel, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractItemView, QPushButton, QTableView, QWidget

from floorcast_app import icons, theme
from floorcast_app.actions.measure_actions import check_means, check_rows
from floorcast_app.format import number, small
from floorcast_app.panels.base import GRID, Panel, column, label, row
from floorcast_app.panels.check_model import CheckModel
from floorcast_app.panels.items_panel import ROW_HEIGHT
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench


class GroundTruthPanel(Panel):
    """Rows are made with the measure tool; what the laser meter said is typed in."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.model = CheckModel(workbench, self)
        self.table = QTableView()
        self.table.setModel(self.model)
        self._dress()
        self.hint = label(
            tr("Measure a distance on the plan; then type here what the laser meter said."), "muted", True
        )
        self.hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.means = label("", "")
        self.measure = QPushButton(tr("Measure"))
        icons.set_icon(self.measure, "ruler")
        self.measure.clicked.connect(lambda: workbench.try_run("tool.measure"))
        self.export = QPushButton(tr("Export CSV…"))
        icons.set_icon(self.export, "download")
        self.export.clicked.connect(lambda: workbench.try_run("measure.export"))
        foot = row(self.means)
        foot.addStretch(1)
        for button in (self.measure, self.export):
            foot.addWidget(button)
        foot.setContentsMargins(2 * GRID, 6, GRID, 6)
        layout = column(self, 0, 0)
        layout.addWidget(self.table, 1)
        layout.addWidget(self.hint, 1)
        layout.addLayout(foot)
        self._following = False
        self.table.selectionModel().selectionChanged.connect(self._picked)
        self.table.doubleClicked.connect(self._double_clicked)
        delete = QShortcut(QKeySequence(Qt.Key.Key_Delete), self.table)
        delete.setContext(Qt.ShortcutContext.WidgetShortcut)
        delete.activated.connect(lambda: workbench.try_run("measure.remove"))
        self.listen(workbench.document.changed, workbench.plan_changed, workbench.view.changed, theme.changed)
        self.listen(workbench.selection.changed, then=self._follow)
        self.refresh()

    def refresh(self) -> None:
        if self.table.state() == QAbstractItemView.State.EditingState:
            self.refresh_soon_after_editing()
            return
        workbench = self.workbench
        self.model.reload()
        self.table.resizeColumnsToContents()
        rows = bool(workbench.state.checks)
        self.table.setVisible(rows)
        self.hint.setVisible(not rows)
        self.export.setEnabled(rows)
        self.measure.setEnabled(workbench.plan is not None)
        self.means.setText(self._means())
        self._follow()

    def refresh_soon_after_editing(self) -> None:
        """A cell is being typed into: it must not be pulled away."""
        self._soon.start(200)

    # ---- inside -----------------------------------------------------------------------------------------

    def _dress(self) -> None:
        table = self.table
        table.setAlternatingRowColors(True)
        table.setShowGrid(False)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.EditKeyPressed
            | QAbstractItemView.EditTrigger.AnyKeyPressed
        )
        table.verticalHeader().hide()
        table.verticalHeader().setDefaultSectionSize(ROW_HEIGHT)
        table.horizontalHeader().setHighlightSections(False)
        table.horizontalHeader().setStretchLastSection(True)

    def _means(self) -> str:
        means = check_means(check_rows(self.workbench.state.checks))
        if means is None:
            return ""
        units = self.workbench.view.look.units
        text = tr("Mean of {n}: {error} · {percent} %").format(
            n=means.count, error=small(means.mean_error, units), percent=number(means.mean_percent, ".2f")
        )
        if means.band == "none":
            return f"{text} · {tr('worse than every LOA band')}"
        return f"{text} · {tr('95 % within {band}').format(band=means.band)}"

    def _picked(self) -> None:
        if self._following:
            return
        chosen = [self.model.item(i.row()) for i in self.table.selectionModel().selectedRows()]
        self._following = True
        self.workbench.selection.select_all(chosen)
        self._following = False

    def _follow(self) -> None:
        if self._following:
            return
        self._following = True
        model, flags = self.table.selectionModel(), QItemSelectionModel.SelectionFlag
        model.clearSelection()
        for item in self.workbench.selection.items:
            at = self.model.row_of(item)
            if at >= 0:
                model.select(self.model.index(at, 0), flags.Select | flags.Rows)
                self.table.scrollTo(self.model.index(at, 0))
        self._following = False

    def _double_clicked(self, index: object) -> None:
        if not self.model.flags(index) & Qt.ItemFlag.ItemIsEditable:  # type: ignore[arg-type]
            self.workbench.selection.zoom_asked.emit(self.model.item(index.row()))  # type: ignore[attr-defined]
