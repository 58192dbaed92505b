"""The storeys of a survey in the toolbar: which one is planned and shown. Hidden where there is one only."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QWidget

from floorcast_app.format import length
from floorcast_app.panels.base import listener_of
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench


class StoreyChooser(QComboBox):
    """One entry for each storey, the highest on top as in the building; data: its number."""

    refilled = Signal()  # it holds other words, and may be wider

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.setToolTip(tr("The storey that is shown; each keeps its own corrections and checks."))
        self.setAccessibleName(tr("Storey"))
        self.activated.connect(self._chosen)
        for event in (workbench.plan_changed, workbench.document.changed, workbench.view.changed):
            event.connect(listener_of(self, self._refresh, event))
        self._refresh()

    @property
    def wanted(self) -> bool:
        """True where there is something to choose."""
        return len(self._workbench.storeys) > 1

    def _refresh(self, *_: object) -> None:
        storeys, units = self._workbench.storeys, self._workbench.view.look.units
        texts = {s.number: self._text(s.number, s.floor_z - storeys[0].floor_z, units) for s in storeys}
        if [self.itemText(k) for k in range(self.count())] != list(texts.values())[::-1]:
            self.clear()
            for number in reversed(texts):
                self.addItem(texts[number], number)
            self.refilled.emit()
        self.setCurrentIndex(self.findData(self._workbench.state.storey))

    def _text(self, number: int, above: float, units: str) -> str:
        if number == 0:
            return tr("Storey 0")
        return tr("Storey {number}, {height} up").format(number=number, height=length(above, units))

    def _chosen(self, index: int) -> None:
        number = self.itemData(index)
        if number != self._workbench.state.storey:
            self._workbench.try_run("plan.storey", number=number)
        self._refresh()
