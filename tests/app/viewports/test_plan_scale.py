"""The scale bar stands where it hides neither room nor dimension."""

from __future__ import annotations

from dataclasses import replace

import pytest
import shapely

from floorcast_app import theme
from floorcast_app.layers.dimensions import dimensions_layer
from floorcast_app.layers.source import source_of
from floorcast_app.view_state import Look
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from floorcast_app.viewports.plan_camera import Camera
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_scale import ROOMY, bar_length, scale_place


def frame_of(look: Look, width: int, height: int) -> Frame:
    return Frame(Camera.of(look, width, height), theme.colours(), look)


@pytest.fixture
def source(sample_workbench):
    sample_workbench.run("view.fit")
    return source_of(sample_workbench.plan)


@pytest.mark.parametrize("size", [(300, 220), (420, 300), (560, 420), (480, 260), (1600, 1200)])
def test_the_bar_hides_nothing(sample_workbench, source, size):
    frame = frame_of(sample_workbench.view.look, *size)
    found = scale_place(frame, source, dimensions_layer(source).rows)
    if found is None:
        assert size[0] < ROOMY[0] or size[1] < ROOMY[1]
        return
    box, value, width = found
    corners = (frame.camera.to_plan(box.left(), box.bottom()), frame.camera.to_plan(box.right(), box.top()))
    plate = shapely.box(*corners[0], *corners[1])
    assert not any(shapely.intersects(r.polygon, plate) for r in sample_workbench.plan.regions)
    assert width == pytest.approx(value * frame.camera.scale)
    assert box.left() >= 0 and box.right() <= size[0] and box.bottom() <= size[1]


def test_a_small_pane_full_of_plan_has_no_bar_and_a_large_one_has(sample_workbench, source):
    x0, y0, x1, y1 = sample_workbench.plan.regions[0].polygon.bounds
    close = replace(sample_workbench.view.look, centre=((x0 + x1) / 2, (y0 + y1) / 2), span=1.0)
    assert scale_place(frame_of(close, 300, 220), source) is None
    assert scale_place(frame_of(close, 1200, 900), source) is not None


def test_bars_are_round(sample_workbench):
    frame = frame_of(replace(sample_workbench.view.look, units="ft-in"), 800, 600)
    feet, pixels = bar_length(frame)
    assert pixels == pytest.approx(feet * 0.3048 * frame.camera.scale)
    assert pixels <= 150


def test_it_can_be_switched_off(qtbot, sample_workbench, source):
    view = FloorPlanView(sample_workbench)
    qtbot.addWidget(view)
    with_bar, without = view.picture(900, 700, True), view.picture(900, 700, False)
    assert with_bar != without
    sample_workbench.run("view.scale_bar")
    assert not sample_workbench.view.look.scale_bar
    assert view.picture(900, 700) == without
    sample_workbench.run("view.scale_bar")
    assert view.picture(900, 700) == with_bar
