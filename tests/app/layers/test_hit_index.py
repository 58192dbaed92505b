"""What lies under the pointer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from floorcast_app.layers.hit_index import segment_distance
from floorcast_app.layers.planes import plane_shape
from floorcast_app.layers.source import source_of
from floorcast_app.selection import Item

REACH = 0.05


def test_a_point_in_a_region_hits_the_region(drawn):
    source, look = source_of(drawn.plan), drawn.view.look
    for region in drawn.plan.regions:
        x, y = region.polygon.representative_point().coords[0]
        assert source.hits.at(x, y, 0.0, look, kinds=("region",)) == Item("region", region.id)


def test_doors_win_over_walls_and_walls_over_regions(drawn):
    source, look = source_of(drawn.plan), drawn.view.look
    door = drawn.plan.doors[0]
    x, y = door.line().mean(axis=0)
    assert source.hits.at(x, y, REACH, look) == Item("door", door.id)
    plane = max(drawn.plan.planes, key=lambda p: p.support)
    line = max(plane_shape(plane).lines(), key=lambda a: np.ptp(a))
    x, y = line[0] + 0.31 * (line[1] - line[0])
    hit = source.hits.at(x, y, REACH, look, kinds=("plane", "region"))
    assert hit is not None
    assert hit.kind == "plane"


def test_agrees_with_shapely_on_random_places(drawn):
    source, look = source_of(drawn.plan), drawn.view.look
    lines = {p.id: shapely.MultiLineString(list(plane_shape(p).lines())) for p in drawn.plan.planes}
    x0, y0, x1, y1 = source.extent
    rng = np.random.default_rng(5)
    hit = 0
    for x, y in rng.uniform((x0, y0), (x1, y1), (200, 2)):
        away = {id: shapely.distance(line, shapely.Point(x, y)) for id, line in lines.items()}
        near = min(v for v in away.values() if not np.isnan(v))
        found = source.hits.at(x, y, 0.2, look, kinds=("plane",))
        assert (found is None) == (near > 0.2)
        if found is not None:
            hit += 1
            assert away[found.id] == pytest.approx(near, abs=1e-9)
    assert hit > 20


def test_a_dotted_plane_is_hit_all_along(drawn):
    source, look = source_of(drawn.plan), drawn.view.look
    plane = next(p for p in drawn.plan.planes if p.facing.axis == 0)
    far = (plane.offset, 500.0)
    assert source.hits.at(*far, REACH, look, kinds=("plane",)) is None
    hit = source.hits.at(*far, REACH, look, kinds=("plane",), dotted=True)
    assert abs(next(p.offset for p in drawn.plan.planes if p.id == hit.id) - plane.offset) <= REACH


@pytest.mark.parametrize("how", ["hidden", "layer", "facing"])
def test_what_is_not_shown_cannot_be_hit(drawn, how):
    source, look = source_of(drawn.plan), drawn.view.look
    plane = max(drawn.plan.planes, key=lambda p: p.support)
    x, y = plane_shape(plane).lines()[0].mean(axis=0)
    item = source.hits.at(x, y, REACH, look, kinds=("plane",))
    shown = {
        "hidden": replace(look, hidden=frozenset({("plane", item.id)})),
        "layer": replace(look, layers=look.layers - {"planes"}),
        "facing": replace(look, facings=look.facings - {int(drawn.find(item).facing)}),
    }[how]
    assert source.hits.at(x, y, REACH, shown, kinds=("plane",)) != item


def test_distance_to_a_segment():
    lines = np.array([[0.0, 0.0, 4.0, 0.0], [0.0, 0.0, 0.0, 0.0]])
    assert segment_distance(lines, 5.0, 1.0) == pytest.approx([np.sqrt(2), np.sqrt(26)])
    assert segment_distance(lines, 2.0, -3.0) == pytest.approx([3.0, np.sqrt(13)])
