"""The documented ``truth.json``, and what it holds beyond the contract.

Positions are metres in the building's own axes; ``T_world_building`` (4x4, row-major) takes them to world:
yaw about z first, then ``pitch_deg`` about y, then ``roll_deg`` about x, then ``offset``.

=================  ========================================================================================
``rooms[]``        ``kind`` (room, corridor), ``polygon``, ``entered``; more: ``use`` (office, hall, ...),
                   ``holes`` (rings, where the circulation runs around a core), ``seen`` (share of the floor
                   that some pose had in free sight at the sensor's height)
``doors[]``        ``bounds``, ``joins``; more: ``width``, ``height``, ``kind`` (door, double, opening: no
                   leaf), ``open``, ``axis`` (0: the wall's normal is x)
``dimensions[]``   ``id`` "room.number" with the axis, ``from``, ``to``, ``metres``; more: ``room``
``windows[]``      ``bounds``, ``room``, ``sill``, ``head``, ``axis``
``columns[]``      x0, y0, x1, y1; they stand in the rooms and are no part of the polygons
``furniture[]``    ``kind``, ``room``, ``bounds`` x0, y0, z0, x1, y1, z1
others             ``wall_height``, ``exterior_wall``, ``seed``, ``spec`` (all settings of the run)
=================  ========================================================================================

Halls behind an opening with a lintel are rooms; lobbies without any wall towards the corridor are part of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.building import Building, DoorOpening, Space, WindowOpening, solid_hulls
from floorplan_core.simulation.poses import Poses
from floorplan_core.simulation.sensors import Scene
from floorplan_core.simulation.spec import SurveySpec
from floorplan_core.simulation.walk import Walk

Float = NDArray[np.float64]

LASER = 1.0  # m above the floor at which a laser meter is shot
SPOT = 0.05  # m around the shot that must hit plain wall
SEEN_CELL = 0.3  # m between the places of a floor that are tested for being seen
SEEN_POSES = 250  # poses that are tested at most


def ground_truth(
    spec: SurveySpec,
    building: Building,
    walk: Walk,
    poses: Poses,
    T_world_building: Float,
    yaw_deg: float,
    scene: Scene,
) -> dict[str, Any]:
    """The whole of ``truth.json`` as plain data; lengths in metres, the building's own axes."""
    seen = seen_fractions(building, poses, spec, scene)
    return {
        "version": 1,
        "yaw_deg": yaw_deg,
        "height": building.height,
        "wall": building.interior_wall,
        "rooms": [
            _room(space, index in walk.entered, seen[index]) for index, space in enumerate(building.spaces)
        ],
        "doors": [_door(door) for door in building.doors],
        "dimensions": dimensions(building),
        # Beyond the contract: what only a simulation knows.
        "wall_height": building.height,
        "exterior_wall": building.exterior_wall,
        "windows": [_window(window) for window in building.windows],
        "columns": building.columns.tolist(),
        "furniture": [
            {"kind": f.kind, "room": f.space, "bounds": np.round(f.bounds, 3).tolist()}
            for f in building.furniture
        ],
        "roll_deg": spec.roll_deg,
        "pitch_deg": spec.pitch_deg,
        "offset": [spec.offset_x, spec.offset_y, spec.offset_z],
        "T_world_building": T_world_building.tolist(),
        "seed": spec.seed,
        "spec": asdict(spec),
    }


def _room(space: Space, entered: bool, seen: float) -> dict[str, Any]:
    polygon = space.polygon
    room: dict[str, Any] = {
        "kind": space.kind,
        "use": space.use,
        "polygon": _ring(polygon.exterior),
        "entered": entered,
        "seen": round(seen, 3),
    }
    if polygon.interiors:
        room["holes"] = [_ring(hole) for hole in polygon.interiors]
    return room


def _ring(ring: Any) -> list[list[float]]:
    """Vertices without the repeated last one, counter-clockwise."""
    import shapely

    at = np.asarray(ring.coords)[:-1]
    return [[float(x), float(y)] for x, y in (at if shapely.is_ccw(ring) else at[::-1])]


def _door(door: DoorOpening) -> dict[str, Any]:
    return {
        "bounds": list(door.bounds),
        "joins": list(door.joins),
        "width": round(door.width, 3),
        "height": door.height,
        "kind": door.kind,
        "open": door.open,
        "axis": door.axis,
    }


def _window(window: WindowOpening) -> dict[str, Any]:
    return {
        "bounds": list(window.bounds),
        "room": window.space,
        "sill": window.sill,
        "head": window.head,
        "axis": window.axis,
    }


def dimensions(building: Building) -> list[dict[str, Any]]:
    """Two per rectangle of each space (width along x, depth along y) where a laser meter hits plain walls."""
    blockers = _laser_blockers(building)
    found: list[dict[str, Any]] = []
    for index, space in enumerate(building.spaces):
        lines = {line for rect in space.rects for line in _shots(space.rects, rect, blockers)}
        for number, (x0, y0, x1, y1) in enumerate(sorted(lines)):
            length = round(abs(x1 - x0) + abs(y1 - y0), 3)
            name = f"{index}.{number}{'x' if x1 > x0 else 'y'}"
            found.append({"id": name, "room": index, "from": [x0, y0], "to": [x1, y1], "metres": length})
    return found


def _laser_blockers(building: Building) -> Float:
    """(N, 4) what a shot must neither cross nor end on: holes in walls, and things at the laser's height."""
    hulls = [solid_hulls(f.solids) for f in building.furniture] + [
        solid_hulls(d.leaves) for d in building.doors
    ]
    things = np.vstack([*hulls, np.zeros((0, 6))])
    at_laser = things[(things[:, 2] < LASER) & (things[:, 5] > LASER)][:, [0, 1, 3, 4]]
    holes = [d.bounds for d in building.doors] + [w.bounds for w in building.windows]
    return np.vstack([at_laser, building.columns, np.array(holes).reshape(-1, 4)])


def _shots(rects: Float, rect: Float, blockers: Float) -> Iterator[tuple[float, float, float, float]]:
    """One line along x and one along y through ``rect``, as far as the space reaches."""
    for axis in (0, 1):
        other = 1 - axis
        for at in _tries(rect[other], rect[other + 2]):
            low, high = _reach(rects, axis, at, (rect[axis] + rect[axis + 2]) / 2)
            line = np.array([low, at, high, at] if axis == 0 else [at, low, at, high])
            grown = line + SPOT * np.array([-1, -1, 1, 1])
            hit = (blockers[:, :2] < grown[2:]) & (blockers[:, 2:] > grown[:2])
            if not hit.all(axis=1).any():
                yield tuple(round(float(v), 3) for v in line)  # type: ignore[misc]
                break


def _tries(low: float, high: float) -> Float:
    """Places between two walls, the middle first."""
    parts = np.linspace(0.04, 0.96, 47)
    return low + (high - low) * parts[np.argsort(np.abs(parts - 0.5), kind="stable")]


def _reach(rects: Float, axis: int, at: float, through: float) -> tuple[float, float]:
    """The extent of the union of ``rects`` along ``axis`` on the line ``other = at`` around ``through``."""
    other = 1 - axis
    mine = rects[(rects[:, other] < at) & (rects[:, other + 2] > at)]
    low = high = through
    for _ in range(len(mine)):
        touching = mine[(mine[:, axis] <= high) & (mine[:, axis + 2] >= low)]
        low, high = min(low, touching[:, axis].min()), max(high, touching[:, axis + 2].max())
    return float(low), float(high)


def seen_fractions(building: Building, poses: Poses, spec: SurveySpec, scene: Scene) -> list[float]:
    """For each space the share of its floor that some pose had in free sight at the sensor's height."""
    floor, owner = _floor_samples(building, spec.sensor.height)
    seen = np.zeros(len(floor), dtype=bool)
    chosen = np.unique(np.linspace(0, len(poses.stamps) - 1, SEEN_POSES).round().astype(int))
    half = np.deg2rad(spec.sensor.horizontal_fov) / 2
    for T in poses.T_building_sensor[chosen]:
        near = np.flatnonzero(~seen & (np.hypot(*(floor - T[:3, 3])[:, :2].T) < spec.sensor.max_range))
        ray = floor[near] - T[:3, 3]
        bearing = np.arctan2(ray @ T[:3, 1], ray @ T[:3, 0])
        near, ray = near[np.abs(bearing) <= half], ray[np.abs(bearing) <= half]
        rays = np.hstack([np.tile(T[:3, 3], (len(near), 1)), ray]).astype(np.float32)
        seen[near] = scene.ranges(rays) >= 1 - 1e-4 if len(near) else False
    counts = np.bincount(owner, minlength=len(building.spaces))
    hits = np.bincount(owner, weights=seen, minlength=len(building.spaces))
    return [float(v) for v in hits / np.maximum(counts, 1)]


def _floor_samples(building: Building, height: float) -> tuple[Float, NDArray[np.int64]]:
    """(N, 3) places at the sensor's height over every floor, and the space of each."""
    parts, owners = [], []
    for index, space in enumerate(building.spaces):
        for x0, y0, x1, y1 in space.rects:
            x, y = np.meshgrid(_centres(x0, x1), _centres(y0, y1))
            parts.append(np.column_stack([x.ravel(), y.ravel(), np.full(x.size, height)]))
            owners.append(np.full(x.size, index))
    return np.vstack(parts), np.concatenate(owners)


def _centres(low: float, high: float) -> Float:
    count = max(1, int((high - low) / SEEN_CELL))
    return np.asarray(low + (high - low) * (np.arange(count) + 0.5) / count)
