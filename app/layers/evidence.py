"""Why there is a door, or none: the three signals of the paper along one plane, and the doors in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.selection import Item
from floorplan_core.model import Door, Facing, FloorPlan, LayoutPlane
from floorplan_core.model.layout import turned
from floorplan_core.stages.door_apertures import door_response

Float = NDArray[np.float64]

SMOOTH = 7  # bins over which what was seen above 2 m is averaged


@dataclass(frozen=True)
class EvidenceLayer:
    """The signals along a plane; all arrays (B,)."""

    plane: str  # id
    facing: Facing
    offset: float  # metres along the facing's axis
    turn: float  # radians from the plan's axes to those of the plane
    at: Float  # metres along the plane, middles of the bins
    step: float  # metres, width of a bin
    histogram: Float  # 0 to 1
    gradient: Float
    response: Float
    lintel: Float  # 0 to 1: surface seen above 2 m, smoothed, as a share of the most that was seen
    threshold: float  # of the response
    doors: tuple[Door, ...]  # cut into the plane
    faces: tuple[str, ...]  # planes that show the same door, this one among them

    @property
    def start(self) -> float:
        """Metres along the plane where the signals begin."""
        return float(self.at[0]) - self.step / 2

    @property
    def end(self) -> float:
        """Metres along the plane where they end."""
        return float(self.at[-1]) + self.step / 2

    def point(self, along: float) -> tuple[float, float]:
        """The place in the plan of a place along the plane, metres, manhattan frame."""
        own = (self.offset, along) if self.facing.axis == 0 else (along, self.offset)
        x, y = turned(np.array([own]), self.turn)[0].tolist()
        return x, y

    def along(self, x: float, y: float) -> tuple[float, float]:
        """Metres along the plane and away from it, of a place in the plan."""
        x, y = turned(np.array([(x, y)]), -self.turn)[0].tolist()
        across, along = (x, y) if self.facing.axis == 0 else (y, x)
        return along, abs(across - self.offset)


def evidence_layer(plan: FloorPlan, item: Item | None, face: int = 0) -> EvidenceLayer | None:
    """The evidence along the plane ``item``, or along the ``face``-th plane of the door ``item``.

    None where the item has no plane, or nothing was seen along it.
    """
    planes = {p.id: p for p in plan.all_planes if p.profile is not None and len(p.profile.low)}
    faces = _faces(plan, item, planes)
    if not faces:
        return None
    plane = planes[faces[face % len(faces)]]
    profile = plane.profile
    assert profile is not None
    signal = door_response(profile, plan.config.doors)
    lintel = np.convolve(profile.high, np.full(SMOOTH, 1 / SMOOTH), mode="same")[: len(profile.high)]
    return EvidenceLayer(
        plane.id,
        plane.facing,
        plane.offset,
        plane.turn,
        np.asarray(profile.start + (np.arange(len(profile.low)) + 0.5) * profile.step, dtype=np.float64),
        profile.step,
        signal.histogram,
        signal.gradient,
        signal.response,
        lintel / (float(lintel.max()) or 1.0),
        plan.config.doors.min_response,
        tuple(d for d in plan.doors if plane.id in d.planes),
        faces,
    )


def _faces(plan: FloorPlan, item: Item | None, planes: dict[str, LayoutPlane]) -> tuple[str, ...]:
    """Ids of the planes with a profile that ``item`` is, or lies in."""
    if item is not None and item.kind == "plane" and item.id in planes:
        return (item.id,)
    if item is not None and item.kind == "door":
        door = next((d for d in plan.doors if d.id == item.id), None)
        return tuple(p for p in door.planes if p in planes) if door is not None else ()
    return ()
