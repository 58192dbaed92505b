"""From a walk to sensor poses: speed, gaze, drift of the estimate, and the world frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.simulation.spec import SensorSpec, SurveySpec
from floorplan_core.simulation.walk import Walk

Float = NDArray[np.float64]

TURN_RATE = 45.0  # degrees per second while looking around
PAN_PERIOD = 9.0  # s of one panning cycle
STATION_STEP = 5.0  # m between tripod stations in the circulation
DRIFT_SCALE = 8.0  # m of path over which the drift changes
HEADING_SPAN = 0.8  # m of path that the walking direction is averaged over


@dataclass(frozen=True)
class Poses:
    """Where the sensor was, in the building's axes. All arrays share their first axis."""

    stamps: Float  # (M,) seconds
    T_building_sensor: Float  # (M, 4, 4) true poses
    drift: Float  # (M, 4, 4) what the estimate adds on the left, building axes


def rotation(axis: int, angle: Float | float) -> Float:
    """(..., 3, 3) right-handed rotations about a coordinate axis, radians."""
    angle = np.asarray(angle, dtype=np.float64)
    c, s = np.cos(angle), np.sin(angle)
    R = np.zeros((*angle.shape, 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R[..., axis, axis] = 1
    R[..., i, i], R[..., i, j], R[..., j, i], R[..., j, j] = c, -s, s, c
    return R


def world_from_building(spec: SurveySpec, yaw_deg: float) -> Float:
    """(4, 4): yaw about z, then pitch about y, then roll about x of the world, then the offset."""
    T = np.eye(4)
    roll, pitch = np.deg2rad([spec.roll_deg, spec.pitch_deg])
    T[:3, :3] = rotation(0, roll) @ rotation(1, pitch) @ rotation(2, np.deg2rad(yaw_deg))
    T[:3, 3] = spec.offset_x, spec.offset_y, spec.offset_z
    return T


def sensor_poses(walk: Walk, spec: SurveySpec, rng: np.random.Generator) -> Poses:
    """True poses of every scan and the drift of their estimates."""
    sensor = spec.sensor
    if sensor.kind == "station":
        stamps, xy, heading, wobble = _stations(walk, sensor, rng)
    else:
        stamps, xy, heading = _moving(walk, sensor)
        wobble = np.deg2rad(sensor.wobble) * _slow_noise(len(stamps), 2, 6, rng)
    T = np.tile(np.eye(4), (len(stamps), 1, 1))
    T[:, :3, :3] = rotation(2, heading) @ rotation(1, wobble[:, 0]) @ rotation(0, wobble[:, 1])
    T[:, :3, :3] @= rotation(1, np.deg2rad(sensor.tilt))
    T[:, :2, 3], T[:, 2, 3] = xy, sensor.height
    return Poses(stamps, T, _drift(T, spec, rng))


def _moving(walk: Walk, sensor: SensorSpec) -> tuple[Float, Float, Float]:
    """Stamps, positions and headings at the sensor's rate along the path, with turns at the stops."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(walk.path, axis=0).T))])
    pause = sensor.look_around / TURN_RATE
    looks = walk.stops[walk.look] if pause > 0 else walk.stops[:0]
    before = np.searchsorted(looks, np.arange(len(arc)), side="left")  # turns finished before each row
    clock = arc / sensor.speed + pause * before
    # a stop appears twice: before its turn and after it
    times = np.concatenate([clock, clock[looks] + pause])
    order = np.argsort(times, kind="stable")
    times, arcs = times[order], np.concatenate([arc, arc[looks]])[order]
    turned = np.concatenate([before, before[looks] + 1])[order] * np.deg2rad(sensor.look_around)
    stamps = np.arange(0.0, times[-1] + 1e-9, sensor.interval)
    s = np.interp(stamps, times, arcs)
    xy = np.column_stack([np.interp(s, arc, walk.path[:, k]) for k in (0, 1)])
    pan = np.deg2rad(sensor.pan) * np.sin(2 * np.pi * stamps / PAN_PERIOD)
    return stamps, xy, _heading(walk.path, arc, s) + np.interp(stamps, times, turned) + pan


def _heading(path: Float, arc: Float, s: Float) -> Float:
    """(M,) direction of the path around arc length ``s``, radians, unwrapped."""
    ahead, behind = (
        np.column_stack([np.interp(s + d, arc, path[:, k]) for k in (0, 1)])
        for d in (HEADING_SPAN / 2, -HEADING_SPAN / 2)
    )
    step = ahead - behind
    return np.asarray(np.unwrap(np.arctan2(step[:, 1], step[:, 0])))


def _stations(walk: Walk, sensor: SensorSpec, rng: np.random.Generator) -> tuple[Float, Float, Float, Float]:
    """Tripods at one waypoint of each room and every few metres of circulation; level, any heading."""
    chosen: list[int] = []
    halls: list[int] = []
    rooms: set[int] = set()
    for row, space in zip(walk.stops, walk.stop_space, strict=True):
        at = walk.path[row]
        if space > 0 and space not in rooms:
            rooms.add(int(space))
            chosen.append(int(row))
        elif space == 0 and all(np.hypot(*(at - walk.path[c])) > STATION_STEP for c in halls):
            halls.append(int(row))
            chosen.append(int(row))
    xy = walk.path[chosen]
    stamps = sensor.interval * np.arange(len(chosen), dtype=np.float64)
    return stamps, xy, rng.uniform(-np.pi, np.pi, len(chosen)), np.zeros((len(chosen), 2))


def _slow_noise(count: int, columns: int, span: int, rng: np.random.Generator) -> Float:
    """(count, columns) smooth noise of about unit standard deviation that changes over ``span`` rows."""
    span = max(1, min(span, count))
    kernel = np.hanning(2 * span + 1)
    raw = rng.standard_normal((count + 2 * span, columns))
    smooth = np.column_stack([np.convolve(raw[:, k], kernel, "valid") for k in range(columns)])
    return np.asarray(smooth / np.sqrt((kernel**2).sum()), dtype=np.float64)


def _drift(T: Float, spec: SurveySpec, rng: np.random.Generator) -> Float:
    """(M, 4, 4) slow errors of the estimate, zero at the start; their largest values are the spec's."""
    step = np.hypot(*np.diff(T[:, :2, 3], axis=0).T)
    mean_step = float(step.mean()) if len(step) else 1.0
    span = max(1, round(DRIFT_SCALE / max(mean_step, 0.01)))
    walk = np.cumsum(_slow_noise(len(T), 4, span, rng), axis=0)
    walk -= walk[0]
    largest = np.hypot(walk[:, 0], walk[:, 1]).max(), np.abs(walk[:, 3]).max()
    shift = walk[:, :3] * [1, 1, 0.3] * (spec.drift / max(largest[0], 1e-12))
    turn = walk[:, 3] * np.deg2rad(spec.drift_yaw_deg) / max(largest[1], 1e-12)
    D = np.tile(np.eye(4), (len(T), 1, 1))
    D[:, :3, :3] = rotation(2, turn)
    # the heading errs about the sensor, not about the origin
    origin = T[:, :3, 3]
    D[:, :3, 3] = origin + shift - np.einsum("mij,mj->mi", D[:, :3, :3], origin)
    return D


def quaternions(R: Float) -> Float:
    """(M, 3, 3) rotations to (M, 4) unit quaternions x, y, z, w with w >= 0."""
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_matrix(R).as_quat(canonical=True))
