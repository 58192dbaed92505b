"""The stages of a grid map by themselves: frame, furniture, passages, boundaries, outlines."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.geometry.masks import label_patches
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, Facing, GridMap, OccupancyGrid
from floorplan_core.stages.grid_map import find_floor, find_furniture
from floorplan_core.stages.grid_map_chords import march, opening
from floorplan_core.stages.grid_map_outlines import askew_share, outline
from floorplan_core.stages.grid_map_passages import DOOR, MOUTH, PASSAGE, _draw, find_passages
from floorplan_core.stages.grid_map_walls import find_boundary, wall_planes, wall_segments
from tests.grid_map.map_drawings import CELL, DOORS, ROOMS, fill, office, turned

CONFIG = Config()


def spaces_of(states: np.ndarray, config: Config = CONFIG) -> tuple[tuple, np.ndarray]:
    return find_passages(states == FREE, CELL, config.maps)


def blank(width: float, height: float) -> np.ndarray:
    return np.full((round(height / CELL) + 40, round(width / CELL) + 40), OCCUPIED, dtype=np.uint8)


# frame and furniture


def test_upright_map_is_taken_as_it_is() -> None:
    ground = find_floor(office(), CONFIG)
    assert ground.frame.yaw == 0.0 and ground.frame.support > 0.95
    np.testing.assert_array_equal(ground.grid.states, office().states)
    np.testing.assert_allclose(ground.grid.origin, [-1.0, -1.0])


@pytest.mark.parametrize("degrees", [-40.0, -12.3, -1.0, 3.7, 29.0, 44.0])
def test_yaw_of_a_turned_map(degrees: float) -> None:
    ground = find_floor(turned(office(), degrees), CONFIG)
    assert np.degrees(ground.frame.yaw) == pytest.approx(degrees, abs=0.2)
    _, spaces = find_passages(ground.floor, CELL, CONFIG.maps)
    assert spaces.max() == len(ROOMS)  # no wall got a hole


def test_nothing_free_says_what_to_check() -> None:
    empty = GridMap("dark.png", np.full((50, 50), OCCUPIED, dtype=np.uint8), CELL)
    with pytest.raises(NoPlanError, match=r"dark\.png holds less than .* resolution"):
        find_floor(empty, CONFIG)


def test_furniture_is_small_or_compact_and_isolated() -> None:
    furniture = {"leg": (1.0, 1.0, 1.1, 1.1), "bin": (2.0, 1.0, 2.5, 1.5), "table": (5.0, 1.0, 6.0, 2.0)}
    walls = {"cabinet at a wall": (7.2, 1.0, 7.8, 2.5), "screen": (9.0, 1.0, 9.1, 2.4)}
    drawn = office((*furniture.values(), *walls.values()))
    found = find_furniture(drawn.states, CELL, CONFIG.maps)
    expected = np.zeros_like(drawn.states)
    for box in furniture.values():
        fill(expected, box, np.uint8(1))
    np.testing.assert_array_equal(found, expected.astype(bool))


# passages


@pytest.mark.parametrize("ends", [(0, 0, 9, 3), (9, 3, 0, 0), (2, 8, 2, 1), (5, 5, 5, 5), (1, 7, 6, 2)])
def test_drawn_chords_stop_every_ray(ends: tuple[int, int, int, int]) -> None:
    cut = np.ones((12, 12), dtype=bool)
    _draw(cut, np.array(ends, dtype=np.float64))
    y, x = np.nonzero(~cut)
    assert not cut[ends[1], ends[0]] and not cut[ends[3], ends[2]]
    assert len(x) == 1 + abs(ends[2] - ends[0]) + abs(ends[3] - ends[1])  # each shares an edge with the next
    assert label_patches(~cut)[1] == 1
    a, b = np.array(ends[:2]), np.array(ends[2:])
    across = np.array([b[1] - a[1], a[0] - b[0]]) / max(np.hypot(*(b - a)), 1)
    assert np.abs((np.column_stack([x, y]) - a) @ across).max() <= 1


def test_office_parts_into_its_rooms() -> None:
    passages, spaces = spaces_of(office().states)
    assert [p.kind for p in passages] == [DOOR] * len(DOORS)
    assert spaces.max() == len(ROOMS)
    for x0, y0, x1, y1 in ROOMS.values():
        inside = np.zeros_like(spaces)
        fill(inside, (x0 + 0.1, y0 + 0.1, x1 - 0.1, y1 - 0.1), 1)
        assert len(np.unique(spaces[inside > 0])) == 1


def test_a_ring_corridor_stays_whole() -> None:
    states = blank(14, 10)
    states[20:-20, 20:-20] = FREE
    states[56:-56, 56:-56] = OCCUPIED  # 1.8 m of corridor all around
    passages, spaces = spaces_of(states)
    assert passages == () and spaces.max() == 1


def test_a_gate_in_a_ring_corridor_parts_nothing() -> None:
    states = blank(14, 10)
    states[20:-20, 20:-20] = FREE
    states[56:-56, 56:-56] = OCCUPIED
    states[20:56, 158:162] = OCCUPIED
    states[28:48, 158:162] = FREE  # a gate of 1 m: one can walk around the ring to its other side
    passages, spaces = spaces_of(states)
    assert passages == () and spaces.max() == 1
    states[-56:-20, 158:162] = OCCUPIED  # the other way is walled up, with a gate, too
    states[-46:-26, 158:162] = FREE
    passages, spaces = spaces_of(states)
    assert len(passages) == 2 and spaces.max() == 2


@pytest.mark.parametrize(("gap", "rooms"), [(1.0, 2), (2.5, 2), (4.8, 1)])
def test_gap_in_a_wall_parts_up_to_a_width(gap: float, rooms: int) -> None:
    states = blank(10, 8)
    states[20:-20, 20:-20] = FREE
    states[20:-20, 118:122] = OCCUPIED
    states[20 : 20 + round(gap / CELL), 118:122] = FREE
    passages, spaces = spaces_of(states)
    assert spaces.max() == rooms
    assert [p.kind for p in passages] == ([DOOR] if gap < 1.6 else [PASSAGE])[: rooms - 1]


def test_a_corridor_ends_at_a_hall() -> None:
    states = blank(14, 8)
    states[20:-20, 160:-20] = FREE  # hall 7 x 8 m
    states[80:110, 20:160] = FREE  # corridor 1.5 m wide, 7 m long
    passages, spaces = spaces_of(states)
    assert [p.kind for p in passages] in ([MOUTH], [DOOR]) and spaces.max() == 2
    without = CONFIG.model_copy(
        update={"maps": CONFIG.maps.model_copy(update={"max_mouth": 0.31, "max_door": 0.9})}
    )
    assert spaces_of(states, without)[1].max() == 1


@given(st.floats(0, 179), st.floats(0.7, 1.3))
def test_door_in_a_wall_of_any_direction(degrees: float, width: float) -> None:
    y, x = (np.mgrid[0:260, 0:260] - 129.5) * CELL
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    along, across = c * x + s * y, -s * x + c * y
    states = np.where(np.hypot(x, y) < 5.5, FREE, OCCUPIED).astype(np.uint8)
    states[(np.abs(across) < 0.1) & (np.abs(along) > width / 2)] = OCCUPIED
    passages, spaces = spaces_of(states)
    assert spaces.max() == 2 and len(passages) == 1
    length = np.hypot(*np.subtract(passages[0].end, passages[0].start)) * CELL
    assert length == pytest.approx(width, abs=0.25)  # a chord may slant through the wall's thickness


def test_march_and_opening_measure_cells() -> None:
    free = np.zeros((60, 60), dtype=bool)
    free[10:30, 5:55] = True  # a room 50 wide above ...
    free[30:34, 20:30] = True  # ... a wall 4 thick with a gap of 10
    free[34:50, 5:55] = True
    assert march(free, 20.0, 20.0, 1.0, 0.0, 100.0) == pytest.approx(34.5, abs=0.5)
    ratio, depth = opening(free, 25.0, 31.0, 0.0, 1.0, 10.0, 10.0, 16.0)
    assert 0.19 <= ratio <= 0.3 and depth == 18
    assert opening(free, 25.0, 48.0, 0.0, 1.0, 10.0, 10.0, 16.0) == (np.inf, 1.0)


# boundaries, planes, outlines


def test_walls_lie_on_the_faces_that_were_drawn() -> None:
    drawn = office()
    ground = find_floor(drawn, CONFIG)
    _, spaces = find_passages(ground.floor, CELL, CONFIG.maps)
    boundary = find_boundary(spaces, ground.floor, ground.grid)
    segments, rows = wall_segments(boundary, ground.grid, CONFIG)
    assert len(rows) == len(segments)
    faces = {
        Facing.EAST: {b[0] for b in (*ROOMS.values(), *DOORS)},
        Facing.WEST: {b[2] for b in (*ROOMS.values(), *DOORS)},
        Facing.NORTH: {b[1] for b in ROOMS.values()},
        Facing.SOUTH: {b[3] for b in ROOMS.values()},
    }
    for s in segments:
        assert min(abs(s.offset - f) for f in faces[s.facing]) < 1e-9
    segments, planes = wall_planes(segments, CELL, CONFIG)
    of = {p.id: p for p in planes}
    assert all(abs(of[s.plane].offset - s.offset) <= 0.1 and of[s.plane].facing == s.facing for s in segments)
    assert sum(len(p.segments) for p in planes) == len(segments)


def test_frontier_neither_blocks_nor_is_a_wall() -> None:
    drawn = office()
    fill(drawn.states, (10.0, 0.0, 12.0, 3.4), UNOBSERVED)  # the east end of a room was never seen
    ground = find_floor(drawn, CONFIG)
    _, spaces = find_passages(ground.floor, CELL, CONFIG.maps)
    boundary = find_boundary(spaces, ground.floor, ground.grid)
    open_side = (boundary.facing == Facing.WEST) & (np.abs(boundary.offset - 10.0) < 1e-9)
    assert open_side.any() and not boundary.bounds_space[open_side].any()
    segments, _ = wall_segments(boundary, ground.grid, CONFIG)
    assert not any(s.facing == Facing.WEST and abs(s.offset - 10.0) < 0.01 for s in segments)


def test_outline_straightens_what_is_nearly_straight() -> None:
    mask = np.zeros((120, 160), dtype=bool)
    mask[20:100, 20:140] = True
    mask[20:22, 60:140] = False  # a step of two cells
    grid = OccupancyGrid(np.zeros(2), CELL, mask.astype(np.uint8), mask, 0.0)
    polygon = outline(mask, grid)
    edges = np.diff(np.asarray(polygon.exterior.coords), axis=0)
    long = np.hypot(*edges.T) > 1.0
    assert (np.abs(edges[long]).min(axis=1) < 1e-9).all()
    assert askew_share(polygon) == 0.0
    assert polygon.area == pytest.approx(mask.sum() * CELL**2, rel=0.03)


def test_askew_share_counts_walls_at_other_angles() -> None:
    assert askew_share(shapely.box(0, 0, 4, 3)) == 0.0
    diamond = shapely.Polygon([(0, -2), (2, 0), (0, 2), (-2, 0)])
    assert askew_share(diamond) == pytest.approx(1.0)
    cut = shapely.Polygon([(0, 0), (4, 0), (4, 3), (3, 4), (0, 4)])
    assert askew_share(cut) == pytest.approx(np.sqrt(2) / (14 + np.sqrt(2)))


def test_outline_of_nothing() -> None:
    grid = OccupancyGrid(np.zeros(2), CELL, np.zeros((9, 9), np.uint8), np.zeros((9, 9), bool), 0.0)
    assert outline(np.zeros((9, 9), dtype=bool), grid) is None
