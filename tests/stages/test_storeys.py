"""Storeys: found from floors and ceilings, not where a table, a gallery or a raised floor looks like one."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import Config
from floorplan_core.errors import UsageError
from floorplan_core.geometry.columns import height_mask
from floorplan_core.model import ManhattanFrame, PointChunk, Reconstruction, Trajectory
from floorplan_core.model.storey import HeightMap, Storey
from floorplan_core.pipeline import FloorPlanner, process, process_storeys
from floorplan_core.stages.storey_evidence import restrict_evidence
from tests.box_world import room, rotation, stations, survey
from tests.drawn_cells import seen_free

STEP = 0.04  # m between points: every surfel is hit
HEIGHT, SLAB = 2.7, 0.3  # m


def rectangle(axis: int, at: float, low: tuple[float, float], high: tuple[float, float]) -> np.ndarray:
    """(N, 3) points of a rectangle across ``axis``; the corners are along the other two axes."""
    u, v = (np.arange(a + STEP / 2, b, STEP) for a, b in zip(low, high, strict=True))
    grid = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)
    return np.insert(grid, axis, at, axis=1)


def box(x0: float, y0: float, x1: float, y1: float, z0: float, z1: float, ceiling: bool = True) -> np.ndarray:
    """(N, 3) points on the inside of a room."""
    parts = [rectangle(2, z0, (x0, y0), (x1, y1))]
    parts += [rectangle(2, z1, (x0, y0), (x1, y1))] if ceiling else []
    parts += [rectangle(0, x, (y0, z0), (y1, z1)) for x in (x0, x1)]
    parts += [rectangle(1, y, (x0, z0), (x1, z1)) for y in (y0, y1)]
    return np.concatenate(parts)


def storeys_of(*parts: np.ndarray, turned: np.ndarray | None = None) -> tuple[Storey, ...]:
    """What is found in the points of ``parts`` with 5 mm of noise."""
    points = np.concatenate(parts)
    points = points + np.random.default_rng(0).normal(0, 0.005, points.shape)
    planner = FloorPlanner(IN_THE_FILES_AXES)  # heights are looked at
    planner.integrate(points if turned is None else points @ turned.T)
    return planner.storeys()


def heights(storeys: tuple[Storey, ...]) -> list[tuple[float, float | None]]:
    return [(s.floor_z, s.ceiling_z) for s in storeys]


IN_THE_FILES_AXES = Config().with_values({"voxels.own_axes": "false"})
GROUND = box(0, 0, 8, 6, 0, HEIGHT)
UP = HEIGHT + SLAB


def assert_heights(storeys: tuple[Storey, ...], *wanted: tuple[float, float | None]) -> None:
    assert len(storeys) == len(wanted)
    for found, (floor, ceiling) in zip(heights(storeys), wanted, strict=True):
        assert found[0] == pytest.approx(floor, abs=0.03)
        assert found[1] == (None if ceiling is None else pytest.approx(ceiling, abs=0.03))


def test_one_storey_has_no_ends():
    (only,) = storeys_of(GROUND)
    assert only.holds(np.array([[0, 0, -1e6], [0, 0, 1e6]])).all()
    assert heights((only,)) == [(pytest.approx(0, abs=0.01), pytest.approx(HEIGHT, abs=0.01))]


@pytest.mark.parametrize("slab", [0.14, 0.3, 0.9])
def test_two_and_three_storeys(slab):
    up = HEIGHT + slab
    stack = [box(0, 0, 8, 6, k * up, k * up + HEIGHT) for k in range(3)]
    for n in (2, 3):
        assert_heights(storeys_of(*stack[:n]), *[(k * up, k * up + HEIGHT) for k in range(n)])


def test_a_tilted_and_turned_stack():
    parts = [box(0, 0, 8, 6, k * UP, k * UP + HEIGHT) for k in range(2)]
    assert len(storeys_of(*parts, turned=rotation(31, 3, -2))) == 2


def test_storeys_whose_ceilings_were_not_seen():
    floors = [box(0, 0, 8, 6, k * UP, k * UP + HEIGHT - 0.4, ceiling=False) for k in range(2)]
    assert_heights(storeys_of(*floors), (0, UP), (UP, None))


def test_a_smaller_storey_on_top():
    assert_heights(storeys_of(GROUND, box(1, 1, 6, 5, UP, UP + 2.4)), (0, HEIGHT), (UP, UP + 2.4))


def test_a_split_level_house_has_storeys_with_a_step():
    """The halves are 1.4 m apart in height: two storeys, not four, and no room is cut."""
    left = [box(0, 0, 6, 6, k * UP, k * UP + HEIGHT) for k in range(2)]
    right = [box(6.2, 0, 12, 6, 1.4 + k * UP, 1.4 + k * UP + HEIGHT) for k in range(2)]
    storeys = storeys_of(*left, *right)
    assert len(storeys) == 2
    lower = np.array([[3, 3, 0], [3, 3, HEIGHT], [9, 3, 1.4], [9, 3, 1.4 + HEIGHT]], dtype=float)
    planner = FloorPlanner()
    planner.integrate(np.concatenate([*left, *right]))
    frame, found = planner._frame_and_storeys()
    assert found[0].holds(frame.to_manhattan(lower)).all()
    assert found[1].holds(frame.to_manhattan(lower + np.array([0, 0, UP]))).all()
    assert not found[1].holds(frame.to_manhattan(lower)).any()


def test_free_space_beside_a_step_belongs_to_the_storey_that_it_lies_in():
    """The slab lies 1 m higher in the eastern half: up to there it is the lower storey that is free."""
    step = HeightMap(np.array([[-0.1, 0.9]]), (0.0, 0.0), 1.0)
    ceiling = HeightMap(np.array([[2.5, 3.5]]), (0.0, 0.0), 1.0)
    free = np.full((10, 20), height_mask(0, 6.0))
    seen = seen_free(free, frame=ManhattanFrame(np.eye(3), 0.0, 0.0, 1.0, 10.0, 0.0, 2.5))
    kept = restrict_evidence(seen, Storey(1, 0.0, 2.5, step, ceiling)).free
    assert (kept[:, :10] == height_mask(0, 2.5)).all()
    assert (kept[:, 10:] == height_mask(0.9, 3.5)).all()


def test_two_halves_of_one_storey_are_one():
    assert len(storeys_of(GROUND, box(8.2, 0, 14, 6, 1.4, 1.4 + HEIGHT))) == 1


NOT_A_STOREY = {
    "a raised slab": [rectangle(2, 0.3, (0, 0), (4, 6)), rectangle(0, 4, (0, 0), (6, 0.3))],
    "tables everywhere": [rectangle(2, 0.75, (1, 1), (7, 5))],
    "a suspended ceiling below the true one": [rectangle(2, 3.2, (0, 0), (8, 6))],
    "stairs to nowhere": [
        rectangle(2, 0.2 * k, (2 + 0.3 * k, 2), (2.3 + 0.3 * k, 3.2)) for k in range(1, 13)
    ],
}


@pytest.mark.parametrize("name", NOT_A_STOREY)
def test_what_is_horizontal_but_parts_no_storeys(name):
    assert len(storeys_of(GROUND, *NOT_A_STOREY[name])) == 1


HALL_WITH_GALLERY = [
    box(0, 0, 12, 10, 0, 6),
    rectangle(2, 3.0, (0, 0), (12, 2)),
    rectangle(2, 2.8, (0, 0), (12, 2)),
]


def test_a_hall_of_two_heights_with_a_gallery_is_one_storey():
    assert len(storeys_of(*HALL_WITH_GALLERY)) == 1


def test_a_stairwell_through_the_slab_does_not_matter():
    well = [rectangle(0, x, (2, 0), (4, UP + HEIGHT)) for x in (2, 4)]
    stairs = [
        rectangle(2, UP * k / 16, (2, 2 + 0.12 * k), (4, 2.12 + 0.12 * k)) for k in range(1, 16)
    ]  # treads between both floors
    storeys = storeys_of(GROUND, box(0, 0, 8, 6, UP, UP + HEIGHT), *well, *stairs)
    assert_heights(storeys, (0, HEIGHT), (UP, UP + HEIGHT))


def test_a_height_map_beyond_its_border_and_at_its_cells():
    steps = HeightMap(np.array([[1.0, 2.0], [3.0, 4.0]]), (10.0, 20.0), 0.5)
    at = steps.at(np.array([[10.2, 20.2], [10.7, 20.2], [10.2, 20.7], [99, 99], [-99, -99]]))
    assert at.tolist() == [1.0, 2.0, 3.0, 4.0, 1.0]


def _stacked(heights: tuple[float, ...], trajectory: bool = True) -> Reconstruction:
    """Rooms of 4 x 5 m and 6 x 3 m above each other, each seen by its own sensor."""
    sizes = [(4, 5), (6, 3)]
    scans = [survey(room(*size), stations(*size), rays=(160, 50)) for size in sizes[: len(heights)]]
    ids, points, poses = [], [], []
    for z, scan in zip(heights, scans, strict=True):
        lift = scan.poses.copy()
        lift[:, 2, 3] += z
        ids.append(scan.scan_id + sum(map(len, poses)))
        points.append(scan.points + np.array([0, 0, z]))
        poses.append(lift)
    path = Trajectory(np.arange(sum(map(len, poses)), dtype=float), np.concatenate(poses))
    chunk = PointChunk(np.concatenate(points), np.concatenate(ids).astype(np.int32) if trajectory else None)
    return Reconstruction("stack", lambda: iter([chunk]), len(chunk.points), path if trajectory else None)


@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
def test_each_storey_has_the_plan_it_would_have_alone(trajectory):
    plans = process_storeys(_stacked((0.0, 3.2), trajectory), IN_THE_FILES_AXES)
    assert [p.storey for p in plans] == [0, 1]
    assert [p.frame.floor_z for p in plans] == pytest.approx([0.0, 3.2], abs=0.02)
    for plan, (w, d) in zip(plans, [(4, 5), (6, 3)], strict=True):
        (region,) = plan.regions
        x0, y0, x1, y1 = region.polygon.bounds
        assert sorted((x1 - x0, y1 - y0)) == pytest.approx(sorted((w, d)), abs=0.02)
        assert region.speculated_fraction < 0.2
        assert len(plan.trajectory) == (4 if trajectory else 0)
    assert sum(p.point_count for p in plans) == _stacked((0.0, 3.2)).point_count


def test_a_single_storey_plan_is_what_it_was():
    one = _stacked((0.0,))
    (plan,) = process_storeys(one)
    assert [r.polygon.wkb for r in plan.regions] == [r.polygon.wkb for r in process(one).regions]
    assert plan.storey == 0


def test_an_unknown_storey_is_a_sentence():
    with pytest.raises(UsageError, match=r"There is no storey 2 in stack: its storeys are 0 to 1\."):
        process(_stacked((0.0, 3.2)), storey=2)
    with pytest.raises(UsageError, match="it has one storey, 0"):
        process(_stacked((0.0,)), storey=1)


def test_a_smaller_share_makes_a_gallery_a_storey():
    planner = FloorPlanner(Config().with_values({"storeys.min_share": "0.1"}))
    planner.integrate(np.concatenate(HALL_WITH_GALLERY))
    assert len(planner.storeys()) == 2
