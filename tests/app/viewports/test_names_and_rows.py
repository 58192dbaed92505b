"""What is written around and in the plan keeps apart: dimensions in view after Fit, pins on names."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPointF, QRectF

from floorcast_app import theme
from floorcast_app.actions.view_actions import fit
from floorcast_app.layers.dimensions import dimensions_layer, row_gap, writing_around
from floorcast_app.layers.label_spots import number_spot
from floorcast_app.layers.regions import regions_layer
from floorcast_app.layers.source import source_of
from floorcast_app.viewports.plan_camera import Camera
from floorcast_app.viewports.plan_floor_views import NamesView
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_overlay import _free_place
from floorcast_app.workbench import Workbench
from tests.factories import office

SIZES = [(454.0, 266.0), (400.0, 187.0), (1100.0, 560.0), (2200.0, 1000.0)]


@pytest.mark.parametrize("size", SIZES)
def test_all_rows_of_dimensions_are_in_view_after_fit(
    sample_workbench: Workbench, size: tuple[float, float]
) -> None:
    workbench = sample_workbench
    workbench.view.room = size
    fit(workbench)
    camera = Camera.of(workbench.view.look, *size)
    assert workbench.plan is not None
    for row in dimensions_layer(source_of(workbench.plan)).rows:
        gap = row_gap(row.level, min(size))
        if gap is None:
            continue
        x, y = camera.point(row.edge, row.edge)
        at = y - row.sign * gap if row.axis else x + row.sign * gap
        assert 11 <= at <= (size[1] if row.axis else size[0]) - 5  # its text stands above or left of it
    workbench.view.room = None


def test_small_panes_show_one_row_and_large_ones_two() -> None:
    assert row_gap(1, 200) is not None and row_gap(2, 200) is None
    assert row_gap(2, 800) is not None and writing_around(200) < writing_around(800)


def test_a_small_pane_numbers_its_rooms_without_turning_them(qapp: object) -> None:
    plan = office()
    layer = regions_layer(source_of(plan))
    look = Workbench(lambda call: None).view.look
    scale = 18.0 / min(s.seat.width for s in layer.shapes)
    frame = Frame(Camera((0.0, 0.0), scale, 400, 300), theme.colours(), look)
    blocks = NamesView(layer).blocks(frame)
    assert set(blocks) == {r.id for r in plan.regions}


def test_the_seat_of_a_number_is_a_square_in_the_region() -> None:
    import shapely

    room = office().regions[0].polygon
    seat = number_spot(room)
    half = seat.width / 2 * 0.99
    assert room.contains(shapely.box(seat.x - half, seat.y - half, seat.x + half, seat.y + half))
    assert not seat.turned


def test_a_length_is_written_beside_a_name_on_its_line() -> None:
    name = QRectF(80, -10, 40, 20)
    a, b = QPointF(0, 0), QPointF(200, 0)
    box = _free_place(a, b, 30, 0.0, (name,), always=False)
    assert box is not None
    assert not box.intersects(name)
    alone = _free_place(a, b, 30, 0.0, (), always=False)
    assert alone is not None
    assert alone.center() == QPointF(100.0, 0.0)
