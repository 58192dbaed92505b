"""ROS 1 and ROS 2 bags and MCAP (rosbags, no ROS needed): clouds, planar scans or depth images with poses.

The topic with most clouds is read, else the one with most planar scans, else that with most depth images.
Where its frame moves in the tree of transforms, that places it; else an odometry or pose topic; else the
trajectory that the user names.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins import _ros_depth as depth
from floorcast_plugins import _ros_messages as ros
from floorcast_plugins._depth_images import Camera, moving
from floorcast_plugins._ros_bag import is_recording, opened
from floorcast_plugins._ros_transforms import TOLERANCE, WORLD_FRAMES, FrameTree, interpolate
from floorplan_core.api import (
    EmptyInput,
    InputError,
    Observer,
    PointSource,
    RawChunk,
    Reader,
    ReadOptions,
    Reconstruction,
    ScanIds,
    Trajectory,
    assemble,
    damaged,
    hookimpl,
    read_trajectory,
    spread_sample,
)

Float = NDArray[np.float64]
TRANSFORMS = (ros.TF, ros.TF_OLD)
TRACKS = (ros.ODOMETRY, ros.POSE, ros.TRANSFORM)  # in this order of trust
SAMPLE_SCANS = 24
CHECK_MESSAGES = 500  # between looks at whether the user gave up
LISTED = 12  # topics in a sentence


@dataclass(frozen=True)
class Run:
    """What a pass over a recording showed: which messages hold the points, and where each was seen from."""

    topic: str
    msgtype: str
    times: NDArray[np.int64]  # (S,) ns, when each used scan was recorded
    used: NDArray[np.bool_]  # (messages,) which messages of the topic have a pose
    poses: Trajectory | None  # (S,) T_world_sensor; None: points are in the world, viewpoints unknown
    in_world: bool  # points are in the world's frame already
    notes: tuple[str, ...]
    topics: tuple[str, ...] = ()  # of the whole recording
    types: Any = None  # rosbags' compiled definitions of the messages
    camera: Camera | None = None  # of depth images


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [RosbagReader()]


class RosbagReader:
    """Recordings of robots."""

    name = "ROS bag"
    suffixes: tuple[str, ...] = (".bag", ".mcap", ".db3")
    description = "ROS 1 and ROS 2 bags, MCAP: PointCloud2, LaserScan or depth images with TF or odometry"

    def sniff(self, path: Path, head: bytes) -> float:
        """1 for the first bytes of a recording, or for a folder with ROS 2's metadata."""
        return 1.0 if is_recording(path, head) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open it; :class:`InputError` where it is damaged, or lists its topics where none can be used."""
        given = None if options.trajectory is None else read_trajectory(options.trajectory, observer)
        run = survey(path, given, observer, options.input.topic)
        scans = len(run.times)
        source = PointSource(
            path,
            "ROS bag",
            partial(_chunks, path, run, observer),
            partial(_sample, path, run),
            None,
            run.poses is not None,
            None if run.poses is None else ScanIds(0, scans - 1, True),
            run.poses,
            run.notes,
            unit="m",
            scans=scans,
            topics=run.topics,
        )
        return assemble(source, replace(options, trajectory=None), observer)


def survey(path: Path, given: Trajectory | None, observer: Observer, wanted: str = "") -> Run:
    """One pass: topics, times of the scans, transforms and odometry; ``wanted``: the topic, if asked for."""
    with opened(path) as reader:
        topic, msgtype = choose_topic(path.name, reader, wanted)
        clouds = [c for c in reader.connections if c.topic == topic]
        movers = [c for c in reader.connections if c.msgtype in (*TRANSFORMS, *TRACKS)]
        tree, tracks = FrameTree(), {}
        recorded, seconds, frames = [], [], []
        for number, (connection, time, raw) in enumerate(reader.messages([*clouds, *movers])):
            if number % CHECK_MESSAGES == 0:
                observer.check_cancelled()
            if connection.topic == topic:
                stamp, frame = ros.header_of(raw, reader.is2)
                recorded.append(time)
                seconds.append(stamp if stamp > 0 else 1e-9 * time)
                frames.append(frame)
            else:
                message = reader.deserialize(raw, connection.msgtype)
                _take(message, connection, tree, tracks)
        listed, types, topics = _listed(reader), reader.typestore, _topics(reader)
        others = _others(reader, topic, msgtype)
        images = msgtype in (depth.IMAGE, depth.COMPRESSED)
        camera = depth.camera_of(path.name, reader, topic) if images else None
    if not recorded:
        raise EmptyInput(f"The topic {topic} of {path.name} holds no messages.")
    frame = max(sorted(set(frames)), key=frames.count)
    placed = _place(path.name, frame, np.array(seconds), tree, tracks, given, listed)
    run = _run(path.name, topic, msgtype, np.array(recorded), np.array(seconds), placed, observer)
    run = replace(run, types=types, topics=topics, camera=camera, notes=run.notes + others)
    return without_still_images(run) if images else run


def without_still_images(run: Run) -> Run:
    """The run without the images that were taken where the last one was."""
    if run.poses is None:
        return run
    kept = moving(run.poses.T_world_sensor)
    used = np.zeros_like(run.used)
    used[np.flatnonzero(run.used)[kept]] = True
    poses = Trajectory(run.poses.stamps[kept], run.poses.T_world_sensor[kept])
    note = f"{len(kept):,} images that moved are used."
    return replace(run, times=run.times[kept], used=used, poses=poses, notes=(*run.notes, note))


def choose_topic(name: str, reader: Any, asked: str = "") -> tuple[str, str]:
    """The topic that was asked for, else that with most clouds, else planar scans, else depth images.

    Ties go to the first by name. :class:`InputError` lists the topics where none fits.
    """
    usable = {c.topic: c.msgtype for c in reader.connections if c.msgtype in (ros.CLOUD, ros.SCAN)}
    if asked:
        usable |= depth.depth_topics(reader)
        if asked in usable:
            return asked, usable[asked]
        raise InputError(
            f"{name} holds no PointCloud2, LaserScan or depth image messages on the topic {asked!r} "
            f"(input.topic); its topics: {_listed(reader)}."
        )
    counts = _message_counts(reader)
    for wanted in (ros.CLOUD, ros.SCAN):
        topics = sorted(t for t, msgtype in usable.items() if msgtype == wanted and counts[t] > 0)
        if topics:
            return max(topics, key=lambda t: counts[t]), wanted
    images = depth.depth_topics(reader)
    if images:
        topic = max(sorted(images), key=lambda t: counts[t])
        return topic, images[topic]
    raise InputError(
        f"{name} holds no PointCloud2, LaserScan or depth image messages; its topics: {_listed(reader)}."
    )


def _message_counts(reader: Any) -> dict[str, int]:
    counts: dict[str, int] = {}
    for c in reader.connections:
        counts[c.topic] = counts.get(c.topic, 0) + int(c.msgcount)
    return counts


def _listed(reader: Any) -> str:
    topics = sorted({f"{c.topic} ({c.msgtype.split('/')[-1]})" for c in reader.connections})
    more = f" and {len(topics) - LISTED} more" if len(topics) > LISTED else ""
    return (", ".join(topics[:LISTED]) + more) or "none"


def _others(reader: Any, topic: str, msgtype: str) -> tuple[str, ...]:
    """A sentence where more topics could have been read: another lidar, or the same one in another form."""
    counts = _message_counts(reader)
    others = sorted({c.topic for c in reader.connections if c.msgtype == msgtype != depth.IMAGE} - {topic})
    named = ", ".join(t for t in others if counts[t] > 0)
    return (f"Not read: {named}; one topic is, choose it with --set input.topic=NAME.",) if named else ()


def _topics(reader: Any) -> tuple[str, ...]:
    """Each topic with the number and type of its messages, for people."""
    counts: dict[tuple[str, str], int] = {}
    for c in reader.connections:
        key = (c.topic, c.msgtype.split("/")[-1])
        counts[key] = counts.get(key, 0) + int(c.msgcount)
    return tuple(f"{topic}: {count:,} {kind}" for (topic, kind), count in sorted(counts.items()))


def _take(message: Any, connection: Any, tree: FrameTree, tracks: dict[str, Any]) -> None:
    """Add a transform to the tree, or a pose to the track of its topic."""
    if connection.msgtype in TRANSFORMS:
        for t in message.transforms:
            pose = ros.pose_of(t.transform.translation, t.transform.rotation)
            parent, child = ros.clean_frame(t.header.frame_id), ros.clean_frame(t.child_frame_id)
            tree.add(parent, child, ros.seconds_of(t.header.stamp), pose, "static" in connection.topic)
        return
    track = tracks.setdefault(connection.topic, {"type": connection.msgtype, "seconds": [], "poses": []})
    if connection.msgtype == ros.TRANSFORM:
        pose = ros.pose_of(message.transform.translation, message.transform.rotation)
    else:
        inner = message.pose.pose if connection.msgtype == ros.ODOMETRY else message.pose
        pose = ros.pose_of(inner.position, inner.orientation)
    track["seconds"].append(ros.seconds_of(message.header.stamp))
    track["poses"].append(pose)
    track["frame"] = ros.clean_frame(message.header.frame_id)
    track["child"] = ros.clean_frame(getattr(message, "child_frame_id", ""))


@dataclass(frozen=True)
class _Placed:
    """Poses of all messages of the topic."""

    poses: Float | None  # (N, 4, 4)
    known: NDArray[np.bool_]  # (N,)
    in_world: bool
    note: str


def _place(
    name: str,
    frame: str,
    seconds: Float,
    tree: FrameTree,
    tracks: dict[str, Any],
    given: Trajectory | None,
    listed: str,
) -> _Placed:
    """Where the sensor was at each message: as asked, by the transforms, by a track, or not at all."""
    in_world = frame in WORLD_FRAMES
    if given is not None:
        known = _interpolated(given.stamps, given.T_world_sensor, seconds)
        return _Placed(*known, in_world, "The given trajectory places the scans by their times.")
    if not in_world and tree.moves(frame):
        root = tree.chain(frame)[-1]
        return _Placed(*tree.poses(frame, seconds), False, f"Transforms place the frame {frame} in {root}.")
    best = max(
        sorted(t for t in tracks if len(tracks[t]["poses"]) > 1),
        key=lambda t: (-TRACKS.index(tracks[t]["type"]), len(tracks[t]["poses"])),
        default=None,
    )
    if best is not None:
        return _by_track(best, tracks[best], frame, in_world, seconds, tree)
    if in_world or len(seconds) == 1:
        note = f"Points are in the frame {frame}; where they were seen from is not recorded."
        return _Placed(None, np.full(len(seconds), True), True, note)
    raise InputError(
        f"{name} holds no poses for the {len(seconds)} scans in the frame {frame!r} (no moving transform, no "
        f"odometry); name a trajectory with --trajectory; its topics: {listed}."
    )


def _by_track(
    topic: str, track: dict[str, Any], frame: str, in_world: bool, seconds: Float, tree: FrameTree
) -> _Placed:
    """Poses of an odometry or pose topic, with the sensor's place on the robot where transforms know it."""
    order = np.argsort(track["seconds"], kind="stable")
    stamps, poses = np.array(track["seconds"])[order], ros.matrices(track["poses"])[order]
    moved, known = _interpolated(stamps, poses, seconds)
    note = f"The topic {topic} places the scans."
    chain = tree.chain(frame)
    if not in_world and track["child"] in chain[1:]:
        mounted = np.eye(4)
        for child in chain[: chain.index(track["child"])]:
            mounted = ros.matrices(tree.edges[child].poses[:1])[0] @ mounted
        return _Placed(moved @ mounted, known, False, note)
    if not in_world and track["child"] not in ("", frame):
        note += f" The sensor {frame} is taken to sit at {track['child']}: no transform says otherwise."
    return _Placed(moved, known, in_world, note)


def _interpolated(stamps: Float, poses: Float, seconds: Float) -> tuple[Float, NDArray[np.bool_]]:
    if len(stamps) > 1:
        return interpolate(stamps, poses, seconds)
    return np.tile(poses[0], (len(seconds), 1, 1)), np.abs(seconds - stamps[0]) <= TOLERANCE


def _run(
    name: str,
    topic: str,
    msgtype: str,
    recorded: NDArray[np.int64],
    seconds: Float,
    placed: _Placed,
    observer: Observer,
) -> Run:
    """The scans that have a pose; :class:`InputError` where none has."""
    used = placed.known
    if not used.any():
        raise InputError(
            f"The poses in or for {name} are from another time than its {len(used)} scans on {topic} "
            f"(these begin at {seconds.min():.1f} s); give the trajectory of this recording."
        )
    if not used.all():
        lost = int(len(used) - used.sum())
        observer.warning(f"{lost:,} of the {len(used):,} scans of {name} have no pose; they were left out.")
    poses = None
    if placed.poses is not None:
        stamps = np.maximum.accumulate(seconds[used])
        poses = Trajectory(stamps, placed.poses[used])
    note = f"{name}: {int(used.sum()):,} {msgtype.split('/')[-1]} messages of the topic {topic} are read."
    return Run(topic, msgtype, recorded[used], used, poses, placed.in_world, (note, placed.note))


def _chunks(path: Path, run: Run, observer: Observer) -> Iterator[RawChunk]:
    """The points of each scan with its pose."""
    row = -1
    with opened(path, run.types) as reader:
        clouds = [c for c in reader.connections if c.topic == run.topic]
        for number, (connection, _, raw) in enumerate(reader.messages(clouds)):
            if number >= len(run.used):
                raise InputError(f"{path.name} became longer while it was read; wait until it is whole.")
            if run.used[number]:
                row += 1
                yield _scan(path.name, reader, connection, raw, run, row)


def _scan(name: str, reader: Any, connection: Any, raw: bytes, run: Run, row: int) -> RawChunk:
    with damaged(name, "ROS recording"):
        message = reader.deserialize(raw, connection.msgtype)
        if run.camera is None:
            points = ros.points_of(message, run.msgtype)
        else:
            points = depth.depth_points(message, run.msgtype, run.camera)
    if run.poses is None:
        return RawChunk(points)
    ids = np.full(len(points), row, dtype=np.int32)
    return RawChunk(points, ids, None, None if run.in_world else run.poses.T_world_sensor[row])


def _sample(path: Path, run: Run) -> RawChunk:
    """Points of scans that are spread over the run."""
    rows = np.unique(np.linspace(0, len(run.times) - 1, SAMPLE_SCANS).astype(int)).tolist()
    parts = []
    with opened(path, run.types) as reader:
        clouds = [c for c in reader.connections if c.topic == run.topic]
        for row in rows:
            time = int(run.times[row])
            for connection, _, raw in reader.messages(clouds, start=time, stop=time + 1):
                parts.append(_scan(path.name, reader, connection, raw, run, row))
                break
    parts = [part for part in parts if len(part.points)]
    if not parts:
        raise EmptyInput(f"The scans of {path.name} that were looked at hold no points.")
    return spread_sample(parts)
