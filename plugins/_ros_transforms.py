"""The tree of frames of a ROS recording: where a sensor was at any time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins._ros_messages import Pose, matrices

Float = NDArray[np.float64]

WORLD_FRAMES = ("map", "odom", "world", "camera_init", "local_origin", "earth", "global")
TOLERANCE = 0.1  # seconds from the nearest known pose: a walker moves a voxel
MAX_GAP = 2.0  # seconds between poses across which it is interpolated
STILL = 1e-6  # of any number of a pose: it did not move
MAX_DEPTH = 32  # frames between a sensor and the root


@dataclass
class Edge:
    """One frame in its parent over time."""

    parent: str
    seconds: list[float] = field(default_factory=list)
    poses: list[Pose] = field(default_factory=list)  # T_parent_child
    static: bool = False

    @property
    def moves(self) -> bool:
        """True where it was not always in the same place."""
        return not self.static and bool(np.ptp(matrices(self.poses), axis=0).max() > STILL)

    def at(self, times: Float) -> tuple[Float, NDArray[np.bool_]]:
        """(N, 4, 4) poses at (N,) ``times``, and where they are known."""
        if self.static or len(self.poses) == 1:
            known = np.full(len(times), True) if self.static else np.abs(times - self.seconds[0]) <= TOLERANCE
            return np.tile(matrices(self.poses[:1]), (len(times), 1, 1)), known
        order = np.argsort(self.seconds, kind="stable")
        return interpolate(np.array(self.seconds)[order], matrices(self.poses)[order], times)


class FrameTree:
    """Frames, each with one parent."""

    def __init__(self) -> None:
        self.edges: dict[str, Edge] = {}

    def add(self, parent: str, child: str, seconds: float, pose: Pose, static: bool) -> None:
        """One observation; the first parent of a frame stays its parent."""
        if parent == child:
            return
        edge = self.edges.setdefault(child, Edge(parent, static=static))
        if edge.parent != parent or (static and edge.poses):
            return
        edge.seconds.append(seconds)
        edge.poses.append(pose)

    def chain(self, frame: str) -> list[str]:
        """Frames from ``frame`` up to the root; stops where it would go in circles."""
        chain = [frame]
        while chain[-1] in self.edges and len(chain) < MAX_DEPTH:
            parent = self.edges[chain[-1]].parent
            if parent in chain:
                break
            chain.append(parent)
        return chain

    def moves(self, frame: str) -> bool:
        """True where some frame between ``frame`` and the root moves, or stands still in a world.

        What is only sent again and again, as ROS 1 does with how a sensor is mounted, moves nothing.
        """
        chain = self.chain(frame)
        return any(self.edges[f].moves for f in chain[:-1]) or (len(chain) > 1 and chain[-1] in WORLD_FRAMES)

    def between(self, one: str, other: str) -> Float | None:
        """(4, 4) T_one_other as it was first; None where no transforms join them."""
        meeting = self._meeting(one, other)
        if meeting is None:
            return None
        up, down = (self._first(frame, meeting) for frame in (one, other))
        return np.asarray(np.linalg.inv(up) @ down)

    def apart(self, one: str, other: str) -> bool:
        """True where nothing joins two frames, or something moves between them."""
        meeting = self._meeting(one, other)
        if meeting is None:
            return True
        ways = (self.chain(frame) for frame in (one, other))
        return any(self.edges[f].moves for way in ways for f in way[: way.index(meeting)])

    def _meeting(self, one: str, other: str) -> str | None:
        """The first frame that is above both, or one of them."""
        above = self.chain(other)
        return next((frame for frame in self.chain(one) if frame in above), None)

    def _first(self, frame: str, above: str) -> Float:
        """(4, 4) T_above_frame as it was first."""
        chain, total = self.chain(frame), np.eye(4)
        for child in chain[: chain.index(above)]:
            total = matrices(self.edges[child].poses[:1])[0] @ total
        return total

    def poses(self, frame: str, times: Float) -> tuple[Float, NDArray[np.bool_]]:
        """(N, 4, 4) T_root_frame at (N,) ``times``, and where all of the chain is known."""
        total, known = np.tile(np.eye(4), (len(times), 1, 1)), np.full(len(times), True)
        for child in self.chain(frame)[:-1]:
            T, there = self.edges[child].at(times)
            total, known = T @ total, known & there
        return total, known


def interpolate(seconds: Float, poses: Float, times: Float) -> tuple[Float, NDArray[np.bool_]]:
    """(N, 4, 4) poses between rising ``seconds``; known near a pose, or between two close in time."""
    after = np.clip(np.searchsorted(seconds, times), 1, len(seconds) - 1)
    before = after - 1
    gap = seconds[after] - seconds[before]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.clip(np.where(gap > 0, (times - seconds[before]) / gap, 0.0), 0.0, 1.0)
    nearest = np.minimum(np.abs(times - seconds[before]), np.abs(times - seconds[after]))
    inside = (times >= seconds[before]) & (times <= seconds[after]) & (gap <= MAX_GAP)
    result = poses[before].copy()
    result[:, :3, 3] += share[:, None] * (poses[after] - poses[before])[:, :3, 3]
    result[:, :3, :3] = _between(poses[before, :3, :3], poses[after, :3, :3], share)
    return result, inside | (nearest <= TOLERANCE)


def _between(a: Float, b: Float, share: Float) -> Float:
    """Rotations a share of the way from ``a`` to ``b`` (along the shortest arc)."""
    from scipy.spatial.transform import Rotation

    step = Rotation.from_matrix(np.swapaxes(a, 1, 2) @ b).as_rotvec()
    return np.asarray(a @ Rotation.from_rotvec(share[:, None] * step).as_matrix())
