"""What must hold of every plan, whatever it was made from."""

from __future__ import annotations

import json
from collections.abc import Collection

import numpy as np
import shapely
import shapely.geometry

from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.geometry.raster import polygon_mask
from floorplan_core.model import FREE, FloorPlan, LayoutPlane, Region
from floorplan_core.model.layout import turned

INSIDE = 0.25  # m from a region's sides, from which something lies in its interior (thickness, tolerance)
SHORTEST = 0.3  # m: what is left of a wall after that; shorter pieces are noise
STEP = 1e-5  # m that a side of a building of right angles may be off
JOINT = 0.03  # m that it may be where a region is cut at walls of another angle: steps become their line
STANDING = 0.35  # of the height below 2 m: less is a lintel's lower end, a skirting, noise


def assert_valid(plan: FloorPlan) -> None:
    """Every invariant of a plan; the message names the one that broke."""
    assert_coverage(plan.regions, {0.0, *(wing.turn for wing in plan.wings)})
    assert_exported_coverage(plan)
    assert_no_wall_inside(plan)
    assert_doors(plan)
    assert_flags(plan)


def assert_coverage(regions: tuple[Region, ...], turns: Collection[float] = (0.0,)) -> None:
    """Valid, disjoint polygons with unique names, whose sides lie along the axes of a part of the building.

    :param turns: radians from the plan's axes to those of each part.
    """
    exact = STEP if len(turns) == 1 else JOINT
    polygons = np.array([r.polygon for r in regions])
    assert shapely.is_valid(polygons).all()
    assert len({r.id for r in regions}) == len({r.name for r in regions}) == len(regions)
    for i, a in enumerate(polygons):
        for b in polygons[i + 1 :]:
            assert shapely.intersection(a, b).area < 1e-5
    for region in regions:
        assert region.polygon.geom_type == "Polygon"
        assert region.polygon.exterior.is_ccw
        for ring in (region.polygon.exterior, *region.polygon.interiors):
            steps = np.diff(np.asarray(ring.coords), axis=0)
            slant = np.min([np.abs(turned(steps, -turn)).min(axis=1) for turn in turns], axis=0)
            assert (slant < exact).all(), f"a slanted side of {region.name}: {slant.max():.3f} m"


def assert_exported_coverage(plan: FloorPlan) -> None:
    """What is written to plan.geojson is a valid coverage: edges match vertex by vertex."""
    features = json.loads(geojson_text(plan))["features"]
    written = [shapely.geometry.shape(f["geometry"]) for f in features if f["properties"]["kind"] == "region"]
    assert len(written) == len(plan.regions)
    assert shapely.is_valid(written).all()
    assert shapely.coverage_is_valid(written)


def _walls(plan: FloorPlan) -> list[tuple[LayoutPlane, shapely.LineString]]:
    """Where wall stands on the floor: runs of paired planes that were seen over a third of the height.

    Where a person said otherwise, only what is left of the walls.
    """
    out = []
    for plane in plan.all_planes:
        out += [(plane, _line(plane, a, b)) for a, b in plane.walls if plane.by_hand == "added"]
        if plane.profile is None or plane.support < plan.config.planes.min_support:
            continue
        mask = np.concatenate([[False], plane.profile.low >= STANDING, [False]]).astype(np.int8)
        for run in np.flatnonzero(np.diff(mask)).reshape(-1, 2):
            start, end = plane.profile.start + run * plane.profile.step
            left = [(start, end)]
            if plan.corrected:
                left = [(max(start, a), min(end, b)) for a, b in plane.walls if min(end, b) > max(start, a)]
            out += [(plane, _line(plane, a, b)) for a, b in left]
    return out


def _line(plane: LayoutPlane, start: float, end: float) -> shapely.LineString:
    return shapely.LineString([plane.point(start), plane.point(end)])


def assert_no_wall_inside(plan: FloorPlan) -> None:
    """No wall that was seen to stand on the floor runs through the interior of a region."""
    cores = [r.polygon.buffer(-INSIDE, join_style="mitre") for r in plan.regions]
    for plane, line in _walls(plan):
        for region, core in zip(plan.regions, cores, strict=True):
            inside = line.intersection(core).length
            assert inside < SHORTEST, f"{inside:.2f} m of {line} of {plane.id} in region {region.name}"


def assert_doors(plan: FloorPlan) -> None:
    """No door lies in a region's interior; each joins one or two regions, which know of it."""
    regions = {r.id: r for r in plan.regions}
    for door in plan.doors:
        middle = shapely.Point(door.line().mean(axis=0))
        for region in plan.regions:
            core = region.polygon.buffer(-INSIDE, join_style="mitre")
            assert not core.contains(middle), f"{door} in region {region.name}"
        assert 1 <= len(door.connects) == len(set(door.connects)) <= 2
        for name in door.connects:
            assert door.id in regions[name].doors
            assert regions[name].polygon.distance(middle) < 1.0
        assert door.end > door.start
        assert 0 <= door.confidence <= 1
        assert door.evidence
    known = {d.id: d for d in plan.doors}
    assert all(r.id in known[d].connects for r in plan.regions for d in r.doors)


def assert_flags(plan: FloorPlan) -> None:
    """Seen and predicted are told apart, and the numbers agree with the grid."""
    planes = {p.id: p for p in (*plan.planes, *(p for wing in plan.wings for p in wing.planes))}
    grid = plan.grid
    assert ((grid.states == FREE) | ~grid.universe).all()  # the universe is free
    for region in plan.regions:
        mask = polygon_mask(region.polygon, grid.origin, grid.cell, grid.states.shape)
        assert region.total_cells == mask.sum()
        assert region.free_cells == grid.universe[mask].sum()
        assert 0 <= region.speculated_fraction <= 1
        assert 0 <= region.confidence <= 1
        assert region.label
        total = sum(s.length for s in region.sides)
        rings = region.polygon.exterior.length + sum(r.length for r in region.polygon.interiors)
        assert abs(total - rings) < 1e-3
        for side in region.sides:
            assert 0 <= side.observed <= 1
            assert side.speculated == (side.observed < 0.5)
            if side.plane:
                assert not planes[side.plane].speculated  # a plane that was seen explains what was seen
    free = sum(r.free_cells for r in plan.regions)
    assert free <= grid.universe.sum()
    assert 0 <= plan.speculated().area <= sum(r.area for r in plan.regions) + 1e-6
    left = int(plan.cover.uncovered.sum()) * grid.cell**2
    assert (left > 1.0) == any("in no region" in w for w in plan.warnings)
