"""The paper's figure (a): layout planes from above, with the points that were observed."""

from __future__ import annotations

from floorcast_app.viewports.canvas import PlanCanvas


class PlanesView(PlanCanvas):
    """Red and green dotted planes, full where they were seen."""

    kinds = ("points", "trajectory", "planes")
    hits = ("plane",)
    dotted = True
    empty = "Layout planes appear here once a survey is planned."
