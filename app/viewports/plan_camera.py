"""The camera of a plan pane: which metres lie on which pixels; y is up in the plan. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.view_state import Look

Float = NDArray[np.float64]
Point = tuple[float, float]

NEAREST, FARTHEST = (
    0.2,
    5000.0,
)  # metres across: closer in there is nothing to see, farther out nothing is seen
STEP = 1.2  # zoom of one notch of the wheel


@dataclass(frozen=True)
class Camera:
    """Plan metres to pixels of one pane."""

    centre: Point  # metres, manhattan frame
    scale: float  # pixels for a metre
    width: float  # pixels
    height: float

    @staticmethod
    def of(look: Look, width: float, height: float) -> Camera:
        """The camera of ``look`` in a pane of this size."""
        return Camera(look.centre, max(min(width, height), 1.0) / look.span, width, height)

    @property
    def middle(self) -> Point:
        """Of the pane, pixels."""
        return self.width / 2, self.height / 2

    def point(self, x: float, y: float) -> Point:
        """One point, metres to pixels."""
        return (
            self.width / 2 + (x - self.centre[0]) * self.scale,
            self.height / 2 - (y - self.centre[1]) * self.scale,
        )

    def to_plan(self, x: float, y: float) -> Point:
        """Pixels to metres."""
        return (
            self.centre[0] + (x - self.width / 2) / self.scale,
            self.centre[1] - (y - self.height / 2) / self.scale,
        )

    @property
    def visible(self) -> tuple[float, float, float, float]:
        """x0, y0, x1, y1 that the pane shows, metres."""
        (x0, y1), (x1, y0) = self.to_plan(0, 0), self.to_plan(self.width, self.height)
        return x0, y0, x1, y1


def panned(look: Look, camera: Camera, dx: float, dy: float) -> dict[str, Point]:
    """Fields of the look after dragging the plan by pixels."""
    x, y = look.centre
    return {"centre": (x - dx / camera.scale, y + dy / camera.scale)}


def zoomed(look: Look, camera: Camera, factor: float, at: Point) -> dict[str, object]:
    """Fields of the look after zooming in by ``factor``; the metres at pixel ``at`` stay there."""
    span = min(max(look.span / factor, NEAREST), FARTHEST)
    share = span / look.span
    px, py = camera.to_plan(*at)
    x, y = look.centre
    return {"span": span, "centre": (px + (x - px) * share, py + (y - py) * share)}


def framed(bounds: tuple[float, float, float, float], margin: float) -> dict[str, object]:
    """Fields of the look that bring ``bounds`` into view in panes of any shape."""
    x0, y0, x1, y1 = bounds
    span = min(max(margin * max(x1 - x0, y1 - y0), NEAREST), FARTHEST)
    return {"centre": ((x0 + x1) / 2, (y0 + y1) / 2), "span": span}
