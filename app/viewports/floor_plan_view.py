"""The paper's figure (c): the floor plan, as it will be printed."""

from __future__ import annotations

from PySide6.QtCore import QTimer
from PySide6.QtGui import QPainter, QResizeEvent
from PySide6.QtWidgets import QWidget

from floorcast_app.actions.view_actions import fit
from floorcast_app.translation import tr, tr_text
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.viewports.listening import listen
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_overlay import paint_card
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
        listen(self, ((workbench.jobs.started, self._job_changed), (workbench.jobs.ended, self._job_changed)))

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

    def _paint_over(self, painter: QPainter, frame: Frame, interactive: bool) -> None:
        """Where there is no plan the reason stays to be read."""
        w = self.workbench
        if w.failure and w.plan is None and not w.jobs.running:
            paint_card(painter, frame, tr("No plan could be made"), tr_text(w.failure))
        else:
            super()._paint_over(painter, frame, interactive)

    def _job_changed(self, *_: object) -> None:
        self.update()

    def _fill(self) -> None:
        """A plan that was whole stays whole, as large as the pane has it."""
        if self.workbench.plan is not None and self.workbench.view.is_fitted:
            fit(self.workbench)
