"""Where the sensors of a ROS recording were: by a given trajectory, by transforms or by odometry."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins import _ros_messages as ros
from floorcast_plugins._ros_transforms import TOLERANCE, WORLD_FRAMES, FrameTree, interpolate
from floorplan_core.api import InputError, Trajectory

Float = NDArray[np.float64]
TRANSFORMS = (ros.TF, ros.TF_OLD)
TRACKS = (ros.ODOMETRY, ros.POSE, ros.TRANSFORM)  # in this order of trust


@dataclass(frozen=True)
class Placed:
    """Poses of all messages of a topic."""

    poses: Float | None  # (N, 4, 4) T_world_sensor; None: points are in the world, viewpoints unknown
    known: NDArray[np.bool_]  # (N,)
    in_world: bool  # points are in the world's frame already
    note: str


@dataclass
class Places:
    """What a recording says of where its frames were; filled by a pass over it."""

    name: str
    listed: str  # the recording's topics, for a sentence
    given: Trajectory | None  # of the sensor, from the user: goes before all else
    tree: FrameTree = field(default_factory=FrameTree)
    tracks: dict[str, Any] = field(default_factory=dict)

    def take(self, message: Any, connection: Any) -> None:
        """Add a transform to the tree, or a pose to the track of its topic."""
        if connection.msgtype in TRANSFORMS:
            for t in message.transforms:
                pose = ros.pose_of(t.transform.translation, t.transform.rotation)
                parent, child = ros.clean_frame(t.header.frame_id), ros.clean_frame(t.child_frame_id)
                static = "static" in connection.topic
                self.tree.add(parent, child, ros.seconds_of(t.header.stamp), pose, static)
            return
        start = {"type": connection.msgtype, "seconds": [], "poses": []}
        track = self.tracks.setdefault(connection.topic, start)
        if connection.msgtype == ros.TRANSFORM:
            pose = ros.pose_of(message.transform.translation, message.transform.rotation)
        else:
            inner = message.pose.pose if connection.msgtype == ros.ODOMETRY else message.pose
            pose = ros.pose_of(inner.position, inner.orientation)
        track["seconds"].append(ros.seconds_of(message.header.stamp))
        track["poses"].append(pose)
        track["frame"] = ros.clean_frame(message.header.frame_id)
        track["child"] = ros.clean_frame(getattr(message, "child_frame_id", ""))

    def place(self, frame: str, seconds: Float) -> Placed:
        """Where ``frame`` was at (N,) ``seconds``; :class:`InputError` where nothing tells."""
        in_world = frame in WORLD_FRAMES
        if self.given is not None:
            known = _interpolated(self.given.stamps, self.given.T_world_sensor, seconds)
            return Placed(*known, in_world, "The given trajectory places the scans by their times.")
        if not in_world and self.tree.moves(frame):
            root = self.tree.chain(frame)[-1]
            note = f"Transforms place the frame {frame} in {root}."
            return Placed(*self.tree.poses(frame, seconds), False, note)
        best = max(
            sorted(t for t in self.tracks if len(self.tracks[t]["poses"]) > 1),
            key=lambda t: (-TRACKS.index(self.tracks[t]["type"]), len(self.tracks[t]["poses"])),
            default=None,
        )
        if best is not None:
            return self._by_track(best, frame, in_world, seconds)
        if in_world or len(seconds) == 1:
            note = f"Points are in the frame {frame}; where they were seen from is not recorded."
            return Placed(None, np.full(len(seconds), True), True, note)
        raise InputError(
            f"{self.name} holds no poses for the {len(seconds)} scans in the frame {frame!r} (no moving "
            f"transform, no odometry); name a trajectory with --trajectory; its topics: {self.listed}."
        )

    def beside(self, first: str, frame: str, seconds: Float) -> Placed | None:
        """Where ``frame`` was, on a robot whose sensor ``first`` is placed; None where nothing joins them."""
        if frame == first:
            return self.place(frame, seconds)
        if WORLD_FRAMES.count(first) or WORLD_FRAMES.count(frame):
            both = first in WORLD_FRAMES and frame in WORLD_FRAMES
            return self.place(frame, seconds) if both else None
        note = f"Transforms join the frame {frame} to {first}."
        tree = self.tree
        if self.given is None and tree.moves(first):
            if tree.moves(frame) and tree.chain(frame)[-1] == tree.chain(first)[-1]:
                return Placed(*tree.poses(frame, seconds), False, note)
            return None
        mounted, moved = tree.between(first, frame), self.place(first, seconds)
        if mounted is None or moved.poses is None or tree.apart(first, frame):
            return None
        return Placed(moved.poses @ mounted, moved.known, False, note)

    def _by_track(self, topic: str, frame: str, in_world: bool, seconds: Float) -> Placed:
        """Poses of an odometry or pose topic, with the sensor's place on the robot where that is known."""
        track, tree = self.tracks[topic], self.tree
        order = np.argsort(track["seconds"], kind="stable")
        stamps, poses = np.array(track["seconds"])[order], ros.matrices(track["poses"])[order]
        moved, known = _interpolated(stamps, poses, seconds)
        note = f"The topic {topic} places the scans."
        if not in_world and track["child"] in tree.chain(frame)[1:]:
            mounted = tree.between(track["child"], frame)
            return Placed(moved if mounted is None else moved @ mounted, known, False, note)
        if not in_world and track["child"] not in ("", frame):
            note += f" The sensor {frame} is taken to sit at {track['child']}: no transform says otherwise."
        return Placed(moved, known, in_world, note)


def _interpolated(stamps: Float, poses: Float, seconds: Float) -> tuple[Float, NDArray[np.bool_]]:
    if len(stamps) > 1:
        return interpolate(stamps, poses, seconds)
    return np.tile(poses[0], (len(seconds), 1, 1)), np.abs(seconds - stamps[0]) <= TOLERANCE
