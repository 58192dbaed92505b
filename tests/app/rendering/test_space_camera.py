"""The orbit camera: what is in the middle stays there, and what the hand holds follows it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorcast_app.rendering.camera import (
    FRONT,
    MAX_ELEVATION,
    MAX_SPAN,
    MIN_ELEVATION,
    MIN_SPAN,
    SIDE,
    TARGET_HEIGHT,
    TOP,
    camera_of,
    orbited,
    panned,
    zoomed,
)
from floorcast_app.view_state import Look

looks = st.builds(
    Look,
    centre=st.tuples(st.floats(-200, 200), st.floats(-200, 200)),
    span=st.floats(1.0, 500.0),
    azimuth=st.floats(-180, 180),
    elevation=st.floats(-89, 90),
)
sizes = st.tuples(st.integers(50, 3000), st.integers(50, 3000))


@given(looks, sizes)
def test_the_centre_is_in_the_middle(look: Look, size: tuple[int, int]) -> None:
    camera = camera_of(look, *size)
    x, y, depth = camera.project(np.array([[*look.centre, TARGET_HEIGHT]]))[0]
    assert (x, y) == pytest.approx((size[0] / 2, size[1] / 2), abs=1e-6)
    assert depth == pytest.approx(camera.distance)


@given(looks, sizes)
def test_the_shorter_side_shows_the_span(look: Look, size: tuple[int, int]) -> None:
    camera = camera_of(look, *size)
    assert camera.pixels_per_metre * look.span == pytest.approx(min(size))
    np.testing.assert_allclose(camera.rotation @ camera.rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(camera.rotation) == pytest.approx(-1.0)  # right, up and *forward*


@given(looks, sizes, st.floats(0, 1), st.floats(0, 1), st.floats(0.1, 5.0))
def test_a_ray_goes_through_its_pixel(
    look: Look, size: tuple[int, int], across: float, down: float, far: float
) -> None:
    camera = camera_of(look, *size)
    x, y = across * size[0], down * size[1]
    point = camera.at_depth(x, y, far * camera.distance)
    seen = camera.project(point[None])[0]
    np.testing.assert_allclose(seen, (x, y, far * camera.distance), rtol=1e-6, atol=1e-4)


def test_the_three_views() -> None:
    corners = np.array([[1.0, 0.0, TARGET_HEIGHT], [0.0, 1.0, TARGET_HEIGHT], [0.0, 0.0, TARGET_HEIGHT + 1]])
    middle = np.array([200.0, 100.0])

    def shown(view: tuple[float, float]) -> np.ndarray:
        look = Look(azimuth=view[0], elevation=view[1], span=10.0)
        return np.sign(np.round(camera_of(look, 400, 200).project(corners)[:, :2] - middle, 6))

    east, north, up = shown(TOP)
    assert (east.tolist(), north.tolist(), up.tolist()) == ([1, 0], [0, -1], [0, 0])
    east, north, up = shown(FRONT)  # from the south
    assert (east.tolist(), north.tolist(), up.tolist()) == ([1, 0], [0, 0], [0, -1])
    east, north, up = shown(SIDE)  # from the east: north lies to the right
    assert (east.tolist(), north.tolist(), up.tolist()) == ([0, 0], [1, 0], [0, -1])


@given(looks, st.floats(-2000, 2000), st.floats(-2000, 2000))
def test_orbits_stay_within_their_bounds(look: Look, dx: float, dy: float) -> None:
    turned = orbited(look, dx, dy)
    assert -180.0 <= turned["azimuth"] <= 180.0
    assert MIN_ELEVATION <= turned["elevation"] <= MAX_ELEVATION


def test_the_scene_turns_with_the_hand() -> None:
    """A drag to the right moves what is in front to the right."""
    look = Look(azimuth=-90.0, elevation=30.0, span=10.0)
    front = np.array([[0.0, -2.0, TARGET_HEIGHT]])
    before = camera_of(look, 400, 400).project(front)[0]
    after = camera_of(replace(look, **orbited(look, 40.0, 0.0)), 400, 400).project(front)[0]
    assert after[0] > before[0] + 10


@pytest.mark.parametrize("elevation", [90.0, 55.0, 20.0, -40.0])
def test_the_middle_follows_a_pan(elevation: float) -> None:
    look = Look(azimuth=30.0, elevation=elevation, span=10.0)
    held = np.array([[*look.centre, TARGET_HEIGHT]])
    moved = camera_of(replace(look, **panned(look, 400, 400, 12.0, -9.0)), 400, 400).project(held)[0]
    # perspective: exact for the middle's depth, to which a small drag stays close
    assert moved[:2] == pytest.approx((212.0, 191.0), abs=1.0)


@given(looks, st.floats(0.05, 0.95), st.floats(0.05, 0.95), st.floats(-4, 4), st.floats(0.0, 2.5))
def test_zoom_keeps_what_is_under_the_pointer(
    look: Look, across: float, down: float, steps: float, level: float
) -> None:
    look = replace(look, elevation=max(abs(look.elevation), 25.0))
    camera = camera_of(look, 800, 600)
    x, y = across * 800, down * 600
    anchor = camera.on_level(x, y, level)
    if anchor is None or np.linalg.norm(anchor - camera.eye) > 3 * camera.distance:
        return
    fields = zoomed(look, 800, 600, x, y, anchor, steps)
    assert MIN_SPAN <= fields["span"] <= MAX_SPAN
    after = camera_of(replace(look, **fields), 800, 600).project(anchor[None])[0]
    if np.isfinite(after[0]):  # zoomed so far in that the anchor is behind the eye
        assert after[:2] == pytest.approx((x, y), abs=1e-3)


def test_points_behind_the_eye_have_no_pixel() -> None:
    camera = camera_of(Look(azimuth=-90.0, elevation=0.0, span=10.0), 100, 100)
    assert np.isnan(camera.project(np.array([[0.0, -1000.0, 1.0]]))[0, :2]).all()
    assert camera.on_level(50.0, 0.0, -100.0) is None
