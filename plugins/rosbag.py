"""ROS 1 and ROS 2 bags and MCAP (rosbags, no ROS needed): clouds, planar scans or depth images with poses.

All sensors of one kind that transforms join are read: clouds, else planar scans, else depth images; or the
topics that the user names. Where the frame of the first moves in the tree of transforms, that places them;
else an odometry or pose topic; else the trajectory that the user names.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins import _ros_depth as depth
from floorcast_plugins import _ros_messages as ros
from floorcast_plugins._depth_images import Camera, moving
from floorcast_plugins._ros_bag import is_recording, opened
from floorcast_plugins._ros_places import TRACKS, TRANSFORMS, Placed, Places
from floorcast_plugins._ros_topics import Topic, is_body, listed, same_view, table, wanted_topics
from floorcast_plugins._ros_transforms import WORLD_FRAMES
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
SAMPLE_SCANS = 24  # of each sensor
CHECK_MESSAGES = 500  # between looks at whether the user gave up


@dataclass
class Heard:
    """What a pass noted of one topic's messages."""

    topic: Topic
    order: list[int] = field(default_factory=list)  # number in the recording, rising
    recorded: list[int] = field(default_factory=list)  # ns
    seconds: list[float] = field(default_factory=list)  # of the header, else when it was recorded
    frames: list[str] = field(default_factory=list)
    camera: Camera | None = None  # of depth images

    @property
    def frame(self) -> str:
        """The frame of most messages."""
        return max(sorted(set(self.frames)), key=self.frames.count)


@dataclass(frozen=True)
class Sensor:
    """One topic of a run."""

    topic: Topic
    times: NDArray[np.int64]  # (S,) ns, when each used scan was recorded
    rows: NDArray[np.int32]  # (messages,) row of the run that each message is, -1: left out
    in_world: bool  # points are in the world's frame already
    camera: Camera | None


@dataclass(frozen=True)
class Run:
    """What a pass over a recording showed: which messages hold the points, and where each was seen from."""

    sensors: tuple[Sensor, ...]
    scans: int
    poses: Trajectory | None  # (scans,) T_world_sensor; None: points are in the world, viewpoints unknown
    notes: tuple[str, ...]
    topics: tuple[str, ...] = ()  # of the whole recording
    types: Any = None  # rosbags' compiled definitions of the messages


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [RosbagReader()]


class RosbagReader:
    """Recordings of robots."""

    name = "ROS bag"
    suffixes: tuple[str, ...] = (".bag", ".mcap", ".db3")
    description = (
        "ROS 1 and ROS 2 bags, MCAP: PointCloud2, LaserScan or depth images of one or several sensors "
        "with TF or odometry"
    )

    def sniff(self, path: Path, head: bytes) -> float:
        """1 for the first bytes of a recording, or for a folder with ROS 2's metadata."""
        return 1.0 if is_recording(path, head) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open it; :class:`InputError` where it is damaged, or lists its topics where none can be used."""
        given = None if options.trajectory is None else read_trajectory(options.trajectory, observer)
        run = survey(path, given, observer, options.input.topic)
        source = PointSource(
            path,
            "ROS bag",
            partial(_chunks, path, run),
            partial(_sample, path, run),
            None,
            run.poses is not None,
            None if run.poses is None else ScanIds(0, run.scans - 1, True),
            run.poses,
            run.notes,
            unit="m",
            scans=run.scans,
            topics=run.topics,
        )
        return assemble(source, replace(options, trajectory=None), observer)


def survey(path: Path, given: Trajectory | None, observer: Observer, asked: str = "") -> Run:
    """One pass: topics, times of the scans, transforms and odometry; ``asked``: topics to be read."""
    with opened(path) as reader:
        heard = {t.name: Heard(t) for t in wanted_topics(path.name, reader, asked)}
        places = Places(path.name, listed(reader), given)
        _listen(reader, heard, places, observer)
        usable = [h for h in heard.values() if h.order]
        if not usable:
            raise EmptyInput(f"The topic {', '.join(heard)} of {path.name} holds no messages.")
        joined, notes = _joined(path.name, reader, usable, places, bool(asked.strip()))
        topics = table(reader, tuple(h.topic.name for h, _ in joined))
        types = reader.typestore
    run = _run(path.name, joined, observer)
    return replace(run, types=types, topics=topics, notes=run.notes + notes)


def _listen(reader: Any, heard: dict[str, Heard], places: Places, observer: Observer) -> None:
    """The headers of all messages of the topics, and all that is said of poses."""
    wanted = [c for c in reader.connections if c.topic in heard or c.msgtype in (*TRANSFORMS, *TRACKS)]
    for number, (connection, time, raw) in enumerate(reader.messages(wanted)):
        if number % CHECK_MESSAGES == 0:
            observer.check_cancelled()
        if connection.topic in heard:
            stamp, frame = ros.header_of(raw, reader.is2)
            one = heard[connection.topic]
            one.order.append(number)
            one.recorded.append(time)
            one.seconds.append(stamp if stamp > 0 else 1e-9 * time)
            one.frames.append(frame)
        else:
            places.take(reader.deserialize(raw, connection.msgtype), connection)


Joined = list[tuple[Heard, Placed]]


def _joined(
    name: str, reader: Any, heard: list[Heard], places: Places, asked: bool
) -> tuple[Joined, tuple[str, ...]]:
    """The topics that are read, the first of them placed by itself, and a sentence of those that are not."""
    first, alone = _first(name, reader, heard, places, asked)
    joined, left = [(first, alone)], []
    for other in (h for h in heard if h is not first):
        placed = places.beside(first.frame, other.frame, np.array(other.seconds))
        why = ""
        if placed is None or (placed.poses is None) != (joined[0][1].poses is None):
            why = f"no transform joins its frame {other.frame} to {first.frame}"
        elif not asked:
            why = _another_form(other, [h for h, _ in joined], places)
        if why and asked:
            raise InputError(f"The topic {other.topic.name} of {name} cannot be read too: {why}.")
        if not why:
            try:
                _find_camera(name, reader, other)
            except InputError as error:
                if asked:
                    raise
                why = str(error).rstrip(".")
        if why or placed is None:
            left.append(f"{other.topic.name} ({why})")
        else:
            joined.append((other, placed))
    note = f"Not read: {', '.join(left)}; --set input.topic=NAME,NAME reads the topics that it names."
    return joined, (note,) if left else ()


def _first(name: str, reader: Any, heard: list[Heard], places: Places, asked: bool) -> tuple[Heard, Placed]:
    """The first topic that can be placed; where none can, the reason of the first is told."""
    wrong: InputError | None = None
    for one in heard[:1] if asked else heard:
        try:
            _find_camera(name, reader, one)
            placed = places.place(one.frame, np.array(one.seconds))
        except InputError as error:
            wrong = wrong or error
            continue
        if wrong is None or placed.poses is not None or one.frame in WORLD_FRAMES:
            return one, placed
    raise wrong or EmptyInput(f"The topic {heard[0].topic.name} of {name} holds no messages.")


def _find_camera(name: str, reader: Any, heard: Heard) -> None:
    if heard.topic.is_image:
        heard.camera = depth.camera_of(name, reader, heard.topic.name)


def _another_form(other: Heard, read: list[Heard], places: Places) -> str:
    """Why ``other`` is no sensor of its own, but what others saw in another form; "" where it is one."""
    if is_body(other.frame):
        return f"its frame {other.frame} is the robot's, not a sensor's"
    for one in read:
        if one.frame == other.frame:
            return f"its frame {other.frame} is that of {one.topic.name}"
        if one.frame in WORLD_FRAMES or is_body(one.frame):
            return f"{one.topic.name} is in the frame {one.frame} and may hold it"
        between = places.tree.between(one.frame, other.frame)
        if between is not None and same_view(between):
            return f"it sees what {one.topic.name} does"
    return ""


def _run(name: str, joined: Joined, observer: Observer) -> Run:
    """The scans that have a pose, in the order of the recording; :class:`InputError` where none has."""
    if not any(placed.known.any() for _, placed in joined):
        first = joined[0][0]
        raise InputError(
            f"The poses in or for {name} are from another time than its {len(first.seconds)} scans on "
            f"{first.topic.name} (these begin at {min(first.seconds):.1f} s); give the trajectory of this "
            "recording."
        )
    used, notes = [], []
    for heard, placed in joined:
        mask, said = _used(name, heard, placed, observer, len(joined) == 1)
        used.append(mask)
        notes += said
    keys = np.concatenate([np.array(h.order)[m] for (h, _), m in zip(joined, used, strict=True)])
    rank = np.empty(len(keys), dtype=np.int32)
    rank[np.argsort(keys)] = np.arange(len(keys), dtype=np.int32)
    sensors, start = [], 0
    for (heard, placed), mask in zip(joined, used, strict=True):
        rows = np.full(len(mask), -1, dtype=np.int32)
        rows[mask] = rank[start : start + int(mask.sum())]
        start += int(mask.sum())
        times = np.array(heard.recorded)[mask]
        sensors.append(Sensor(heard.topic, times, rows, placed.in_world, heard.camera))
    poses = _path(joined, sensors, len(keys))
    return Run(tuple(sensors), len(keys), poses, tuple(dict.fromkeys(notes)))


def _path(joined: Joined, sensors: list[Sensor], scans: int) -> Trajectory | None:
    """The poses of all sensors in the order of the recording."""
    stamps, matrices, which = np.zeros(scans), np.zeros((scans, 4, 4)), np.zeros(scans, dtype=np.int32)
    pairs = sorted(zip(joined, sensors, strict=True), key=lambda pair: -len(pair[1].times))  # stable
    for number, ((heard, placed), sensor) in enumerate(pairs):
        if placed.poses is None:
            return None
        mask = sensor.rows >= 0
        rows = sensor.rows[mask]
        stamps[rows], matrices[rows], which[rows] = np.array(heard.seconds)[mask], placed.poses[mask], number
    several = which if len(sensors) > 1 else None
    return Trajectory(np.maximum.accumulate(stamps), matrices, several)


def _used(
    name: str, heard: Heard, placed: Placed, observer: Observer, alone: bool
) -> tuple[NDArray[np.bool_], list[str]]:
    """(messages,) which messages of a topic are read, and the sentences that say so."""
    topic, used = heard.topic, placed.known.copy()
    if not used.all():
        lost = int(len(used) - used.sum())
        where = name if alone else f"{name} ({topic.name})"
        observer.warning(f"{lost:,} of the {len(used):,} scans of {where} have no pose; they were left out.")
    kind = topic.msgtype.split("/")[-1]
    notes = [
        f"{name}: {int(used.sum()):,} {kind} messages of the topic {topic.name} are read.",
        placed.note,
    ]
    if topic.is_image and placed.poses is not None:
        kept = np.flatnonzero(used)[moving(placed.poses[used])]
        used[:] = False
        used[kept] = True
        notes.append(f"{int(used.sum()):,} images that moved are used.")
    return used, notes


def _chunks(path: Path, run: Run) -> Iterator[RawChunk]:
    """The points of each scan with its pose."""
    sensors = {sensor.topic.name: sensor for sensor in run.sensors}
    seen = dict.fromkeys(sensors, 0)
    with opened(path, run.types) as reader:
        wanted = [c for c in reader.connections if c.topic in sensors]
        for connection, _, raw in reader.messages(wanted):
            sensor, number = sensors[connection.topic], seen[connection.topic]
            seen[connection.topic] += 1
            if number >= len(sensor.rows):
                raise InputError(f"{path.name} became longer while it was read; wait until it is whole.")
            if sensor.rows[number] >= 0:
                yield _scan(path.name, reader, connection, raw, run, sensor, int(sensor.rows[number]))


def _scan(
    name: str, reader: Any, connection: Any, raw: bytes, run: Run, sensor: Sensor, row: int
) -> RawChunk:
    msgtype = sensor.topic.msgtype
    with damaged(name, "ROS recording"):
        message = reader.deserialize(raw, connection.msgtype)
        if sensor.camera is None:
            points = ros.points_of(message, msgtype)
        else:
            points = depth.depth_points(message, msgtype, sensor.camera)
    if run.poses is None:
        return RawChunk(points)
    ids = np.full(len(points), row, dtype=np.int32)
    return RawChunk(points, ids, None, None if sensor.in_world else run.poses.T_world_sensor[row])


def _sample(path: Path, run: Run) -> RawChunk:
    """Points of scans of every sensor that are spread over the run."""
    parts = []
    with opened(path, run.types) as reader:
        for sensor in run.sensors:
            wanted = [c for c in reader.connections if c.topic == sensor.topic.name]
            rows = sensor.rows[sensor.rows >= 0]
            if not len(rows):
                continue
            for k in np.unique(np.linspace(0, len(rows) - 1, SAMPLE_SCANS).astype(int)).tolist():
                time = int(sensor.times[k])
                for connection, _, raw in reader.messages(wanted, start=time, stop=time + 1):
                    parts.append(_scan(path.name, reader, connection, raw, run, sensor, int(rows[k])))
                    break
    parts = [part for part in parts if len(part.points)]
    if not parts:
        raise EmptyInput(f"The scans of {path.name} that were looked at hold no points.")
    return spread_sample(parts)
