"""Buildings without ray casting: hypothesis over buildings of all styles, sizes and furniture."""

from __future__ import annotations

from functools import cache
from itertools import product

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.errors import UsageError
from floorplan_core.simulation import (
    FURNITURE,
    STYLES,
    Building,
    BuildingSpec,
    SensorSpec,
    SurveySpec,
    make_building,
    sensor_preset,
)
from floorplan_core.simulation.furniture import door_zones
from floorplan_core.simulation.solids import dilated, merge_cells, wall_rectangles
from floorplan_core.simulation.truth import dimensions
from floorplan_core.simulation.walk import RADIUS, explore, floor_grid

CASES = tuple(product(STYLES, FURNITURE, (0, 1)))


@cache
def random_building(number: int) -> Building:
    """One of a pool that all tests share: making a building takes longer than most of what is asked of it."""
    style, furniture, _ = CASES[number]
    rng = np.random.default_rng(number)
    rooms, nested, halls = int(rng.integers(2, 17)), rng.choice([0.0, 0.2, 1.0]), rng.choice([0.0, 0.1, 1.0])
    return make_building(
        BuildingSpec(
            style=style, rooms=rooms, furniture=furniture, nested_rooms=float(nested), halls=float(halls)
        ),
        rng,
    )


buildings = st.integers(0, len(CASES) - 1).map(random_building)
few = settings(max_examples=20, deadline=None)


def box(bounds: object) -> shapely.Geometry:
    return shapely.box(*np.asarray(bounds, dtype=float))


@few
@given(buildings)
def test_spaces_are_valid_and_a_wall_apart(building: Building) -> None:
    polygons = [space.polygon for space in building.spaces]
    assert all(p.geom_type == "Polygon" and p.is_valid and p.area > 0.8 for p in polygons)
    tree = shapely.STRtree(polygons)
    near = tree.query(polygons, predicate="dwithin", distance=building.interior_wall - 1e-6)
    assert (near[0] == near[1]).all(), "two spaces are closer than a wall"


@few
@given(buildings)
def test_doors_lie_in_the_wall_between_what_they_join(building: Building) -> None:
    for door in building.doors:
        opening = box(door.bounds)
        for index in door.joins:
            shared = opening.boundary.intersection(building.spaces[index].polygon.boundary)
            assert shared.length == pytest.approx(door.width, abs=2e-3)
        assert all(opening.intersection(s.polygon).area < 1e-9 for s in building.spaces)
        assert 0.65 <= door.width <= 2.85
        assert 1.99 <= door.height < building.height
    openings = [box(d.bounds) for d in building.doors]
    assert sum(o.area for o in openings) == pytest.approx(shapely.union_all(openings).area)


@few
@given(buildings)
def test_every_room_has_a_door_and_leads_to_the_corridor(building: Building) -> None:
    reached, grown = {0}, True
    while grown:
        more = {i for door in building.doors if reached & set(door.joins) for i in door.joins}
        grown, reached = bool(more - reached), reached | more
    assert reached == set(range(len(building.spaces)))
    assert [s.kind for s in building.spaces] == ["corridor", *["room"] * (len(building.spaces) - 1)]


@few
@given(buildings)
def test_walls_fill_exactly_what_is_left(building: Building) -> None:
    walls = shapely.union_all([box(w) for w in wall_rectangles(building)])
    holes = [box(d.bounds) for d in building.doors] + [box(w.bounds) for w in building.windows]
    empty = shapely.union_all([*(s.polygon for s in building.spaces), *holes])
    footprint = shapely.union_all([box(r) for r in dilated(building)])
    assert walls.intersection(empty).area < 1e-6
    assert walls.area + empty.area == pytest.approx(footprint.area, abs=1e-6)


@few
@given(buildings)
def test_windows_look_outside(building: Building) -> None:
    footprint = shapely.union_all([box(r) for r in dilated(building)])
    for window in building.windows:
        pane = box(window.bounds)
        width = window.bounds[3 - window.axis] - window.bounds[1 - window.axis]
        outside = pane.boundary.intersection(footprint.boundary.buffer(1e-4)).length
        inside = pane.boundary.intersection(
            building.spaces[window.space].polygon.boundary.buffer(1e-4)
        ).length
        assert outside == pytest.approx(width, abs=2e-3)
        assert inside == pytest.approx(width, abs=2e-3)
        assert 0 <= window.sill < window.head < building.height


@few
@given(buildings)
def test_furniture_stands_in_its_room_and_leaves_doors_clear(building: Building) -> None:
    zones = shapely.union_all([box(z) for d in building.doors for z in door_zones(d)[:1]])
    for piece in building.furniture:
        x0, y0, z0, x1, y1, z1 = piece.bounds
        hull = box((x0, y0, x1, y1))
        assert hull.difference(building.spaces[piece.space].polygon).area < 1e-6
        assert hull.intersection(zones).area < 1e-6
        assert 0 <= z0 < z1 < building.height


@few
@given(buildings)
def test_dimensions_span_their_room_from_wall_to_wall(building: Building) -> None:
    holes = shapely.union_all(
        [box(d.bounds) for d in building.doors] + [box(w.bounds) for w in building.windows]
    )
    found = dimensions(building)
    assert len({d["id"] for d in found}) == len(found)
    for dimension in found:
        line = shapely.LineString([dimension["from"], dimension["to"]])
        polygon = building.spaces[dimension["room"]].polygon
        assert line.length == pytest.approx(dimension["metres"], abs=2e-3)
        assert line.difference(polygon.buffer(1e-3)).is_empty
        ends = shapely.points([dimension["from"], dimension["to"]])
        assert (shapely.distance(ends, polygon.boundary) < 1e-3).all()
        assert (shapely.distance(ends, holes) > 1e-3).all(), "a laser spot on a door or a window"


def test_dimensions_name_width_and_depth_of_an_empty_room() -> None:
    building = make_building(
        BuildingSpec(rooms=4, furniture="none", nested_rooms=0, halls=0, columns=0, windows=0),
        np.random.default_rng(3),
    )
    x0, y0, x1, y1 = building.spaces[1].rects[0]
    lengths = {d["id"]: d["metres"] for d in dimensions(building) if d["room"] == 1}
    assert sorted(lengths.values()) == pytest.approx(sorted([x1 - x0, y1 - y0]), abs=1e-3)


@settings(max_examples=20, deadline=None)
@given(buildings, st.sampled_from([0.0, 0.5, 1.0]))
def test_the_walk_keeps_clear_of_everything(building: Building, share: float) -> None:
    walk = explore(building, floor_grid(building), share, np.random.default_rng(0))
    path = shapely.LineString(walk.path) if len(walk.path) > 1 else shapely.Point(walk.path[0])
    tall = [f.bounds for f in building.furniture]
    things = [box(w) for w in wall_rectangles(building)] + [box(c) for c in building.columns]
    things += [box((b[0], b[1], b[3], b[4])) for b in tall if b[2] < 1.0]
    assert path.distance(shapely.union_all(things)) > RADIUS / 2
    assert np.hypot(*np.diff(walk.path, axis=0).T).max(initial=0) < 0.2, "the path jumps"
    doorways = [box(d.bounds) for d in building.doors if not d.open]
    assert not any(path.intersects(d) for d in doorways)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 1.0])
def test_the_walk_enters_the_wanted_share(share: float) -> None:
    spec = BuildingSpec(style="ring", rooms=30, shut_doors=0, nested_rooms=0, halls=0)
    building = make_building(spec, np.random.default_rng(1))
    walk = explore(building, floor_grid(building), share, np.random.default_rng(0))
    rooms = len(building.spaces) - 1
    entered = len(set(walk.entered) - {0})
    assert entered == pytest.approx(share * rooms, abs=0.1 * rooms)
    assert (entered == 0) == (share == 0)


def test_rooms_behind_shut_doors_are_not_entered() -> None:
    spec = BuildingSpec(rooms=12, shut_doors=1, halls=0)
    building = make_building(spec, np.random.default_rng(1))
    walk = explore(building, floor_grid(building), 1.0, np.random.default_rng(0))
    assert walk.entered == (0,)


def test_the_same_seed_gives_the_same_building() -> None:
    spec = BuildingSpec(style="grid", rooms=20, furniture="heavy")
    first, second, other = (make_building(spec, np.random.default_rng(s)) for s in (5, 5, 6))
    assert repr(first) == repr(second)
    assert repr(first) != repr(other)


def test_what_the_spec_fixes_is_built() -> None:
    spec = BuildingSpec(height=2.4, interior_wall=0.2, exterior_wall=0.5, furniture="none", windows=0)
    building = make_building(spec, np.random.default_rng(0))
    assert (building.height, building.interior_wall, building.exterior_wall) == (2.4, 0.2, 0.5)
    assert building.furniture == () and building.windows == ()


def test_merge_cells_covers_the_mask_once() -> None:
    mask = np.random.default_rng(0).random((23, 31)) < 0.6
    count = np.zeros(mask.shape, dtype=int)
    for i0, j0, i1, j1 in merge_cells(mask):
        count[j0:j1, i0:i1] += 1
    assert (count == mask).all()


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: BuildingSpec(style="star"), "style must be one of straight, l, t"),
        (lambda: BuildingSpec(rooms=1), "rooms .* 2 to 3000 .*given 1"),
        (lambda: BuildingSpec(rooms=4.5), "rooms .* whole number"),  # type: ignore[arg-type]
        (lambda: BuildingSpec(height=9.0), "height"),
        (lambda: BuildingSpec(shut_doors=float("nan")), "shut_doors"),
        (lambda: SensorSpec(noise=-0.1), "noise"),
        (lambda: SensorSpec(lowest=10, highest=-10), "lowest"),
        (lambda: SensorSpec(min_range=3, max_range=2), "min_range"),
        (lambda: SensorSpec(dropout="lots"), "dropout"),  # type: ignore[arg-type]
        (lambda: SurveySpec(explore=1.5), "explore"),
        (lambda: SurveySpec(seed=-1), "seed"),
        (lambda: sensor_preset("sonar"), "no sensor 'sonar'"),
    ],
)
def test_values_out_of_bounds_are_refused(make: object, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        make()  # type: ignore[operator]


def test_rounding_to_millimetres_never_thins_a_wall() -> None:
    spec = BuildingSpec(
        style="grid",
        rooms=8,
        room_width=12,
        room_depth=8,
        interior_wall=0.1,
        furniture="none",
        nested_rooms=0,
    )
    for seed in range(30):
        polygons = [s.polygon for s in make_building(spec, np.random.default_rng(seed)).spaces]
        near = shapely.STRtree(polygons).query(polygons, predicate="dwithin", distance=0.1 - 1e-6)
        assert (near[0] == near[1]).all()
