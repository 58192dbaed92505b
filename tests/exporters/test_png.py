"""The pictures show, at known places, what the plan holds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image, ImageDraw

from floorplan_core.errors import UsageError
from floorplan_core.exporters import png
from floorplan_core.exporters.filmstrip import filmstrip_image, filmstrip_png
from floorplan_core.exporters.placement import Line, Placed
from floorplan_core.exporters.png_canvas import LARGEST, LEAST_SCALE, LONG_SIDE, View, draw_block, fit_view
from floorplan_core.exporters.walls import poche
from floorplan_core.model import FREE, FloorPlan
from tests.factories import l_corridor, office, small_flat

EXPORTERS = [png.PlanesPngExporter, png.OccupancyPngExporter, png.PlanPngExporter]


def colour_at(image: Image.Image, view: View, x: float, y: float) -> tuple[int, ...]:
    px, py = np.floor(view.pixels(np.array([[x, y]]))[0]).astype(int).tolist()
    return image.getpixel((px, py))  # type: ignore[return-value]


@pytest.fixture(scope="module")
def plan() -> FloorPlan:
    return l_corridor()


@pytest.fixture(scope="module")
def view(plan: FloorPlan) -> View:
    return fit_view(plan.bounds)


@pytest.mark.parametrize("exporter", EXPORTERS)
@pytest.mark.parametrize("make", [small_flat, l_corridor, office])
def test_size_and_same_bytes(exporter: Any, make: Any, tmp_path: Path) -> None:
    for name in ("a.part", "b.part"):  # callers write to temporary names
        exporter().write(make(), tmp_path / name)
    assert (tmp_path / "a.part").read_bytes() == (tmp_path / "b.part").read_bytes()
    with Image.open(tmp_path / "a.part") as image:
        assert image.format == "PNG"
        assert max(image.size[0], image.size[1] - fit_view(make().bounds).strip) == LONG_SIDE


def test_a_large_site_gets_a_larger_picture() -> None:
    """At 1600 pixels 300 m would be lines and numbers only, whose width is in pixels."""
    assert fit_view((0, 0, 300, 200)).width == round(302 * LEAST_SCALE)
    assert fit_view((0, 0, 790, 200)).width == LARGEST
    assert fit_view((0, 0, 300, 200), LONG_SIDE).width == LONG_SIDE


def test_occupancy_colours(plan: FloorPlan, view: View) -> None:
    image = png.occupancy_image(plan, view)
    assert colour_at(image, view, 1.7, 2.0) == png.FREE_KNOWN
    assert colour_at(image, view, 16.5, 3.9) == png.FREE_GUESSED  # upper half of the half-seen room
    assert colour_at(image, view, 10.0, 12.0) == (0, 0, 0)
    near = [colour_at(image, view, 1.0, 0.0 + d) for d in np.arange(-0.03, 0.031, 0.005)]
    assert png.OUTLINE in near


def test_known_free_cells_are_white_everywhere(plan: FloorPlan, view: View) -> None:
    image = np.asarray(png.occupancy_image(plan, view))
    grid = plan.grid
    free = np.argwhere(grid.states == FREE)
    centres = view.pixels(grid.origin + grid.cell * (free[:, ::-1] + 0.5)).astype(int)
    shown = image[centres[:, 1], centres[:, 0]]
    line = np.all(shown == png.OUTLINE, axis=1)
    assert np.all(shown[~line] == 255)
    assert line.mean() < 0.2


def test_plan_colours(plan: FloorPlan, view: View) -> None:
    image = png.plan_image(plan, view)
    assert colour_at(image, view, 0.5, 0.5) == png.ROOM
    assert colour_at(image, view, 9.0, 6.2) == png.CORRIDOR
    assert colour_at(image, view, 0.95, 4.675) == png.DOOR
    assert colour_at(image, view, 10.0, 12.0) == png.WHITE


def test_walls_are_solid_from_face_to_face(plan: FloorPlan, view: View) -> None:
    image = np.asarray(png.plan_image(plan, view))
    walls = poche(plan).observed
    xy = shapely.get_coordinates(shapely.point_on_surface(shapely.get_parts(walls)))
    at = view.pixels(xy).astype(int)
    assert {tuple(c) for c in image[at[:, 1], at[:, 0]].tolist()} == {png.INK}


def test_a_turned_name_reads_upwards() -> None:
    canvas = Image.new("RGB", (200, 200), png.WHITE)
    lines = (Line("Corridor", 30, "name"),)
    draw_block(ImageDraw.Draw(canvas), Placed(lines, 100, 100, True, True), png.INK)
    rows, columns = np.nonzero(np.asarray(canvas.convert("L")) < 128)
    assert np.ptp(rows) > 2 * np.ptp(columns)
    assert abs(rows.mean() - 100) < 5 and abs(columns.mean() - 100) < 8


def test_predicted_floor_is_hatched_in_the_plan(plan: FloorPlan, view: View) -> None:
    image = np.asarray(png.plan_image(plan, view))

    def colours(x0: float, y0: float, x1: float, y1: float) -> set[tuple[int, ...]]:
        (a, d), (c, b) = view.pixels(np.array([[x0, y0], [x1, y1]])).astype(int)
        return {tuple(p) for p in image[b:d, a:c].reshape(-1, 3).tolist()}

    assert colours(14.9, 0.3, 15.9, 1.2) == {png.ROOM}
    predicted = colours(14.9, 3.2, 15.9, 4.2)
    assert len(predicted) == 2
    assert png.ROOM in predicted


def test_planes_are_red_across_x_and_green_across_y(plan: FloorPlan, view: View) -> None:
    image = np.asarray(png.planes_image(plan, view))
    picture = image[: view.height]
    for plane in plan.planes:
        at = view.pixels(np.array([[plane.offset, plane.offset]]))[0].round().astype(int)
        if plane.facing.axis == 0:
            line, colour = picture[:, at[0] - 3 : at[0] + 3], png.RED_LINE
        else:
            line, colour = picture[at[1] - 3 : at[1] + 3], png.GREEN_LINE
        assert np.any(np.all(line == colour, axis=-1)), plane.id
    assert np.any(np.all(picture == png.RED, axis=-1))
    assert np.any(np.all(picture == png.GREEN, axis=-1))
    assert np.any(np.all(picture == png.DIM, axis=-1))


def test_pictures_of_an_empty_plan(tmp_path: Path) -> None:
    plan = replace(small_flat(), regions=(), doors=(), planes=())
    for exporter in EXPORTERS:
        exporter().write(plan, tmp_path / "x.png")
        assert (tmp_path / "x.png").stat().st_size > 0


def test_filmstrip_shows_all_plans_to_one_scale(plan: FloorPlan, tmp_path: Path) -> None:
    early = replace(plan, regions=plan.regions[:3], doors=plan.doors[:3])
    filmstrip_png([early, plan], ["600 s", "1000 s"], tmp_path / "strip.png")
    with Image.open(tmp_path / "strip.png") as image:
        pixels = np.asarray(image)
    half = pixels.shape[1] // 2
    pink = np.all(pixels == png.CORRIDOR, axis=-1)
    assert not pink[:, :half].any()
    assert pink[:, half:].any()
    assert np.all(pixels == png.ROOM, axis=-1)[:, :half].any()


def test_filmstrip_of_plans_in_other_frames(plan: FloorPlan) -> None:
    image = filmstrip_image([l_corridor(yaw_deg=50.0), plan], ["a", "b"])
    pixels = np.asarray(image)
    half = pixels.shape[1] // 2
    assert np.all(pixels[:, :half] == png.CORRIDOR, axis=-1).any()


def test_filmstrip_needs_a_title_for_each_plan(plan: FloorPlan) -> None:
    with pytest.raises(UsageError, match="1 plans, 0 titles"):
        filmstrip_image([plan], [])
    with pytest.raises(UsageError):
        filmstrip_image([], [])
