"""The edges of doors: reveals to a centimetre, whatever was thought before and whatever floats in between."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from floorplan_core.config import DoorsConfig
from floorplan_core.model import Door, Facing, LayoutPlane, ManhattanFrame
from floorplan_core.model.evidence import Evidence
from floorplan_core.stages import doors
from floorplan_core.stages.door_edges import refine_edges
from floorplan_core.stages.door_evidence import DoorMeasures
from floorplan_core.stages.doors import Candidate, merge_faces
from tests.drawn_cells import seen_free

EXACT = 0.015  # m
START, END = 2.0, 2.9  # of the door
NEAR, FAR = 4.0, 4.14  # the faces of its wall
SEEN = np.array([[0.0, 1.95], [2.95, 5.0]])  # where the faces of the wall were seen
PLANES = (
    LayoutPlane("p1", Facing.WEST, NEAR, observed=SEEN),
    LayoutPlane("p2", Facing.EAST, FAR, observed=SEEN),
)


def _grid(*axes: np.ndarray) -> np.ndarray:
    return np.column_stack([m.ravel() for m in np.meshgrid(*axes)])


def _wall(hidden: tuple[float, float] = (0.0, 0.0), reveals: bool = True) -> np.ndarray:
    """Surfels of the wall; nothing of it is seen between the two coordinates ``hidden``."""
    heights = np.arange(0.03, 2.0, 0.05)
    along = np.concatenate([np.arange(0.5, START, 0.05), np.arange(END + 0.03, 4.5, 0.05)])
    faces = _grid(np.array([NEAR, FAR]), along, heights)
    faces = faces[(faces[:, 1] < hidden[0]) | (faces[:, 1] > hidden[1])]
    jambs = _grid(np.arange(NEAR, FAR, 0.05), np.array([START, END]), heights)
    return np.concatenate([faces, jambs]) if reveals else faces


def _evidence(xyz: np.ndarray, noise: float = 0.005) -> Evidence:
    rng = np.random.default_rng(3)
    n, shape = len(xyz), (50, 50)
    open_ = np.zeros(shape, dtype=np.uint64)
    open_[round(START / 0.1) + 1 : round(END / 0.1) - 1] = ~np.uint64(0)
    return seen_free(
        open_,
        frame=ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 50.0, 0.0, 2.6),
        xyz=xyz + rng.normal(0, noise, xyz.shape),
        count=np.full(n, 8, dtype=np.int32),
        spread=np.zeros((n, 2)),
        view=np.zeros((n, 2)),
    )


def _door(start: float, end: float) -> Door:
    return Door("", ("p1", "p2"), 0, (NEAR + FAR) / 2, start, end, thickness=FAR - NEAR)


@pytest.mark.parametrize("thought", [(2.0, 2.9), (1.9, 3.05), (2.15, 2.8), (1.75, 3.2)])
@pytest.mark.parametrize("noise", [0.002, 0.01])
def test_the_edges_are_where_the_reveals_stand(thought, noise):
    (door,) = refine_edges([_door(*thought)], PLANES, _evidence(_wall(), noise))
    assert (door.start, door.end) == pytest.approx((START, END), abs=EXACT)


def test_a_wall_hidden_beside_a_door_does_not_widen_it():
    (door,) = refine_edges([_door(1.55, 2.9)], PLANES, _evidence(_wall(hidden=(1.5, 2.0))))
    assert (door.start, door.end) == pytest.approx((START, END), abs=EXACT)


def test_points_that_float_in_the_opening_do_not_narrow_it():
    """A range sensor that sees an edge and what is behind it at once gives points in between."""
    rng = np.random.default_rng(1)
    floating = rng.uniform((NEAR, START, 0.0), (FAR, START + 0.4, 2.0), (300, 3))
    (door,) = refine_edges([_door(START, END)], PLANES, _evidence(np.concatenate([_wall(), floating])))
    assert (door.start, door.end) == pytest.approx((START, END), abs=EXACT)


def test_without_reveals_the_face_tells_the_edge():
    (door,) = refine_edges([_door(1.98, 2.91)], PLANES, _evidence(_wall(reveals=False)))
    assert (door.start, door.end) == pytest.approx((1.98, 2.91), abs=0.03)


def test_where_nothing_was_seen_the_aperture_stays():
    (door,) = refine_edges([_door(2.05, 2.85)], PLANES, _evidence(np.zeros((0, 3))))
    assert (door.start, door.end) == (2.05, 2.85)


def test_the_two_faces_share_what_is_open_in_both():
    sure = DoorMeasures(1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.9, 0.0)
    one = Candidate(Door("", ("p1",), 0, NEAR, 2.0, 2.9), sure)
    hidden = Candidate(replace(one.door, planes=("p2",), offset=FAR, start=0.9), sure)
    (merged,) = merge_faces([one, hidden], PLANES, DoorsConfig())
    assert (merged.door.start, merged.door.end) == (2.0, 2.9)
    assert merged.door.thickness == pytest.approx(FAR - NEAR)


ONE = Candidate(
    Door("", ("p1",), 0, NEAR, 2.0, 2.9), DoorMeasures(1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.9)
)


def test_surfaces_that_look_at_each_other_are_no_faces_of_one_wall():
    turned = (PLANES[0], replace(PLANES[1], offset=NEAR - 0.1))  # before the face, and looks at it
    other = Candidate(replace(ONE.door, planes=("p2",), offset=NEAR - 0.1), ONE.measures)
    (kept,) = merge_faces([ONE, other], turned, DoorsConfig())
    assert (kept.measures.both, kept.door.thickness, len(kept.door.planes)) == (0.0, 0.0, 1)
    (joined,) = merge_faces([ONE, other], turned, DoorsConfig(), viewpoints=False)  # there it is a guess
    assert len(joined.door.planes) == 2


def test_the_gap_in_the_line_of_a_wall_that_stands_elsewhere_is_none():
    far = tuple(replace(p, observed=SEEN + 9.0) for p in PLANES)
    assert merge_faces([ONE], far, DoorsConfig()) == []
    behind = Candidate(replace(ONE.door, planes=("p2",), offset=FAR), ONE.measures)
    (both,) = merge_faces(
        [ONE, behind], (PLANES[0], far[1]), DoorsConfig()
    )  # but it adds to one that is none
    assert both.door.planes == ("p1", "p2")


def test_openings_of_a_large_site_are_merged_as_if_each_were_compared_with_all(monkeypatch):
    rng, found = np.random.default_rng(4), []
    for _ in range(300):
        axis, start = int(rng.integers(2)), float(rng.uniform(0, 4))
        door = Door("", (f"p{rng.integers(1, 3)}",), axis, float(rng.uniform(-8, 8)), start, start + 0.9)
        found.append(Candidate(door, DoorMeasures(*(float(v) for v in rng.random(9)))))
    merged = merge_faces(found, PLANES, DoorsConfig())
    monkeypatch.setattr(doors, "_LANE", 1e9)
    assert merge_faces(found, PLANES, DoorsConfig()) == merged
    assert 50 < len(merged) < 250
