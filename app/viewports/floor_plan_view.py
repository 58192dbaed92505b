"""The paper's figure (c): the floor plan, as it will be printed."""

from __future__ import annotations

from PySide6.QtGui import QResizeEvent

from floorcast_app.viewports.canvas import PlanCanvas


class FloorPlanView(PlanCanvas):
    """Walls, rooms, corridors, doors, names, areas and dimensions; pins on what was corrected."""

    kinds = ("regions", "walls", "doors", "names", "dimensions")
    pins = True
    empty = "The floor plan appears here once a survey is planned."

    def resizeEvent(self, event: QResizeEvent) -> None:
        """What fits is fitted to this pane: its dimensions need room."""
        super().resizeEvent(event)
        self.workbench.view.room = (float(self.width()), float(self.height()))
