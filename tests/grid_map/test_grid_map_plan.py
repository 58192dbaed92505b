"""Grid maps from beginning to end: rooms, doors, dimensions, world coordinates, label images, the command."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from floorplan_core import intermediates
from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.exporters.label_image import (
    LabelImageExporter,
    PredictedLabelImageExporter,
    region_labels,
    world_raster,
)
from floorplan_core.grid_pipeline import plan_grid_map
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, FloorPlan, GridMap
from floorplan_core.observer import Observer
from tests.factories import l_corridor
from tests.grid_map.map_drawings import CELL, DOORS, ROOMS, fill, office, turned, write_image, write_yaml


@pytest.fixture(scope="module")
def plan() -> FloorPlan:
    return plan_grid_map(office())


def region_at(plan: FloorPlan, x: float, y: float):  # type: ignore[no-untyped-def]
    """The region over a point of the world."""
    xy = plan.manhattan_from_world @ np.array([x, y, 0.0, 1.0])
    (found,) = [r for r in plan.regions if r.polygon.contains(shapely.Point(xy[:2]))]
    return found


def test_every_room_to_the_cell(plan: FloorPlan) -> None:
    assert len(plan.regions) == len(ROOMS) and not plan.warnings
    for x0, y0, x1, y1 in ROOMS.values():
        region = region_at(plan, (x0 + x1) / 2, (y0 + y1) / 2)
        assert (
            shapely.box(x0, y0, x1, y1).symmetric_difference(region.polygon).area < 0.25
        )  # recesses of doors
        core = region.polygon.buffer(-0.3).bounds
        np.testing.assert_allclose(core, [x0 + 0.3, y0 + 0.3, x1 - 0.3, y1 - 0.3], atol=0.3)


def test_every_door_to_the_cell(plan: FloorPlan) -> None:
    assert len(plan.doors) == len(DOORS)
    for x0, y0, x1, y1 in DOORS:
        (door,) = [d for d in plan.doors if abs(d.start - x0) < 0.06 and abs(d.end - x1) < 0.06]
        assert door.axis == 1 and door.offset == pytest.approx((y0 + y1) / 2, abs=CELL / 2 + 1e-9)
        assert door.thickness == pytest.approx(y1 - y0, abs=CELL + 1e-9)
        assert len(door.connects) == 2 and door.planes and 0 < door.confidence <= 1
        corridor = region_at(plan, 6.0, 4.4)
        assert corridor.id in door.connects and door.id in corridor.doors


def test_no_door_lies_inside_a_region(plan: FloorPlan) -> None:
    """Both spaces reach to the middle of the wall, whichever face the corners of a chord lie on."""
    for door in plan.doors:
        cores = [r.polygon.buffer(-1.5 * CELL, join_style="mitre") for r in plan.regions]
        assert not shapely.intersects(shapely.LineString(door.line()), cores).any(), door


def test_labels_are_the_papers(plan: FloorPlan) -> None:
    assert {r.label for r in plan.regions} <= {"room", "corridor"}
    assert region_at(plan, 2.0, 2.0).label == "room"


def test_regions_are_a_coverage(plan: FloorPlan) -> None:
    assert shapely.coverage_is_valid([r.polygon for r in plan.regions])


def test_cover_and_candidates_speak_of_the_same_rectangles(plan: FloorPlan) -> None:
    own = plan.cover.chosen >= 0
    np.testing.assert_allclose(plan.candidates.bounds()[plan.cover.chosen[own]], plan.cover.bounds[own])
    for region in plan.regions:
        assert region.rectangles is not None and len(region.rectangles)
        boxes = shapely.box(*plan.cover.bounds[region.rectangles].T)
        assert shapely.union_all(boxes).intersection(region.polygon).area > 0.9 * region.area


def test_furniture_leaves_the_rooms_as_they_are(plan: FloorPlan) -> None:
    rng = np.random.default_rng(3)
    legs = [(x, y, x + 0.1, y + 0.1) for x, y in rng.uniform((0.5, 0.5), (11.5, 3.0), (30, 2))]
    full = plan_grid_map(office((*legs, (2.0, 6.0, 3.0, 7.0))))
    assert len(full.regions) == len(plan.regions)
    for x0, _, x1, y1 in ROOMS.values():
        a, b = (region_at(p, (x0 + x1) / 2, y1 - 0.3) for p in (plan, full))
        assert a.polygon.intersection(b.polygon).area > 0.97 * a.polygon.union(b.polygon).area
    assert region_at(full, 3.5, 6.5).speculated_fraction > region_at(plan, 3.5, 6.5).speculated_fraction


@pytest.mark.parametrize("degrees", [-20.0, 7.0, 33.0])
def test_turned_building_keeps_its_rooms(plan: FloorPlan, degrees: float) -> None:
    other = plan_grid_map(turned(office(), degrees))
    assert sorted(round(r.area) for r in other.regions) == pytest.approx(
        sorted(round(r.area) for r in plan.regions), abs=1
    )
    assert len(other.doors) == len(DOORS)
    widths = sorted(d.width for d in other.doors)
    np.testing.assert_allclose(widths, sorted(b[2] - b[0] for b in DOORS), atol=0.15)


def test_world_coordinates_follow_origin_and_yaw(plan: FloorPlan) -> None:
    moved = plan_grid_map(replace(office(), origin=(100.0, -50.0), yaw=0.4))
    c, s = np.cos(0.4), np.sin(0.4)
    for a, b in zip(plan.regions, moved.regions, strict=True):
        local = plan.to_world(np.array(a.polygon.centroid.coords)) + 1.0  # from the map's corner
        expected = local @ np.array([[c, s], [-s, c]]) + [100.0, -50.0]
        np.testing.assert_allclose(moved.to_world(np.array(b.polygon.centroid.coords)), expected, atol=1e-6)


def test_label_image_lies_on_the_map(plan: FloorPlan) -> None:
    labels = region_labels(plan)
    assert labels.shape == office().states.shape
    for number, region in enumerate(plan.regions, start=1):
        assert (labels == number).sum() * CELL**2 == pytest.approx(region.area, rel=0.02)
    for degrees in (0.0, 15.0):
        drawn = turned(office(), degrees)
        shown = region_labels(plan_grid_map(drawn))
        assert shown.shape == drawn.states.shape
        assert (drawn.states[shown > 0] == FREE).mean() > 0.97


def test_label_image_of_a_plan_without_a_map(plan: FloorPlan) -> None:
    without = replace(plan, raster=None)
    raster = world_raster(without)
    assert raster.shape == plan.grid.states.shape and raster.cell == plan.grid.cell
    np.testing.assert_array_equal(region_labels(without), region_labels(plan))


def test_unseen_end_of_a_room_is_predicted() -> None:
    drawn = office()
    fill(
        drawn.states, (10.5, 0.0, 12.0, 3.4), UNOBSERVED
    )  # the far wall of "south east", and its corner door
    fill(drawn.states, (10.5, 3.4, 12.0, 3.6), OCCUPIED)
    fill(drawn.states, (8.0, 3.4, 8.9, 3.6), FREE)
    predicted = plan_grid_map(drawn)
    room = region_at(predicted, 9.0, 2.0)
    assert room.area >= 3.2 * 3.2 and room.sides and any(s.speculated for s in room.sides)


def test_walls_at_other_angles_are_said_and_drawn() -> None:
    drawn = office()
    iy, ix = np.mgrid[0 : drawn.states.shape[0], 0 : drawn.states.shape[1]]
    x, y = (ix + 0.5) * CELL - 1.0, (iy + 0.5) * CELL - 1.0
    drawn.states[(x + y > 18.5) & (x < 12.0) & (y < 9.0)] = OCCUPIED  # cuts the north-east corner
    cut = plan_grid_map(drawn)
    assert any("1 of 6 regions have walls at other angles" in text for text in cut.warnings)
    room = region_at(cut, 8.0, 7.0)
    true = shapely.Polygon([(6.2, 5.4), (11.8, 5.4), (11.8, 6.7), (9.7, 8.8), (6.2, 8.8)])
    assert room.polygon.intersection(true).area > 0.96 * room.polygon.union(true).area


def test_the_same_map_gives_the_same_plan(plan: FloorPlan) -> None:
    again = plan_grid_map(office())
    assert [shapely.to_wkb(r.polygon) for r in again.regions] == [
        shapely.to_wkb(r.polygon) for r in plan.regions
    ]
    assert again.doors == plan.doors


def test_plan_survives_saving(plan: FloorPlan, tmp_path: Path) -> None:
    intermediates.save(plan, tmp_path / "p.floorplan")
    back = intermediates.load(tmp_path / "p.floorplan", FloorPlan)
    assert back.raster == plan.raster and len(back.regions) == len(plan.regions)


def test_coarse_map() -> None:
    fine = office()
    coarse = GridMap("coarse", np.ascontiguousarray(fine.states[::2, ::2]), 2 * CELL, fine.origin)
    assert len(plan_grid_map(coarse).regions) == len(ROOMS)


@pytest.mark.parametrize("size", [(1, 1), (1, 400), (3, 3), (40, 40)])
def test_tiny_and_open_maps(size: tuple[int, int]) -> None:
    """No wall anywhere: a plan of the open space or a clear refusal, never anything else."""
    everything_free = GridMap("open", np.full(size, FREE, dtype=np.uint8), CELL)
    try:
        made = plan_grid_map(everything_free)
    except NoPlanError as error:
        assert "\n" not in str(error)
    else:
        assert sum(r.area for r in made.regions) <= 1.05 * size[0] * size[1] * CELL**2


def test_speckle_is_no_building() -> None:
    rng = np.random.default_rng(5)
    noise = rng.choice(np.array([UNOBSERVED, FREE, OCCUPIED]), (150, 150)).astype(np.uint8)
    with pytest.raises(NoPlanError):
        plan_grid_map(GridMap("noise", noise, CELL))


def test_observer_hears_the_stages_and_warnings() -> None:
    class Listener(Observer):
        def __init__(self) -> None:
            super().__init__()
            self.stages: list[str] = []

        def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
            self.stages.append(stage)

    listener = Listener()
    made = plan_grid_map(office(), Config(), listener)
    assert list(dict.fromkeys(listener.stages)) == [
        "frame", "doors", "segments", "planes", "candidates", "cover", "regions", "labels"
    ]  # fmt: skip
    assert set(made.seconds) == set(listener.stages)


def test_a_second_label_image_has_what_is_predicted_only(tmp_path: Path) -> None:
    plan = l_corridor(2, 2)
    images = []
    for exporter, name in ((LabelImageExporter(), "a.png"), (PredictedLabelImageExporter(), "b.png")):
        exporter.write(plan, tmp_path / name)
        with Image.open(tmp_path / name) as image:
            images.append(np.asarray(image))
    labels, predicted = images
    there = predicted > 0
    assert there.any() and (labels[there] == predicted[there]).all()
    cell = world_raster(plan).cell
    assert there.sum() * cell**2 == pytest.approx(plan.speculated().area, rel=0.1)


# the command


def test_command_makes_a_plan_of_a_ros_map(floorcast: Callable, tmp_path: Path) -> None:  # type: ignore[type-arg]
    path = write_yaml(office(), tmp_path)
    done = floorcast("plan", path, "--labels-png", "--json", "--out", "made")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["regions"] == len(ROOMS)
    assert {"plan.geojson", "plan.svg", "report.json", "labels.png"} <= {
        p.name for p in (tmp_path / "made").iterdir()
    }
    with Image.open(tmp_path / "made" / "labels.png") as labels:
        values = np.asarray(labels)
    assert values.shape == office().states.shape and values.max() == len(ROOMS)
    assert set(values[::-1][office().states == OCCUPIED]) <= set(range(len(ROOMS) + 1))


def test_command_says_what_a_picture_lacks(floorcast: Callable, tmp_path: Path) -> None:  # type: ignore[type-arg]
    write_image(office(), tmp_path / "map.png")
    done = floorcast("plan", "map.png", "--out", "made")
    assert done.returncode == 2 and "--resolution 0.05" in done.stderr
    done = floorcast("plan", "map.png", "--resolution", "0.05", "--save-stages", "--out", "made")
    assert done.returncode == 2 and "grid map" in done.stderr
    assert not (tmp_path / "made").exists()
