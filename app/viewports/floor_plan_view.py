"""The paper's figure (c): the floor plan, as it will be printed."""

from __future__ import annotations

from PySide6.QtCore import QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from floorcast_app.actions.view_actions import fit
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.workbench import Workbench

REFIT = 60  # ms that the size must rest before a plan that filled the pane fills it again


class FloorPlanView(PlanCanvas):
    """Walls, rooms, corridors, doors, names, areas and dimensions; pins on what was corrected."""

    kinds = ("regions", "walls", "doors", "names", "dimensions")
    pins = True
    empty = "The floor plan appears here once a survey is planned."

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self._refit = QTimer(self, singleShot=True, interval=REFIT)
        self._refit.timeout.connect(self._fill)

    @property
    def ready(self) -> bool:
        """Not while the plan is about to be fitted to another size."""
        return super().ready and not self._refit.isActive()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """What fits is fitted to this pane: its dimensions need room."""
        super().resizeEvent(event)
        self.workbench.view.room = (float(self.width()), float(self.height()))
        if self.workbench.view.is_fitted:
            self._refit.start()

    def _fill(self) -> None:
        """A plan that was whole stays whole, as large as the pane has it."""
        if self.workbench.plan is not None and self.workbench.view.is_fitted:
            fit(self.workbench)
