"""The whole pipeline on simulated surveys and the bundled one: invariants, repeatability, cancelling."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import shapely

from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, NoPlanError
from floorplan_core.evaluation import compare, load_truth, read_plan
from floorplan_core.exporters.geojson import GeoJsonExporter, geojson_text
from floorplan_core.exporters.svg import svg_text
from floorplan_core.model import FloorPlan, PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.pipeline import process
from floorplan_core.readers import open_survey
from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset, simulate_survey
from tests.box_world import LINTEL, Recorder, room, rotation, stations, survey, two_rooms
from tests.plan_invariants import (
    assert_coverage,
    assert_doors,
    assert_flags,
    assert_no_wall_inside,
    assert_valid,
)

SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"
STAGES = ("frame", "occupancy", "segments", "planes", "doors", "candidates", "cover", "regions", "labels")


def _spec(style: str, sensor: str, seed: int, explore: float = 1.0, furniture: str = "normal") -> SurveySpec:
    """A small building; few rays, so that a survey takes a second."""
    changes = {"columns": 180, "rows": 24} if sensor == "lidar" else {"columns": 64, "rows": 48}
    building = BuildingSpec(style=style, rooms=6, furniture=furniture)
    return SurveySpec(
        building, sensor_preset(sensor, **changes), seed=seed, explore=explore, max_points=250_000
    )


SURVEYS = {
    "straight lidar": _spec("straight", "lidar", 11),
    "flat camera": _spec("flat", "camera", 12),
    "ring lidar, heavy furniture": _spec("ring", "lidar", 13, furniture="heavy"),
    "straight camera, 40 % explored": _spec("straight", "camera", 14, explore=0.4),
    "L lidar, 60 % explored": _spec("l", "lidar", 15, explore=0.6),
    "T camera, a wall that ends in the open": _spec("t", "camera", 1008, 0.3, "heavy"),
}


@cache
def _simulated(name: str) -> Reconstruction:
    made = simulate_survey(SURVEYS[name])

    def chunks() -> Iterator[PointChunk]:
        for at in range(0, len(made.points), 60_000):
            yield PointChunk(made.points[at : at + 60_000], made.scan_id[at : at + 60_000])

    path = Trajectory(made.stamps, made.trajectory)
    return Reconstruction(name, chunks, len(made.points), path, scans_ordered=True)


def _plain(given: Reconstruction) -> Reconstruction:
    """The same points without any viewpoint."""
    return Reconstruction(
        given.name, lambda: (PointChunk(c.points) for c in given.chunks()), given.point_count
    )


@cache
def _plan(name: str) -> FloorPlan:
    return process(_simulated(name))


@pytest.mark.parametrize("name", SURVEYS)
def test_plans_of_simulated_surveys_are_valid(name):
    plan = _plan(name)
    assert len(plan.regions) >= 2
    assert_valid(plan)


@pytest.mark.parametrize("name", ["straight lidar", "flat camera"])
def test_plans_without_viewpoints_are_valid(name):
    plan = process(_plain(_simulated(name)))
    assert len(plan.regions) >= 3
    assert len(plan.trajectory) == 0
    assert_valid(plan)


def test_the_invariants_notice_what_they_are_for():
    """Two rooms made one hold their wall and their door; a region twice is no coverage."""
    places = [*stations(4, 5), *stations(4, 5, 4.1)]
    plan = process(survey(two_rooms((2, 2.9, LINTEL)), places, rays=(160, 50)).reconstruction())
    first, second = plan.regions
    joined = replace(first, polygon=shapely.box(*shapely.total_bounds([first.polygon, second.polygon])))
    with pytest.raises(AssertionError, match="of p"):
        assert_no_wall_inside(replace(plan, regions=(joined,)))
    with pytest.raises(AssertionError, match="Door"):
        assert_doors(replace(plan, regions=(joined,)))
    with pytest.raises(AssertionError):
        assert_coverage((first, replace(joined, id="x", name="x")))
    with pytest.raises(AssertionError):
        assert_flags(replace(plan, regions=(replace(first, free_cells=first.free_cells + 1), second)))


@pytest.mark.parametrize("name", ["straight lidar", "flat camera"])
def test_two_runs_give_the_same_bytes(name):
    first, second = _plan(name), process(_simulated(name))
    assert geojson_text(first) == geojson_text(second)
    assert svg_text(first) == svg_text(second)


@pytest.fixture(scope="module")
def sample() -> FloorPlan:
    return process(open_survey(SAMPLE))


def test_the_bundled_survey_gives_a_valid_plan(sample):
    assert_valid(sample)
    truth = json.loads((SAMPLE / "truth.json").read_text())
    entered = [r for r in truth["rooms"] if r["entered"]]
    assert len(sample.regions) >= len(entered)
    assert len(sample.doors) >= 0.7 * len(entered)
    assert {"room", "corridor"} <= {r.label for r in sample.regions}


def test_the_bundled_survey_has_every_door_and_calls_no_window_one(sample, tmp_path):
    GeoJsonExporter().write(sample, tmp_path / "plan.geojson")
    doors = compare(read_plan(tmp_path / "plan.geojson"), load_truth(SAMPLE)).doors
    assert doors is not None
    assert (doors.precision, doors.recall, doors.windows_as_doors) == (1.0, 1.0, 0)
    assert (doors.openings_found, doors.openings_unmatched) == (1, 0)


def test_the_bundled_survey_gives_the_same_bytes_again(sample):
    again = process(open_survey(SAMPLE))
    assert geojson_text(sample) == geojson_text(again)
    assert svg_text(sample) == svg_text(again)


def test_a_world_far_from_its_origin_and_turned_gives_the_same_rooms():
    places = [*stations(4, 5), *stations(4, 5, 4.1)]
    areas = []
    for turned in (rotation(0), rotation(37), rotation(-120, 4, 2)):
        plan = process(
            survey(two_rooms((2, 2.9, LINTEL)), places, rays=(200, 60), turned=turned).reconstruction()
        )
        areas.append(sorted(r.area for r in plan.regions))
        for region in plan.regions:  # corners come out where they are in the world
            corners = plan.to_world(np.asarray(region.polygon.exterior.coords)) @ turned[:2, :2]
            if turned[2, 2] > 0.9999:
                x = corners[:, 0]
                near = np.min(np.abs(x[:, None] - [0, 4, 4.1, 8.1]), axis=1)
                assert near.max() < 0.02
    for mine in areas:
        assert mine == pytest.approx([20, 20], abs=0.2)


def test_every_stage_reports_its_result_and_its_time():
    recorder = Recorder()
    plan = process(survey(room(4, 5), stations(4, 5), rays=(160, 50)).reconstruction(), None, recorder)
    assert {name for name, _ in recorder.made} == {"read", *STAGES}
    assert {"read", "integrate", *STAGES} <= set(plan.seconds)
    assert all(seconds >= 0 for seconds in plan.seconds.values())
    results = [result for name, result in recorder.made if name != "read"]
    assert all(result is not None for result in results)


class _CancelAt(Observer):
    """Somebody gives up at the ``number``-th beginning (or end) of a stage."""

    def __init__(self, stage: str, number: int, event: str) -> None:
        super().__init__(CancelToken())
        self.wanted, self.left, self.event, self.after = stage, number, event, 0

    def _count(self, stage: str, event: str) -> None:
        if self.cancel.cancelled:
            self.after += event == "started"
        elif stage == self.wanted and event == self.event:
            self.left -= 1
            if self.left == 0:
                self.cancel.cancel()

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self._count(stage, "started")

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self._count(stage, "finished")


@pytest.mark.parametrize("event", ["started", "finished"])
@pytest.mark.parametrize("stage", ["read", *STAGES])
def test_a_cancel_in_any_stage_ends_with_cancelled(stage, event):
    data = survey(room(4, 5), stations(4, 5), rays=(160, 50)).reconstruction(chunk=10_000)
    observer = _CancelAt(stage, 1, event)
    with pytest.raises(Cancelled, match="nothing was written"):
        process(data, None, observer)
    assert observer.after == 0  # no stage begins after it


def test_a_cancel_in_the_very_last_step_counts():
    data = survey(room(4, 5), stations(4, 5), rays=(160, 50)).reconstruction()
    recorder = Recorder()
    process(data, None, recorder)
    last = [name for name, _ in recorder.made if name != "read"][-1]
    times = sum(name == last for name, _ in recorder.made)
    with pytest.raises(Cancelled):
        process(data, None, _CancelAt(last, times, "finished"))


def test_a_cancel_from_another_thread_is_seen_between_chunks():
    given = survey(room(4, 5), stations(4, 5), rays=(160, 50)).reconstruction(chunk=1000)
    observer = Observer()
    seen = []

    def chunks() -> Iterator[PointChunk]:
        for k, chunk in enumerate(given.chunks()):
            seen.append(k)
            if k == 3:
                observer.cancel.cancel()
            yield chunk

    with pytest.raises(Cancelled):
        process(Reconstruction("boxes", chunks, given.point_count, given.trajectory), None, observer)
    assert seen == [0, 1, 2, 3]


def test_free_space_in_no_region_is_reported():
    """A setting so strict that only what is seen in full may be covered: the rest is named, not lost."""
    strict = Config().with_values({"candidates.max_ratio": "1.0001"})
    data = survey(room(4, 5), stations(4, 5), rays=(160, 50)).reconstruction()
    try:
        plan = process(data, strict)
    except NoPlanError as error:
        assert "No region came out" in str(error)
    else:
        covered = sum(r.free_cells for r in plan.regions)
        assert covered + plan.cover.uncovered.sum() >= plan.grid.universe.sum()
        assert_valid(plan)


def test_rooms_know_how_high_they_are(sample: FloorPlan) -> None:
    heights = [r.height for r in sample.regions if r.height is not None]
    assert len(heights) >= 10
    assert np.abs(np.array(heights) - 2.654).max() < 0.01  # truth.json of the bundled survey
