"""Why there is no plan, what was assumed of the file, and what the plan warns of."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QGuiApplication, QKeySequence, QShortcut
from PySide6.QtWidgets import QLabel, QListWidget, QListWidgetItem, QWidget

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID, Panel, column, label, retitle
from floorcast_app.translation import tr, tr_text
from floorcast_app.workbench import Workbench


class WarningsPanel(Panel):
    """One sentence a line; the dock's title says how many."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.list = QListWidget()
        self.list.setWordWrap(True)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setResizeMode(QListWidget.ResizeMode.Adjust)
        self.list.setIconSize(QSize(16, 16))
        self.nothing: QLabel = label(tr("Nothing to warn of."), "muted")
        self.nothing.setContentsMargins(2 * GRID, 2 * GRID, 0, 0)
        layout = column(self, 0, 0)
        layout.addWidget(self.nothing)
        layout.addWidget(self.list)
        copy = QShortcut(QKeySequence.StandardKey.Copy, self.list)
        copy.activated.connect(self._copy)
        events = (workbench.jobs.ended, workbench.jobs.warned, workbench.survey_changed, theme.changed)
        self.listen(workbench.plan_changed, *events)
        self.refresh()

    def refresh(self) -> None:
        holds = theme.colours()
        self.list.clear()
        if failure := self.workbench.failure:
            self.list.addItem(QListWidgetItem(icons.icon("circle-alert", holds.error), tr_text(failure)))
        for text in self.workbench.assumptions if self.workbench.state.survey else ():
            self.list.addItem(QListWidgetItem(icons.icon("info", holds.muted), tr_text(text)))
        for text in self.workbench.warnings:
            self.list.addItem(QListWidgetItem(icons.icon("triangle-alert", holds.warning), tr_text(text)))
        self.list.setVisible(self.list.count() > 0)
        self.nothing.setVisible(self.list.count() == 0)
        count = len(self.workbench.warnings) + bool(failure)
        retitle(self, tr("Warnings ({n})").format(n=count) if count else tr("Warnings"))

    def _copy(self) -> None:
        rows = self.list.selectedItems() or [self.list.item(i) for i in range(self.list.count())]
        QGuiApplication.clipboard().setText("\n".join(item.text() for item in rows))
