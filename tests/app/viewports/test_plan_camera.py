"""The camera of the plan panes."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorcast_app.view_state import Look
from floorcast_app.viewports.plan_camera import Camera, framed, panned, zoomed

metres = st.floats(-1e4, 1e4)
looks = st.builds(Look, centre=st.tuples(metres, metres), span=st.floats(0.5, 1000))
sizes = st.integers(50, 4000)


@given(looks, sizes, sizes, st.floats(0, 1), st.floats(0, 1))
def test_there_and_back(look, width, height, u, v):
    camera = Camera.of(look, width, height)
    x, y = camera.to_plan(u * width, v * height)
    assert camera.point(x, y) == pytest.approx((u * width, v * height), abs=1e-4)


@given(looks, sizes, sizes)
def test_the_centre_is_in_the_middle_and_the_span_fits(look, width, height):
    camera = Camera.of(look, width, height)
    assert camera.point(*look.centre) == pytest.approx((width / 2, height / 2))
    x0, y0, x1, y1 = camera.visible
    assert min(x1 - x0, y1 - y0) == pytest.approx(look.span)


@given(looks, st.floats(0.7, 1.5), st.floats(0, 800), st.floats(0, 600))
def test_zooming_keeps_what_is_under_the_pointer(look, factor, px, py):
    before = Camera.of(look, 800, 600)
    after = Camera.of(replace(look, **zoomed(look, before, factor, (px, py))), 800, 600)
    assert after.to_plan(px, py) == pytest.approx(before.to_plan(px, py), abs=1e-6)
    assert after.scale == pytest.approx(before.scale * factor)


@given(looks, st.floats(-500, 500), st.floats(-500, 500))
def test_panning_moves_the_plan_with_the_pointer(look, dx, dy):
    before = Camera.of(look, 800, 600)
    after = Camera.of(replace(look, **panned(look, before, dx, dy)), 800, 600)
    x, y = before.to_plan(300, 200)
    assert after.point(x, y) == pytest.approx((300 + dx, 200 + dy), abs=1e-4)


def test_y_points_up():
    camera = Camera.of(Look(), 800, 600)
    assert camera.point(0.0, 1.0)[1] < camera.point(0.0, 0.0)[1]


def test_bounds_come_into_view_in_panes_of_any_shape():
    look = replace(Look(), **framed((1.0, 2.0, 9.0, 4.0), 1.2))
    for width, height in ((800, 300), (300, 800)):
        x0, y0, x1, y1 = Camera.of(look, width, height).visible
        assert x0 < 1.0 and y0 < 2.0 and x1 > 9.0 and y1 > 4.0
