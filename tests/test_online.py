"""Online is the primitive: however a run is cut, the plan is the same; and scans cost the same all along."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import fields, replace

import numpy as np
import pytest
import shapely

from floorplan_core import survey_map
from floorplan_core.config import Config
from floorplan_core.drift.online import CorrectingPlanner
from floorplan_core.errors import InputError
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.geometry import ray_carving, surfel_map
from floorplan_core.model import FloorPlan, PointChunk, Reconstruction, Region, Trajectory
from floorplan_core.pipeline import FloorPlanner, process
from floorplan_core.survey_map import SAMPLE
from tests.box_world import LINTEL, Survey, room, rotation, stations, survey, two_rooms

DOOR = (2.0, 2.9, LINTEL)


@pytest.fixture(scope="module")
def flat() -> Survey:
    places = [*stations(4, 5), *stations(4, 5, 4.1)]
    return survey(two_rooms(DOOR), places, rays=(160, 50), turned=rotation(23))


@pytest.fixture(scope="module")
def batch(flat: Survey) -> FloorPlan:
    return process(flat.reconstruction(chunk=10**9))


def _bytes(plan: FloorPlan) -> str:
    return geojson_text(plan)


def _assert_same(a: FloorPlan, b: FloorPlan) -> None:
    """Bit for bit, except for what says how long it took."""
    assert a.trajectory.tobytes() == b.trajectory.tobytes()
    assert a.frame.rotation.tobytes() == b.frame.rotation.tobytes()
    for name in ("states", "universe"):
        assert np.array_equal(getattr(a.grid, name), getattr(b.grid, name)), name
    assert a.wall_points.xy.tobytes() == b.wall_points.xy.tobytes()
    for name in ("segments", "doors", "point_count", "warnings"):
        assert getattr(a, name) == getattr(b, name), name
    assert [_parts(r) for r in a.regions] == [_parts(r) for r in b.regions]
    assert _bytes(a) == _bytes(b)


def _parts(region: Region) -> list[object]:
    values = {f.name: getattr(region, f.name) for f in fields(region)}
    return [
        values["polygon"].wkb,
        values.pop("rectangles").tolist(),
        *(v for k, v in values.items() if k != "polygon"),
    ]


@pytest.mark.parametrize("size", [777, 8_000, 50_000])
def test_chunks_give_the_plan_of_the_batch(flat, batch, size):
    _assert_same(process(flat.reconstruction(chunk=size)), batch)


def test_scans_give_the_plan_of_the_batch(flat, batch):
    """``integrate`` with points in the sensor's frame, one scan a call."""
    planner = FloorPlanner(source="boxes")
    chunks = []
    for i, pose in enumerate(flat.poses):
        local = (flat.points[flat.scan_id == i] - pose[:3, 3]) @ pose[:3, :3]
        planner.integrate(local, pose)
        chunks.append(local @ pose[:3, :3].T + pose[:3, 3])  # the same rounding for the batch
    data = flat.reconstruction()
    rounded = replace(data, chunks=lambda: iter([PointChunk(np.concatenate(chunks), flat.scan_id)]))
    _assert_same(planner.plan(), process(rounded))


def test_a_trajectory_row_without_points_does_not_depend_on_the_chunks(flat):
    """A scan that saw nothing, just where one chunk ends and the next begins."""
    ids = flat.scan_id + (flat.scan_id >= 4).astype(np.int32)
    poses = np.insert(flat.poses, 4, flat.poses[3], axis=0)
    poses[4, :3, 3] += 0.3
    gapped = replace(flat, scan_id=ids, poses=poses)
    cut = int(np.searchsorted(ids, 4))
    _assert_same(process(gapped.reconstruction(chunk=cut)), process(gapped.reconstruction(chunk=10**9)))


def test_points_in_any_order_of_scans_give_the_same_path(flat):
    order = np.random.default_rng(1).permutation(len(flat.points))
    mixed = replace(flat, points=flat.points[order], scan_id=flat.scan_id[order])
    plans = [process(mixed.reconstruction(chunk=size)) for size in (1500, 10**9)]
    _assert_same(*plans)
    assert len(plans[0].trajectory) == len(flat.poses)


def test_a_plan_in_between_does_not_change_the_last_one(flat, batch):
    planner = FloorPlanner(source="boxes")
    data = flat.reconstruction(chunk=9_000)
    names: list[list[str]] = []
    for k, chunk in enumerate(data.chunks()):
        planner.integrate_chunk(chunk, data.trajectory)
        if k in (1, 3):
            names.append([r.name for r in planner.plan().regions])
    last = planner.plan()
    assert names[0]
    order = {r.polygon.wkb: r for r in last.regions}
    renamed = [replace(order[r.polygon.wkb], id=r.id, name=r.name, doors=r.doors) for r in batch.regions]
    assert [_parts(r) for r in renamed] == [_parts(r) for r in batch.regions]
    assert np.array_equal(last.grid.universe, batch.grid.universe)
    assert [replace(d, connects=()) for d in last.doors] == [replace(d, connects=()) for d in batch.doors]
    assert last.trajectory.tobytes() == batch.trajectory.tobytes()


def test_two_plans_of_the_same_data_are_the_same(flat):
    planner = FloorPlanner(source="boxes")
    data = flat.reconstruction()
    for chunk in data.chunks():
        planner.integrate_chunk(chunk, data.trajectory)
    _assert_same(planner.plan(), planner.plan())


def test_regions_keep_their_names_while_the_run_grows(flat):
    """The first room is "1" from its first plan to the last, although the second one comes later."""
    planner = FloorPlanner(source="boxes")
    data = flat.reconstruction(chunk=10**9)
    whole = next(iter(data.chunks()))
    assert whole.scan_id is not None
    seen = []
    for rooms in (whole.scan_id < 4, whole.scan_id >= 4):
        planner.integrate_chunk(PointChunk(whole.points[rooms], whole.scan_id[rooms]), data.trajectory)
        seen.append(planner.plan())
    named = [{r.name: r for r in plan.regions} for plan in seen]
    for name, before in named[0].items():
        was = shapely.transform(before.polygon, seen[0].to_world)
        now = shapely.transform(named[1][name].polygon, seen[1].to_world)
        assert now.intersection(was).area > 0.5 * min(now.area, was.area)
    new = set(named[1]) - set(named[0])
    assert all(int(name) > max(map(int, named[0])) for name in new)
    known = {r.id for r in seen[1].regions}
    assert all(set(d.connects) <= known for d in seen[1].doors)
    assert all(set(r.doors) <= {d.id for d in seen[1].doors} for r in seen[1].regions)


def _lattice(origin: float = 0.04) -> np.ndarray:
    """A room of 8 cm voxels, as their centres, in layers."""
    step = 0.08
    x, y, z = (np.arange(round(size / step)) for size in (6.4, 4.8, 2.64))
    grid = np.stack(np.meshgrid(z, y, x, indexing="ij"), -1).reshape(-1, 3)[:, ::-1]
    edge = ((grid == 0) | (grid == [len(x) - 1, len(y) - 1, len(z) - 1])).any(axis=1)
    return grid[edge] * step + origin


def test_a_voxel_map_is_recognised_however_it_is_cut():
    points = _lattice()

    def cloud(size: int) -> Reconstruction:
        def chunks() -> Iterator[PointChunk]:
            for at in range(0, len(points), size):
                yield PointChunk(points[at : at + size])

        return Reconstruction("voxels", chunks, len(points))

    whole = process(cloud(10**9))
    _assert_same(process(cloud(300)), whole)
    assert len(whole.regions) == 1
    assert whole.point_count == 8 * len(points)  # each voxel of 8 cm became eight


def test_the_work_of_a_scan_does_not_grow_with_the_run(monkeypatch):
    """Compiled work is a pass over the points of the scan; what is copied on growth is amortised."""
    calls: list[int] = []
    moved: list[int] = []
    insert, fill = surfel_map._insert, surfel_map._fill

    def counted_insert(points, *rest):
        calls.append(len(points) - rest[-1])
        return insert(points, *rest)

    def counted_fill(keys, used, *rest):
        moved.append(used)
        return fill(keys, used, *rest)

    monkeypatch.setattr(surfel_map, "_insert", counted_insert)
    monkeypatch.setattr(surfel_map, "_fill", counted_fill)
    planner = FloorPlanner()
    rng = np.random.default_rng(1)
    scans = 60
    per_scan = 10_000
    for i in range(scans):  # a long corridor, every scan sees new surface
        pose = np.eye(4)
        pose[:3, 3] = (3.0 * i, 0.0, 1.4)
        planner.integrate(rng.uniform(-3, 3, (per_scan, 3)), pose)
    planner.map.settle()
    voxels = len(planner.map.surfels)
    assert voxels > 3 * (1 << 16)  # the table had to grow
    assert sum(calls) <= scans * per_scan + len(moved) * per_scan  # each point once, resumed after growth
    assert len(moved) <= np.log2(voxels / (1 << 16)) + 1
    assert sum(moved) <= 2 * voxels


def test_an_area_seen_again_takes_no_more_memory():
    planner = FloorPlanner()
    data = survey(room(4, 5), stations(4, 5), rays=(160, 50))
    sizes = []
    for _ in range(6):
        for i, pose in enumerate(data.poses):
            local = (data.points[data.scan_id == i] - pose[:3, 3]) @ pose[:3, :3]
            planner.integrate(local, pose)
        planner.map.settle()
        if planner.map.surfels.points >= SAMPLE:  # before, the axes of the map are not decided for good
            sizes.append((len(planner.map.surfels), planner.map.rays.blocks))
    assert len(sizes) > 1 and len(set(sizes)) == 1


def test_a_buffer_is_the_callers_again_after_each_chunk(monkeypatch):
    """Rays that are followed beside the next chunk have arrays of their own."""
    slow, buffers, config = ray_carving.MissMap.carve, np.empty((2, SAMPLE, 3)), Config()
    config = config.model_copy(update={"voxels": config.voxels.model_copy(update={"own_axes": False})})

    def carve(self, points, *rest):
        time.sleep(0.02)
        slow(self, points, *rest)

    monkeypatch.setattr(ray_carving.MissMap, "carve", carve)
    path, rng = Trajectory(np.zeros(1), np.eye(4)[None]), np.random.default_rng(4)
    planners = FloorPlanner(config), FloorPlanner(config)
    for _ in range(3):
        points = rng.uniform(-3, 3, (SAMPLE, 3))
        for planner, buffer in zip(planners, buffers, strict=True):
            buffer[:] = points
            planner.integrate_chunk(PointChunk(buffer, np.zeros(SAMPLE, dtype=np.int32)), path)
        buffers[1] = 1.0  # the first planner's stays until its next chunk comes
    for planner in planners:
        planner.map.settle()
    counts = [np.sort(p.map.rays._pool.sum(axis=1, dtype=np.int64)) for p in planners]
    np.testing.assert_array_equal(*counts)


def test_any_number_of_threads_counts_the_same_rays(monkeypatch):
    """Each has a map of its own, and takes the pieces of a chunk that the others left."""
    data = survey(room(4, 5), stations(4, 5), rays=(320, 200))
    path = Trajectory(np.arange(len(data.poses), dtype=float), data.poses)
    monkeypatch.setattr(survey_map, "PIECE", 1000)
    monkeypatch.setattr(survey_map, "PIECES", 50)
    counts = []
    for helpers in (1, 3):
        monkeypatch.setattr(survey_map, "HELPERS", helpers)
        planner = FloorPlanner()
        for part in np.array_split(np.arange(len(data.points)), 3):
            planner.integrate_chunk(PointChunk(data.points[part], data.scan_id[part]), path)
        planner.map.settle()
        counts.append(np.sort(planner.map.rays._pool.sum(axis=1, dtype=np.int64)))
    assert counts[0].any()
    np.testing.assert_array_equal(*counts)


def test_waiting_points_are_the_planners_own():
    """A caller may reuse its buffer for the next scan."""
    data = survey(room(4, 5), stations(4, 5), rays=(160, 50))
    buffer = np.empty((SAMPLE, 3))
    planner = FloorPlanner()
    for i in range(len(data.poses)):
        mine = data.points[data.scan_id == i]
        view = buffer[: len(mine)]
        view[:] = mine
        planner.integrate_chunk(
            PointChunk(view, np.full(len(mine), i, dtype=np.int32)), data.reconstruction().trajectory
        )
    buffer[:] = 99.0
    assert planner.plan().regions[0].area == pytest.approx(20.0, abs=0.1)


def test_growth_of_the_ray_map_is_amortised(monkeypatch):
    moved: list[int] = []
    rehash = ray_carving._rehash

    def counted(keys, *rest):
        moved.append(len(keys))
        return rehash(keys, *rest)

    monkeypatch.setattr(ray_carving, "_rehash", counted)
    planner = FloorPlanner()
    rng = np.random.default_rng(2)
    for i in range(40):
        pose = np.eye(4)
        pose[:3, 3] = (8.0 * i, 0.0, 1.4)
        planner.integrate(rng.uniform(-8, 8, (3000, 3)), pose)
    planner.map.settle()
    assert len(moved) >= 1
    assert sum(moved) <= 2 * 4 * 4 * planner.map.rays.blocks  # two threads, each with a map of its own


@pytest.mark.parametrize("ids", [[-1, 0], [0, 2]])
def test_rows_that_the_trajectory_has_not_are_refused(ids):
    path = Trajectory(np.zeros(2), np.tile(np.eye(4), (2, 1, 1)))
    chunk = PointChunk(np.ones((2, 3)), np.array(ids, dtype=np.int32))
    with pytest.raises(InputError, match=r"rows 0 to 1"):
        FloorPlanner().integrate_chunk(chunk, path)


@pytest.mark.parametrize("pose", [np.full((4, 4), np.nan), np.eye(3)])
def test_what_is_no_pose_is_refused(pose):
    with pytest.raises(InputError, match="4 x 4 matrix of finite numbers"):
        FloorPlanner().integrate(np.ones((5, 3)), pose)


SHEARED, MIRRORED = np.eye(4), np.diag([-1.0, 1.0, 1.0, 1.0])
SHEARED[0, 1] = 0.1


@pytest.mark.parametrize("planner", [FloorPlanner, CorrectingPlanner])
@pytest.mark.parametrize(
    "pose",
    [SHEARED, MIRRORED, np.diag([1e3, 1e3, 1e3, 1.0]), np.array([*np.eye(4)[:3], [1.0, 2.0, 3.0, 1.0]])],
)
def test_a_pose_that_is_no_motion_is_refused(planner, pose):
    with pytest.raises(InputError, match="A pose must be a rotation"):
        planner().integrate(np.ones((5, 3)), pose)


@pytest.mark.parametrize("planner", [FloorPlanner, CorrectingPlanner])
@pytest.mark.parametrize(
    "points",
    [
        np.ones((6, 4)),  # with intensity: six points, not eight
        np.ones((3, 100)),
        np.zeros(5, dtype=[("x", "f4"), ("y", "f4"), ("z", "f4")]),
        "points",
        [[1.0, 2.0, 3.0], [1.0, 2.0]],
    ],
)
def test_what_are_no_points_is_refused(planner, points):
    with pytest.raises(InputError, match=r"must be numbers in rows of three, \(N, 3\)"):
        planner().integrate(points, np.eye(4))


def _as_it_is(points, pose):
    return points, pose


def _with_what_is_none(points, pose):
    none = [[np.nan] * 3, [np.inf, 0, 0], [0, -np.inf, np.nan], [1e30, 0, 0], [0, 0, 0]]
    return np.vstack([points, none]), pose


def _as_an_image(points, pose):
    return points.reshape(4, len(points) // 4, 3), pose


def _as_lists(points, pose):
    return points.tolist(), pose.tolist()


def _far_away(points, pose):
    moved = pose.copy()
    moved[:3, 3] += [450_000.0, 5_400_000.0, 300.0]
    return points, moved


@pytest.mark.parametrize("planner", [FloorPlanner, CorrectingPlanner])
@pytest.mark.parametrize("given", [_as_it_is, _with_what_is_none, _as_an_image, _as_lists, _far_away])
@pytest.mark.filterwarnings("error")
def test_scans_as_drivers_give_them(planner, given):
    scans = survey(room(4.0, 5.0), stations(4.0, 5.0))
    planner = planner()
    for row, pose in enumerate(scans.poses):
        mine = scans.points[scans.scan_id == row]
        planner.integrate(*given((mine[: len(mine) // 4 * 4] - pose[:3, 3]) @ pose[:3, :3], pose))
        for nothing in (np.full((4, 3), np.nan), np.zeros((0, 3))):
            planner.integrate(*given(nothing, pose))
    plan = planner.plan()
    (found,) = plan.regions
    assert found.area == pytest.approx(20.0, abs=0.02)
    origin = _far_away(None, np.eye(4))[1][:2, 3] if given is _far_away else [0.0, 0.0]
    corners = plan.to_world(np.array(found.polygon.exterior.coords))
    np.testing.assert_allclose(corners.min(axis=0), origin, atol=0.02)


def test_scans_without_points_are_no_matter(flat, batch):
    planner = FloorPlanner(source="boxes")
    data = flat.reconstruction(chunk=10**9)
    planner.integrate_chunk(PointChunk(np.zeros((0, 3)), np.zeros(0, dtype=np.int32)), data.trajectory)
    for chunk in data.chunks():
        planner.integrate_chunk(chunk, data.trajectory)
    planner.integrate(np.zeros((0, 3)))
    _assert_same(planner.plan(), batch)
