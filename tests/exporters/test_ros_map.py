"""map.yaml and map.pgm, as a robot's map server and our own reader take them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import Image

from floorplan_core.exporters.label_image import world_raster
from floorplan_core.exporters.ros_map import occupancy
from floorplan_core.files import output_file
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, FloorPlan, MapRaster
from floorplan_core.plugins import default_registry
from floorplan_core.readers.grid_map import read_grid_map
from tests.factories import l_corridor, small_flat


def write(plan: FloorPlan, path: Path) -> tuple[dict[str, object], np.ndarray]:
    with output_file(path) as temporary:
        default_registry().exporter(path).write(plan, temporary)
    head = yaml.safe_load(path.read_text())
    return head, np.asarray(Image.open(path.parent / str(head["image"])))[::-1]


def value_at(plan: FloorPlan, head: dict[str, object], image: np.ndarray, place: tuple[float, float]) -> int:
    """The pixel of a place in the plan (manhattan frame)."""
    x, y, yaw = head["origin"]  # type: ignore[misc]
    ny, nx = image.shape
    raster = MapRaster((x, y), yaw, float(head["resolution"]), (ny, nx))  # type: ignore[arg-type]
    ix, iy = np.floor(raster.from_world(plan.to_world(np.array([place])))[0]).astype(int)
    return int(image[iy, ix])


@pytest.mark.parametrize("yaw", [0.0, 25.0])
def test_the_pixels_lie_where_the_plan_lies(tmp_path: Path, yaw: float) -> None:
    plan = l_corridor(yaw_deg=yaw)
    head, image = write(plan, tmp_path / "map.yaml")
    assert head["mode"] == "trinary"
    assert head["free_thresh"] < (255 - 205) / 255 < head["occupied_thresh"]  # type: ignore[operator]
    middles = [r.polygon.representative_point() for r in plan.regions if r.speculated_fraction == 0]
    assert len(middles) > 5
    assert {value_at(plan, head, image, (p.x, p.y)) for p in middles} == {254}
    assert set(np.unique(image)) <= {0, 205, 254}
    free = (image == 254).sum() * plan.grid.cell**2
    assert free == pytest.approx((plan.grid.states == FREE).sum() * plan.grid.cell**2, rel=0.02)


def test_what_is_predicted_is_unknown_unless_the_name_asks_for_it(tmp_path: Path) -> None:
    plan = l_corridor()
    guessed = plan.speculated().representative_point()
    place = (guessed.x, guessed.y)
    assert value_at(plan, *write(plan, tmp_path / "map.yaml"), place) == 205
    assert value_at(plan, *write(plan, tmp_path / "map.predicted.yaml"), place) == 254
    assert {f.name for f in tmp_path.iterdir()} == {
        *("map.yaml", "map.pgm", "map.predicted.yaml", "map.predicted.pgm")
    }


def test_predictions_change_nothing_that_was_seen() -> None:
    plan = small_flat()
    states = plan.grid.states.copy()
    states[10:14, 10:14] = OCCUPIED  # a table
    states[20:24, 10:14] = UNOBSERVED
    plan = replace(plan, grid=replace(plan.grid, states=states))
    raster = world_raster(plan)
    before, after = (occupancy(plan, raster, predicted) for predicted in (False, True))
    known = before != UNOBSERVED
    assert (before[known] == after[known]).all()
    assert (after[~known] == FREE).any()
    assert (after[~known] == OCCUPIED).any()  # walls


def test_our_own_reader_takes_it(tmp_path: Path) -> None:
    plan = small_flat()
    write(plan, tmp_path / "map.predicted.yaml")
    read = read_grid_map(tmp_path / "map.predicted.yaml")
    raster = world_raster(plan)
    assert (read.states == occupancy(plan, raster, predicted=True)).all()
    assert read.resolution == raster.cell
    assert read.origin == pytest.approx(raster.origin, abs=1e-6)
