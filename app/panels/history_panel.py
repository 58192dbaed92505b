"""All steps that were taken, the undone ones faint; a click goes there."""

from __future__ import annotations

from PySide6.QtGui import QColor
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from floorcast_app import icons, theme
from floorcast_app.panels.base import Panel, column
from floorcast_app.translation import tr_text
from floorcast_app.workbench import Workbench


class HistoryPanel(Panel):
    """The document's history, oldest first."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.list = QListWidget()
        self.list.setUniformItemSizes(True)
        self.list.itemClicked.connect(self._clicked)
        self.list.itemActivated.connect(self._clicked)
        column(self, 0, 0).addWidget(self.list)
        self.listen(workbench.document.saved_changed, theme.changed)
        self.refresh()

    def refresh(self) -> None:
        document = self.workbench.document
        self.list.clear()
        for i, step in enumerate(document.history):
            item = QListWidgetItem(tr_text(step.text))
            item.setIcon(self._icon(i))
            if i > document.position:
                item.setForeground(QColor(theme.colours().faint))
            font = item.font()
            font.setBold(i == document.position)
            item.setFont(font)
            self.list.addItem(item)
        self.list.setCurrentRow(document.position)
        self.list.scrollToItem(self.list.item(document.position))

    def _icon(self, i: int) -> object:
        holds, position = theme.colours(), self.workbench.document.position
        if i == position:
            return icons.icon("arrow-right", holds.accent)
        return icons.icon("check" if i < position else "redo-2", holds.muted if i < position else holds.faint)

    def _clicked(self, item: QListWidgetItem) -> None:
        position = self.list.row(item)
        if position != self.workbench.document.position:
            self.workbench.try_run("edit.history", position=position)
