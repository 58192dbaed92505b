"""Clouds of which no plan can be made: a clear sentence each, no traceback, no memory without bounds."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from floorplan_core.errors import FloorPlanError, NoPlanError
from floorplan_core.pipeline import FloorPlanner, process
from floorplan_core.readers import open_survey
from tests.box_world import HEIGHT, Run, Survey, room, run, stations, survey

SHARED = Path(__file__).resolve().parents[1].parent / "shared" / "data"
MOST_MEMORY = 300e6  # bytes; the maps of one room take under 15 MB
N = 40_000


@pytest.fixture(scope="module")
def one_room() -> Survey:
    return survey(room(4, 5), stations(4, 5), rays=(160, 50))


def _cloud(points: np.ndarray) -> Survey:
    """A cloud that one sensor in its middle saw."""
    pose = np.eye(4)[None].copy()
    finite = points[np.isfinite(points).all(axis=1)]
    pose[0, :3, 3] = finite.mean(axis=0) if len(finite) else 0.0
    return Survey(points, np.zeros(len(points), dtype=np.int32), pose, np.eye(3))


def _refused(given: Survey, trajectory: bool) -> str:
    """The one sentence with which a cloud is refused."""
    result = run(given, trajectory=trajectory)
    assert result.error is not None, "a plan came out"
    assert isinstance(result.error, NoPlanError)
    _assert_clear(result.error)
    return str(result.error)


def _assert_clear(error: FloorPlanError) -> None:
    text = str(error)
    assert text.endswith(".")
    assert "\n" not in text
    assert "Traceback" not in text
    assert 30 < len(text) < 400


def _plane(rng: np.random.Generator, *axes: int, noise: float = 0.0) -> np.ndarray:
    points = rng.normal(0, noise, (N, 3)) if noise else np.zeros((N, 3))
    for axis in axes:
        points[:, axis] = rng.uniform(0, HEIGHT if axis == 2 else 7.0, N)
    return points


def _sphere(rng: np.random.Generator) -> np.ndarray:
    v = rng.normal(size=(N, 3))
    return 3 * v / np.linalg.norm(v, axis=1, keepdims=True)


def _forest(rng: np.random.Generator) -> np.ndarray:
    """Trunks of all sizes at random places on uneven ground."""
    trunks = []
    for x, y in rng.uniform(-15, 15, (50, 2)):
        angle, radius = rng.uniform(0, 2 * np.pi, 1500), rng.uniform(0.1, 0.4)
        trunks.append(
            np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle), rng.uniform(0, 6, 1500)])
        )
    ground = np.column_stack([rng.uniform(-15, 15, (N, 2)), rng.normal(0, 0.03, N)])
    return np.concatenate([*trunks, ground])


NO_ROOM = {
    "empty": (lambda rng: np.zeros((0, 3)), "Too little"),
    "one point": (lambda rng: np.array([[1.0, 2.0, 3.0]]), "Too little"),
    "one point a thousand times": (lambda rng: np.full((1000, 3), 1.234), "Too little"),
    "not a number": (lambda rng: np.full((5000, 3), np.nan), "Too little"),
    "infinite": (lambda rng: np.full((5000, 3), -np.inf), "Too little"),
    "a flat floor": (lambda rng: _plane(rng, 0, 1), "No walls"),
    "a floor with noise": (lambda rng: _plane(rng, 0, 1, noise=0.01), "No walls"),
    "one wall": (lambda rng: _plane(rng, 0, 2, noise=0.01), ""),
    "one wall without noise": (lambda rng: _plane(rng, 1, 2), ""),
    "a sphere": (_sphere, "no Manhattan world"),
    "a forest": (_forest, "no Manhattan world"),
    "a blob": (lambda rng: rng.normal(0, 2, (N, 3)), ""),
    "a volume of points": (lambda rng: rng.uniform(-50, 50, (N, 3)), "No walls"),
}


@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
@pytest.mark.parametrize("name", NO_ROOM)
def test_clouds_without_a_room_are_refused_with_a_sentence(name, trajectory):
    make, words = NO_ROOM[name]
    assert words in _refused(_cloud(make(np.random.default_rng(1))), trajectory)


@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
@pytest.mark.parametrize(("scale", "words"), [(1000.0, "unit"), (100.0, "unit"), (0.001, "unit")])
def test_a_wrong_unit_is_refused_and_the_unit_named(one_room, trajectory, scale, words):
    poses = one_room.poses.copy()
    poses[:, :3, 3] *= scale
    wrong = Survey(one_room.points * scale, one_room.scan_id, poses, one_room.rotation)
    assert words in _refused(wrong, trajectory)


def _only_room(result: Run) -> tuple[float, float]:
    """Width and depth of the only region."""
    assert result.plan is not None, result.error
    (region,) = result.plan.regions
    x0, y0, x1, y1 = region.polygon.bounds
    assert region.area == pytest.approx((x1 - x0) * (y1 - y0), rel=0.01)
    return x1 - x0, y1 - y0


@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
def test_a_room_without_ceiling_is_a_room(trajectory):
    open_above = survey(room(4, 5, ceiling=False), stations(4, 5), rays=(160, 50))
    result = run(open_above, trajectory=trajectory)
    assert result["frame"].ceiling_z is None
    assert _only_room(result) == pytest.approx((4, 5), abs=0.02)


def test_a_room_whose_floor_was_not_seen_is_a_room(one_room):
    """A camera held level: the lowest horizontal surface that it sees is the ceiling."""
    up = one_room.points[:, 2] > 0.3
    cut = Survey(one_room.points[up], one_room.scan_id[up], one_room.poses, one_room.rotation)
    result = run(cut)
    assert result["frame"].floor_z == pytest.approx(0.3, abs=0.1)
    assert result["frame"].ceiling_z == pytest.approx(HEIGHT, abs=0.02)
    assert _only_room(result) == pytest.approx((4, 5), abs=0.02)


@pytest.mark.parametrize("trajectory", [True, False], ids=["viewpoints", "plain"])
@pytest.mark.parametrize("apart", [1e4, 1e5, 1e7])
def test_two_clusters_far_apart_take_no_more_memory(one_room, trajectory, apart):
    """The far one is out of reach of its sensor, or the extent is refused; nothing is allocated for it."""
    far = np.concatenate([one_room.points, one_room.points + np.array([apart, apart, 0])])
    both = Survey(far, np.tile(one_room.scan_id, 2), one_room.poses, one_room.rotation)
    tracemalloc.start()
    try:
        result = run(both, trajectory=trajectory)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < MOST_MEMORY
    if result.error is None:
        assert _only_room(result) == pytest.approx((4, 5), abs=0.02)
    else:
        assert isinstance(result.error, NoPlanError)
        assert "spread over" in str(result.error)
        _assert_clear(result.error)


def test_a_few_points_far_away_do_not_matter(one_room):
    rng = np.random.default_rng(2)
    ghosts = rng.uniform(-25, 25, (3, 3))
    points = np.concatenate([one_room.points, ghosts])
    ids = np.concatenate([one_room.scan_id, np.zeros(3, dtype=np.int32)])
    assert _only_room(run(Survey(points, ids, one_room.poses, one_room.rotation))) == pytest.approx(
        (4, 5), abs=0.02
    )


def test_not_a_number_among_good_points_changes_nothing(one_room):
    rng = np.random.default_rng(3)
    at = np.sort(rng.integers(0, len(one_room.points), 2000))
    bad = rng.choice([np.nan, np.inf, -np.inf], (2000, 3))
    spoilt = Survey(
        np.insert(one_room.points, at, bad, axis=0),
        np.insert(one_room.scan_id, at, one_room.scan_id[at]),
        one_room.poses,
        one_room.rotation,
    )
    good, other = run(one_room).plan, run(spoilt).plan
    assert good is not None
    assert other is not None
    assert other.point_count == good.point_count
    assert [r.polygon.wkb for r in other.regions] == [r.polygon.wkb for r in good.regions]


def test_a_scan_in_one_plane_needs_its_viewpoints():
    """What a 2-D laser sees: the outline of a room at one height."""
    rng = np.random.default_rng(4)
    t = rng.uniform(0, 4, N)
    side = rng.integers(0, 4, N)
    x = np.choose(side, [t, t, np.zeros(N), np.full(N, 4.0)])
    y = np.choose(side, [np.zeros(N), np.full(N, 4.0), t, t])
    cloud = _cloud(np.column_stack([x, y, np.full(N, 0.3)]))
    assert "2-D" in _refused(cloud, False)
    plan = run(cloud, trajectory=True).plan
    assert plan is not None
    assert sum(r.area for r in plan.regions) == pytest.approx(16.0, abs=0.5)
    assert any("planar" in w for w in plan.warnings)


@pytest.mark.shared_data
@pytest.mark.skipif(not SHARED.is_dir(), reason=f"the shared surveys are not there ({SHARED})")
def test_a_real_2d_laser_run_gives_a_sentence_or_a_plan():
    try:
        plan = process(open_survey(SHARED / "carmen_intel" / "points2d.ply"))
    except FloorPlanError as error:
        _assert_clear(error)
    else:
        assert plan.regions


FLOATS = st.floats(width=32, allow_nan=True, allow_infinity=True)


@settings(max_examples=60)
@given(points=hnp.arrays(np.float32, st.tuples(st.integers(0, 400), st.just(3)), elements=FLOATS))
def test_any_floats_give_a_plan_or_a_sentence(points):
    planner = FloorPlanner()
    planner.integrate(points)
    planner.integrate(points, np.eye(4))
    with pytest.raises(NoPlanError):
        planner.plan()


@settings(max_examples=15)
@given(
    seed=st.integers(0, 2**20),
    scale=st.sampled_from([0.5, 3.0, 10.0, 40.0]),
    flat=st.lists(st.sampled_from([0.0, 0.001, 0.1, 1.0]), min_size=3, max_size=3),
    boxes=st.integers(0, 6),
    trajectory=st.booleans(),
)
@example(seed=0, scale=3.0, flat=[0.0, 0.001, 1.0], boxes=0, trajectory=False)  # tall, no planar cell
@example(seed=0, scale=0.5, flat=[0.0, 1.0, 1.0], boxes=0, trajectory=True)  # no walls above 1 m
@example(seed=4, scale=0.5, flat=[0.0, 0.0, 0.0], boxes=5, trajectory=True)  # nothing level
def test_random_clouds_and_boxes_give_a_plan_or_a_sentence(seed, scale, flat, boxes, trajectory):
    """Points in squashed clouds and on the faces of random boxes: whatever comes out comes out cleanly."""
    rng = np.random.default_rng(seed)
    parts = [rng.uniform(-scale, scale, (3000, 3)) * flat]
    for _ in range(boxes):
        low, size = rng.uniform(-scale, scale, 3), rng.uniform(0.2, scale, 3)
        on = rng.uniform(0, 1, (4000, 3))
        on[np.arange(4000), rng.integers(0, 3, 4000)] = rng.integers(0, 2, 4000)
        parts.append(low + on * size)
    tracemalloc.start()
    try:
        result = run(_cloud(np.concatenate(parts)), trajectory=trajectory)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < MOST_MEMORY
    if result.error is not None:
        _assert_clear(result.error)
