"""Tiny buildings made of boxes, and a ray caster in numpy: surveys whose truth is known to the millimetre.

Nothing of the project is used to make them. Rooms lie in building axes with the floor at z = 0; ``survey``
turns, tilts and shifts them into a world of one's choice.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from floorplan_core.config import Config
from floorplan_core.errors import FloorPlanError
from floorplan_core.model import FloorPlan, PointChunk, Reconstruction, Trajectory
from floorplan_core.model.corrections import Correction
from floorplan_core.observer import Observer
from floorplan_core.pipeline import FloorPlanner

HEIGHT = 2.6  # m, floor to ceiling
SLAB = 0.2  # m, thickness of floor and ceiling
LINTEL = 2.1  # m, height of a door
EYE = 1.4  # m, height of the sensor

Box = tuple[float, float, float, float, float, float]  # x0, y0, z0, x1, y1, z1
Opening = tuple[float, float, float]  # from, to along the wall; height of the lintel


def wall(axis: int, near: float, far: float, start: float, end: float, *openings: Opening) -> list[Box]:
    """A wall across ``axis`` between its faces ``near`` and ``far``, with openings from the floor."""
    boxes, at = [], start
    for a, b, top in sorted(openings):
        boxes += [_box(axis, near, far, at, a, 0.0, HEIGHT)]
        if top < HEIGHT:
            boxes += [_box(axis, near, far, a, b, top, HEIGHT)]
        at = b
    return [*boxes, _box(axis, near, far, at, end, 0.0, HEIGHT)]


def _box(axis: int, u0: float, u1: float, v0: float, v1: float, z0: float, z1: float) -> Box:
    return (u0, v0, z0, u1, v1, z1) if axis == 0 else (v0, u0, z0, v1, u1, z1)


def slabs(x0: float, y0: float, x1: float, y1: float, ceiling: bool = True) -> list[Box]:
    """Floor and ceiling under and over all that lies between two corners."""
    floor = (x0, y0, -SLAB, x1, y1, 0.0)
    return [floor, (x0, y0, HEIGHT, x1, y1, HEIGHT + SLAB)] if ceiling else [floor]


def room(width: float, depth: float, thick: float = 0.2, ceiling: bool = True) -> list[Box]:
    """One closed room: its inside is 0 .. width by 0 .. depth."""
    t = thick
    return [
        *slabs(-t, -t, width + t, depth + t, ceiling),
        *wall(0, -t, 0, -t, depth + t),
        *wall(0, width, width + t, -t, depth + t),
        *wall(1, -t, 0, 0, width),
        *wall(1, depth, depth + t, 0, width),
    ]


def two_rooms(*openings: Opening, width: float = 4.0, depth: float = 5.0, thick: float = 0.1) -> list[Box]:
    """Two rooms side by side, x from 0 to width and from width + thick on; openings in the wall between."""
    far, t = 2 * width + thick, 0.2
    return [
        *slabs(-t, -t, far + t, depth + t),
        *wall(0, -t, 0, -t, depth + t),
        *wall(0, far, far + t, -t, depth + t),
        *wall(0, width, width + thick, 0, depth, *openings),
        *wall(1, -t, 0, 0, far),
        *wall(1, depth, depth + t, 0, far),
    ]


def cast(boxes: Sequence[Box], origin: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """(N,) distance to the first box along each of (N, 3) unit directions; infinite where there is none."""
    b = np.array(boxes)
    with np.errstate(divide="ignore", invalid="ignore"):
        one = (b[None, :, :3] - origin) / directions[:, None, :]
        two = (b[None, :, 3:] - origin) / directions[:, None, :]
    enter = np.nanmax(np.minimum(one, two), axis=2)
    leave = np.nanmin(np.maximum(one, two), axis=2)
    return np.where((enter <= leave) & (enter > 0), enter, np.inf).min(axis=1)


def scan(
    boxes: Sequence[Box],
    origin: Sequence[float],
    rng: np.random.Generator,
    noise: float,
    rays: tuple[int, int],
) -> np.ndarray:
    """(N, 3) points about ``origin``, building axes; ``rays`` around and from below to above."""
    around = (np.arange(rays[0]) + rng.uniform()) * 2 * np.pi / rays[0]
    up = np.radians(np.linspace(-80, 80, rays[1]) + rng.uniform(-0.5, 0.5))
    a, e = (m.ravel() for m in np.meshgrid(around, up))
    directions = np.column_stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    distance = cast(boxes, np.array(origin, dtype=float), directions)
    hit = np.isfinite(distance)
    return directions[hit] * (distance[hit] + rng.normal(0, noise, int(hit.sum())))[:, None]


def stations(
    width: float, depth: float, x0: float = 0.0, y0: float = 0.0
) -> list[tuple[float, float, float]]:
    """Four places in a room."""
    return [
        (x0 + width * u, y0 + depth * v, EYE) for u, v in ((0.25, 0.3), (0.7, 0.25), (0.75, 0.7), (0.3, 0.8))
    ]


@dataclass(frozen=True)
class Survey:
    """A survey in memory; the building's axes are ``(world - shift) @ rotation``."""

    points: np.ndarray  # (N, 3) metres, world
    scan_id: np.ndarray  # (N,)
    poses: np.ndarray  # (M, 4, 4) T_world_sensor
    rotation: np.ndarray  # (3, 3) building to world

    def reconstruction(
        self, chunk: int = 50_000, trajectory: bool = True, name: str = "boxes"
    ) -> Reconstruction:
        def chunks() -> Iterator[PointChunk]:
            for at in range(0, len(self.points), chunk):
                ids = self.scan_id[at : at + chunk] if trajectory else None
                yield PointChunk(self.points[at : at + chunk], ids)

        path = Trajectory(np.arange(len(self.poses), dtype=float), self.poses) if trajectory else None
        return Reconstruction(name, chunks, len(self.points), path, scans_ordered=True)


def rotation(yaw_deg: float = 0.0, roll_deg: float = 0.0, pitch_deg: float = 0.0) -> np.ndarray:
    """Building to world: yaw first, then the tilt."""
    y, r, p = np.radians([yaw_deg, roll_deg, pitch_deg])
    z = np.array([[np.cos(y), -np.sin(y), 0], [np.sin(y), np.cos(y), 0], [0, 0, 1]])
    x = np.array([[1, 0, 0], [0, np.cos(r), -np.sin(r)], [0, np.sin(r), np.cos(r)]])
    return x @ np.array([[np.cos(p), 0, np.sin(p)], [0, 1, 0], [-np.sin(p), 0, np.cos(p)]]) @ z


def survey(
    boxes: Sequence[Box],
    places: Sequence[Sequence[float]],
    noise: float = 0.01,
    seed: int = 0,
    rays: tuple[int, int] = (240, 80),
    turned: np.ndarray | None = None,
) -> Survey:
    """Scans from ``places``, in a world turned by ``turned`` (building to world)."""
    rng = np.random.default_rng(seed)
    turned = np.eye(3) if turned is None else turned
    poses = np.tile(np.eye(4), (len(places), 1, 1))
    poses[:, :3, :3] = turned
    poses[:, :3, 3] = np.array(places) @ turned.T
    scans = [scan(boxes, place, rng, noise, rays) for place in places]
    world = [s @ T[:3, :3].T + T[:3, 3] for s, T in zip(scans, poses, strict=True)]
    ids = np.repeat(np.arange(len(scans), dtype=np.int32), [len(s) for s in scans])
    return Survey(np.concatenate(world), ids, poses, turned)


@dataclass
class Recorder(Observer):
    """Keeps what every stage made."""

    made: list[tuple[str, Any]] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self.made.append((stage, result))


@dataclass(frozen=True)
class Run:
    """All results of one run; ``plan`` is None where the run ended with ``error``."""

    steps: list[tuple[str, Any]]
    plan: FloorPlan | None
    error: FloorPlanError | None

    def __getitem__(self, stage: str) -> Any:
        """The first result of a stage (of occupancy: the evidence)."""
        return next(result for name, result in self.steps if name == stage)


def run(
    given: Survey,
    config: Config | None = None,
    trajectory: bool = True,
    corrected: Callable[[FloorPlan], Sequence[Correction]] = lambda plan: (),
) -> Run:
    """Everything that the stages make of a survey; by default in the axes of its world, as the boxes are.

    :param corrected: what somebody says of the plan, which is made again then.
    """
    recorder = Recorder()
    config = config or Config().with_values({"voxels.own_axes": "false"})
    planner = FloorPlanner(config, recorder, "boxes")
    data = given.reconstruction(trajectory=trajectory)
    for chunk in data.chunks():
        planner.integrate_chunk(chunk, data.trajectory)
    try:
        plan = planner.plan()
        said = corrected(plan)
        return Run(recorder.made, planner.plan(corrections=said) if said else plan, None)
    except FloorPlanError as error:
        return Run(recorder.made, None, error)
