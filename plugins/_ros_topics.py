"""Which topics of a ROS recording are read: clouds, else planar scans, else depth images; or those asked for.

A robot often has several lidars or cameras, and often publishes what one sees in several forms (filtered, cut
to parts, merged, registered). Sensors have frames of their own; what is only another form has the frame of
its sensor, of the robot's body or of the world. That tells them apart without looking at the points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins import _ros_depth as depth
from floorcast_plugins import _ros_messages as ros
from floorplan_core.api import InputError

Float = NDArray[np.float64]

LISTED = 12  # topics in a sentence
BODIES = (
    "base",
    "base_link",
    "base_footprint",
    "base_stabilized",
    "body",
    "chassis",
    "vehicle",
)  # no sensors
TWIN_METRES, TWIN_DEGREES = 0.1, 10.0  # so near to another it sees the same: the image of a camera, realigned


@dataclass(frozen=True)
class Topic:
    """A topic whose messages can be read."""

    name: str
    msgtype: str
    count: int  # messages

    @property
    def is_image(self) -> bool:
        """True for depth images, which need a camera."""
        return self.msgtype in (depth.IMAGE, depth.COMPRESSED)


def wanted_topics(name: str, reader: Any, asked: str = "") -> list[Topic]:
    """The topics named in ``asked`` (with commas between), else all of one kind, most messages first.

    The kind is clouds, else planar scans, else depth images; ties go to the first by name.
    :class:`InputError` lists the topics where none fits.
    """
    counts = _message_counts(reader)
    usable = {c.topic: c.msgtype for c in reader.connections if c.msgtype in (ros.CLOUD, ros.SCAN)}
    if asked.strip():
        usable |= depth.depth_topics(reader)
        names = dict.fromkeys(t.strip() for t in asked.split(",") if t.strip())
        for topic in names:
            if topic not in usable:
                raise InputError(
                    f"{name} holds no PointCloud2, LaserScan or depth image messages on the topic {topic!r} "
                    f"(input.topic); its topics: {listed(reader)}."
                )
        return [Topic(t, usable[t], counts[t]) for t in names]
    for kind in (ros.CLOUD, ros.SCAN):
        found = [Topic(t, kind, counts[t]) for t, k in usable.items() if k == kind and counts[t] > 0]
        if found:
            return sorted(found, key=_rank)
    images = [Topic(t, kind, counts[t]) for t, kind in depth.depth_topics(reader).items()]
    if images:
        return sorted(images, key=_rank)
    raise InputError(
        f"{name} holds no PointCloud2, LaserScan or depth image messages; its topics: {listed(reader)}."
    )


def _rank(topic: Topic) -> tuple[int, str]:
    return -topic.count, topic.name


def _message_counts(reader: Any) -> dict[str, int]:
    counts: dict[str, int] = {}
    for c in reader.connections:
        counts[c.topic] = counts.get(c.topic, 0) + int(c.msgcount)
    return counts


def listed(reader: Any) -> str:
    """The topics with their types, for a sentence."""
    topics = sorted({f"{c.topic} ({c.msgtype.split('/')[-1]})" for c in reader.connections})
    more = f" and {len(topics) - LISTED} more" if len(topics) > LISTED else ""
    return (", ".join(topics[:LISTED]) + more) or "none"


def table(reader: Any, read: tuple[str, ...]) -> tuple[str, ...]:
    """Each topic with the number and type of its messages, and whether it is ``read``, for people."""
    counts: dict[tuple[str, str], int] = {}
    for c in reader.connections:
        key = (c.topic, c.msgtype.split("/")[-1])
        counts[key] = counts.get(key, 0) + int(c.msgcount)
    return tuple(
        f"{topic}: {count:,} {kind}{', read' * (topic in read)}"
        for (topic, kind), count in sorted(counts.items())
    )


def same_view(T_one_other: Float) -> bool:
    """True for two frames (4, 4) so near to each other that their images are of one sensor."""
    turn = np.degrees(np.arccos(np.clip((np.trace(T_one_other[:3, :3]) - 1) / 2, -1.0, 1.0)))
    return bool(np.linalg.norm(T_one_other[:3, 3]) < TWIN_METRES and turn < TWIN_DEGREES)


def is_body(frame: str) -> bool:
    """True for a frame that robots call their own: no sensor sits there, but what was put together does."""
    return frame.split("/")[-1] in BODIES
