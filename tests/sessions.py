"""Planning sessions on tiny buildings of boxes, for the tests of corrections and of replanning."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from floorplan_core.config import Config
from floorplan_core.model import FloorPlan, LayoutPlane
from floorplan_core.model.corrections import Correction, PlaneAt, Point
from floorplan_core.observer import Observer
from floorplan_core.session import PlanningSession
from tests.box_world import LINTEL, Recorder, rotation, stations, survey, two_rooms

WIDTH, DEPTH, THICK = 4.0, 5.0, 0.1  # m, of each of the two rooms and of the wall between them
DOOR = (2.0, 2.9)  # m along that wall


def two_room_session(config: Config | None = None, open_end: bool = False) -> PlanningSession:
    """Two rooms of 20 m2 beside each other with a door between, turned by 17 degrees; read, not planned.

    :param open_end: the far wall of the second room is not there.
    """
    places = [*stations(WIDTH, DEPTH), *stations(WIDTH, DEPTH, WIDTH + THICK)]
    boxes = two_rooms((*DOOR, LINTEL), width=WIDTH, depth=DEPTH, thick=THICK)
    if open_end:
        boxes = [b for b in boxes if not (b[0] > 2 * WIDTH and b[3] - b[0] < 1)]
    data = survey(boxes, places, rays=(160, 60), turned=rotation(17.0)).reconstruction()
    session = PlanningSession(data, config or Config())
    session.read(Observer())
    return session


def plan(session: PlanningSession, *corrections: Correction, config: Config | None = None) -> FloorPlan:
    """The session's plan with these corrections."""
    return session.plan(config or Config(), corrections, Observer())


def stages_run(
    session: PlanningSession, config: Config, corrections: Sequence[Correction] = ()
) -> tuple[FloorPlan, list[str]]:
    """The plan, and the names of the stages that ran for it, in order."""
    recorder = Recorder()
    made = session.plan(config, corrections, recorder)
    return made, list(dict.fromkeys(name for name, _ in recorder.made))


def local(made: FloorPlan, x: float, y: float) -> Point:
    """A place of the plan as corrections name it: in the local frame of the survey, here the world's."""
    a, b = made.to_world(np.array([[x, y]]))[0]
    return float(a), float(b)


def at_plane(made: FloorPlan, plane: LayoutPlane, along: float | None = None) -> PlaneAt:
    """A plane by a place on it, the middle of its longest run where not said."""
    if along is None:
        runs = plane.observed if len(plane.observed) else np.array([[0.0, 0.0]])
        start, end = max(runs, key=lambda r: r[1] - r[0])
        along = float(start + end) / 2
    point = (plane.offset, along) if plane.facing.axis == 0 else (along, plane.offset)
    step = list(point)
    step[plane.facing.axis] += plane.facing.sign
    a, b = local(made, *point), local(made, *step)
    return PlaneAt(a, (b[0] - a[0], b[1] - a[1]))


def by_size(made: FloorPlan) -> list[Any]:
    """The regions, largest first."""
    return sorted(made.regions, key=lambda r: -r.area)


def left_and_right(made: FloorPlan) -> tuple[Any, Any]:
    """The two rooms of the building, by x."""
    left, right = sorted(made.regions, key=lambda r: r.polygon.bounds[0])
    return left, right


def wall_between(made: FloorPlan) -> tuple[LayoutPlane, LayoutPlane]:
    """The two faces of the wall between the rooms: of the left room, of the right one."""
    left, right = left_and_right(made)
    at = (left.polygon.bounds[2], right.polygon.bounds[0])
    axis = 0
    faces = [p for p in made.planes if p.facing.axis == axis]
    return tuple(min(faces, key=lambda p: (abs(p.offset - v), p.id)) for v in at)  # type: ignore[return-value]
