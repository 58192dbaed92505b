"""What was seen along sides, against plain Python that looks at every surface for every side."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.model import Door, Facing, LayoutPlane, LayoutSegment
from floorplan_core.stages.region_sides import WallSurfaces, doors_of
from floorplan_core.stages.side_measures import REACH

ROOM = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [3.0, 4.0], [3.0, 2.0], [0.0, 2.0]])
LIES = [Facing.NORTH, Facing.WEST, Facing.SOUTH, Facing.EAST, Facing.SOUTH, Facing.EAST]  # along each side


def segment(k: int, facing: Facing, offset: float, start: float, end: float, plane: str) -> LayoutSegment:
    return LayoutSegment(
        f"s{k}", facing, offset, start, end, 0.2, 2.5, 3.0, 300, 0.004 + 0.001 * (k % 7), 0.001, plane=plane
    )


def survey(seed: int, count: int = 60) -> list[LayoutSegment]:
    rng = np.random.default_rng(seed)
    out = []
    for k in range(count):
        facing = Facing(int(rng.integers(4)))
        at = rng.choice([0.0, 2.0, 3.0, 4.0, 6.0]) + rng.normal(0, 0.1)
        start = rng.uniform(-1.0, 6.0)
        out.append(
            segment(k, facing, float(at), float(start), float(start + rng.uniform(0.1, 3.0)), f"p{k % 9}")
        )
    return out


def along(segments: list[LayoutSegment], k: int) -> list[tuple[float, float, float, str, float]]:
    """Offset, start, end, plane and mean height of what was seen along side k."""
    a, b, facing = ROOM[k], ROOM[(k + 1) % len(ROOM)], LIES[k]
    at, (low, high) = a[facing.axis], sorted((a[1 - facing.axis], b[1 - facing.axis]))
    rows = [
        (s.offset, max(s.start, low), min(s.end, high), s.plane, s.area / s.length)
        for s in segments
        if s.facing == facing and abs(s.offset - at) < REACH
    ]
    return [row for row in rows if row[2] > row[1]]


@pytest.mark.parametrize("seed", range(8))
def test_share_and_plane_of_each_side(seed):
    segments = survey(seed)
    found = WallSurfaces([], segments).measure(ROOM, doors_of([]))
    for k, (share, plane, residual) in enumerate(found):
        rows = along(segments, k)
        length = float(np.abs(ROOM[k] - ROOM[(k + 1) % len(ROOM)]).sum())
        seen = np.zeros(100_000, dtype=bool)  # a ruler along the side
        low = min(ROOM[k] @ [1, 1], ROOM[(k + 1) % len(ROOM)] @ [1, 1]) - ROOM[k][LIES[k].axis]
        total: dict[str, float] = {}
        for _, start, end, name, _height in rows:
            seen[int((start - low) / length * 1e5) : int((end - low) / length * 1e5)] = True
            total[name] = total.get(name, 0.0) + end - start
        assert share == pytest.approx(seen.mean(), abs=1e-3)
        assert plane == max(total, key=lambda n: (total[n], n), default="")
        assert (residual is None) == (not rows)


@pytest.mark.parametrize("seed", range(8))
def test_a_side_belongs_where_most_of_its_area_was_seen(seed):
    segments = survey(seed)
    moved = shapely.get_coordinates(WallSurfaces([], segments).fit(shapely.Polygon(ROOM)))
    for k, facing in enumerate(LIES):
        rows = sorted(along(segments, k))
        if sum(end - start for _, start, end, _, _ in rows) < 0.3:
            continue
        area = np.array([(end - start) * height for _, start, end, _, height in rows])
        middle = rows[int(np.searchsorted(np.cumsum(area), 0.5 * area.sum()))][0]
        near = [abs(row[0] - middle) < 0.03 for row in rows]
        wanted = np.average([row[0] for row in rows], weights=area * near)
        assert np.abs(moved[:, facing.axis] - wanted).min() < 1e-12


def test_a_beam_along_a_wall_does_not_move_the_side_to_itself():
    """It hangs over all of the wall, 15 cm before it; of the wall below something is hidden."""
    wall = LayoutSegment("s1", Facing.NORTH, 0.0, 0.5, 4.0, 0.2, 2.2, 5.0, 900, 0.01, 0.001, plane="p1")
    beam = LayoutSegment("s2", Facing.NORTH, 0.15, 0.0, 6.0, 2.3, 2.7, 2.4, 500, 0.01, 0.001, plane="p2")
    moved = WallSurfaces([], [wall, beam]).fit(shapely.Polygon(ROOM))
    assert moved.bounds[1] == 0.0


def test_where_only_the_other_face_was_seen_the_side_lies_a_thickness_behind_it():
    walls = WallSurfaces([], [segment(1, Facing.WEST, -0.1, 0.0, 2.0, "p1")])  # seen from the next room
    fitted = walls.fit(shapely.box(0.0, 0.0, 6.0, 2.0))
    assert fitted.bounds[0] == pytest.approx(-0.1 + walls.thickness)


def test_a_wall_placed_by_hand_stays_and_counts_as_seen():
    plane = LayoutPlane("p1", Facing.EAST, 0.0, walls=np.array([[0.0, 2.0]]), by_hand="added")
    walls = WallSurfaces([plane], [segment(1, Facing.EAST, 0.05, 0.0, 2.0, "p2")])
    room = shapely.orient_polygons(shapely.box(0.0, 0.0, 6.0, 2.0))
    assert walls.fit(room).bounds[0] == 0.0
    found = walls.measure(np.array([[0.0, 2.0], [0.0, 0.0], [6.0, 0.0], [6.0, 2.0]]), doors_of([]))
    assert found[0][:2] == (1.0, "p2")  # as long as the other: ties to the later name


def test_a_door_in_a_side_is_no_gap_in_it():
    walls = WallSurfaces([], [segment(1, Facing.NORTH, 0.0, 0.0, 2.0, "p1")])
    door = Door("d1", ("p1",), 1, 0.05, 2.0, 3.0, thickness=0.1)
    ((share, _, _), *_) = walls.measure(ROOM, doors_of([door]))
    assert share == pytest.approx(0.5)
