"""Where clicks snap to."""

from __future__ import annotations

import numpy as np
import pytest

from floorcast_app.layers.snap_index import snap_offset
from floorcast_app.layers.source import source_of


def test_corners_win_over_the_walls_that_meet_there(drawn):
    snaps = source_of(drawn.plan).snaps
    x, y = drawn.plan.regions[0].polygon.exterior.coords[0]
    snap = snaps.at(x + 0.02, y - 0.03, 0.1)
    assert (snap.kind, snap.x, snap.y) == ("corner", pytest.approx(x), pytest.approx(y))


def test_a_wall_keeps_the_coordinate_along_it(drawn):
    snaps = source_of(drawn.plan).snaps
    region = max(drawn.plan.regions, key=lambda r: r.area)
    side = max(region.sides, key=lambda s: s.length)
    (x0, y0), (x1, y1) = side.start, side.end
    axis = 0 if abs(x1 - x0) < abs(y1 - y0) else 1
    at = np.array([x0, y0]) + 0.43 * np.array([x1 - x0, y1 - y0])
    at[axis] += 0.004
    snap = snaps.wall(*at, 0.05)
    assert snap is not None
    assert snap.along == ((0.0, 1.0), (1.0, 0.0))[axis]
    assert snap.xy[1 - axis] == pytest.approx(at[1 - axis])
    assert abs(snap.xy[axis] - (x0, y0)[axis]) < 0.05


def test_nothing_near_is_the_point_itself(drawn):
    snaps = source_of(drawn.plan).snaps
    snap = snaps.at(500.0, 400.0, 0.1)
    assert (snap.kind, snap.xy) == ("", (500.0, 400.0))
    assert snaps.wall(500.0, 400.0, 0.1) is None


def test_a_plane_snaps_to_segments_of_its_facing_only(drawn):
    source = source_of(drawn.plan)
    segment = drawn.plan.segments[0]
    plane = next(p for p in drawn.plan.planes if p.facing == segment.facing)
    offset, id = snap_offset(source, plane, segment.offset + 0.011, 0.03)
    found = next(s for s in drawn.plan.segments if s.id == id)
    assert found.facing == plane.facing
    assert offset == found.offset
    assert abs(offset - segment.offset - 0.011) <= 0.0111
    assert snap_offset(source, plane, 999.0, 0.03) == (999.0, "")
