"""CARMEN logs (.log, .log.gz): planar scans with corrected poses, the classic 2-D data sets.

``FLASER n r1 … rn x y theta odom_x odom_y odom_theta …`` carries the laser's (corrected) pose; so does
``ROBOTLASER1``, with its angles and its largest range. Readings without a return are left out.
"""

from __future__ import annotations

import gzip
import math
import re
import zlib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from floorplan_core.api import (
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
    spread_sample,
)

KNOWN = re.compile(
    rb"^(#.*|(?:FLASER|RLASER|LASER\d|ROBOTLASER\d|RAWLASER\d|ODOM|PARAM|NEFF|SYNC|TRUEPOS|IMU|GPS\w*|NMEA\w*"
    rb"|SONAR|BUMPER|MARKER|SCANMARK|POSITION|DYNAMIXEL|VECTORMOVE|ROBOTVELOCITY|FOLLOWTRAJECTORY|BASEVELOCITY"
    rb"|[A-Z]+_\w+)\s.*)$"
)
TELLING = re.compile(rb"^(FLASER|ROBOTLASER1|RAWLASER1|ODOM|PARAM|NEFF|TRUEPOS) ", re.MULTILINE)
GZIP = b"\x1f\x8b"
MAX_LINE = 1 << 18  # bytes: 10,000 readings
MAX_BYTES = 8 << 30  # of text, so that a bomb in gzip's clothes ends
MAX_BEAMS = 100_000
CHUNK_SCANS = 256
SAMPLE_SCANS = 256
KINDS = (b"FLASER", b"ROBOTLASER1")  # messages that are scans with poses
BLOCK_BYTES = 1 << 20  # that are unpacked at a time


@dataclass(frozen=True)
class Scan:
    """One planar scan."""

    ranges: Any  # (B,) metres
    angles: Any  # (B,) radians, left of the laser's axis
    pose: tuple[float, float, float]  # x, y, theta of the laser, metres and radians
    seconds: float
    longest: float  # metres, what the sensor reports without a return; inf where the log does not say


@dataclass(frozen=True)
class LogSummary:
    """What a pass over the whole log showed."""

    kind: bytes  # the messages that are used
    poses: Any  # (S, 3) x, y, theta
    seconds: Any  # (S,)
    longest: float  # metres: readings as long had no return
    good: bytes  # of each line of that kind: 1 where it is a scan
    damaged: int  # lines of that kind that are no scans


@hookimpl
def floorcast_readers() -> list[Reader]:
    return [CarmenReader()]


class CarmenReader:
    """Logs of the Carnegie Mellon robot navigation toolkit."""

    name = "CARMEN"
    suffixes: tuple[str, ...] = (".log", ".log.gz", ".clf")
    description = "CARMEN logs: planar scans with corrected poses, also gzipped"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.9 where nearly all of the first lines are messages of such a log."""
        lines = [line for line in _plain(head).splitlines()[:-1] if line.strip()]
        known = sum(bool(KNOWN.match(line)) for line in lines)
        telling = TELLING.search(_plain(head)) is not None
        return 0.9 if telling and known >= 0.9 * max(1, len(lines)) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the log; :class:`InputError` where it is damaged or holds no scans with poses."""
        log = summarise(path, observer)
        if log.damaged:
            observer.warning(f"{log.damaged:,} lines of {path.name} are damaged scans; they were left out.")
        rows = Trajectory(np.maximum.accumulate(log.seconds), np.array([_matrix(p) for p in log.poses]))
        notes = (
            f"{path.name} holds {len(log.poses):,} planar scans ({log.kind.decode()}) with their poses.",
            "The height of the laser is not in the log: its plane is taken as z = 0.",
        )
        source = PointSource(
            path,
            "CARMEN",
            partial(_chunks, path, log, CHUNK_SCANS, 1),
            partial(_sample, path, log),
            None,
            True,
            ScanIds(0, len(log.poses) - 1, True),
            rows,
            notes,
            unit="m",
            up="z",
        )
        return assemble(source, options, observer)


def summarise(path: Path, observer: Observer) -> LogSummary:
    """One pass: how many scans of which kind, their poses, and what stands for "no return"."""
    kinds: Counter[bytes] = Counter()
    for lines in _blocks(path, observer):
        kinds.update({kind: lines.count(b"\n" + kind + b" ") for kind in KINDS})
    if not any(kinds.values()):
        raise InputError(
            f"{path.name} is a CARMEN log without scans that have poses (FLASER or ROBOTLASER1 messages)."
        )
    kind = max(sorted(kinds), key=lambda k: kinds[k])
    poses, seconds, good, longest, readings = [], [], bytearray(), 0.0, 0
    for line in _scan_lines(path, kind, observer):
        scan = parse_scan(line)
        good.append(scan is not None)
        if scan is None:
            continue
        poses.append(scan.pose)
        seconds.append(scan.seconds)
        readings += len(scan.ranges)
        longest = max(longest, float(scan.ranges.max(initial=0.0, where=np.isfinite(scan.ranges))))
    bad = good.count(False)
    if not poses or readings == 0:
        raise InputError(f"None of the {bad:,} scans of {path.name} can be read; the log is damaged.")
    return LogSummary(kind, np.array(poses), np.array(seconds), longest, bytes(good), bad)


def parse_scan(line: bytes) -> Scan | None:
    """The scan of one message; None where it is damaged."""
    words = line.split()
    try:
        scan = _flaser(words) if words[0] == b"FLASER" else _robotlaser(words)
    except (ValueError, IndexError, OverflowError):
        return None
    finite = all(map(math.isfinite, (*scan.pose, scan.seconds)))
    return scan if finite and not math.isnan(scan.longest) else None


def _flaser(words: list[bytes]) -> Scan:
    """180 readings are a degree apart from -90 degrees on; odd numbers reach from -90 to 90 degrees.

    (Measured on three logs: walls are sharpest so.)
    """
    count = _count(words[1])
    ranges = np.array(words[2 : 2 + count], dtype=np.float64)
    x, y, theta = (float(w) for w in words[2 + count : 5 + count])
    step = math.pi / (count - count % 2) if count > 1 else 0.0
    angles = -math.pi / 2 + step * np.arange(count)
    return Scan(ranges, angles, (x, y, theta), float(words[8 + count]), math.inf)


def _robotlaser(words: list[bytes]) -> Scan:
    first, _, step, longest = (float(w) for w in words[2:6])
    count = _count(words[8])
    ranges = np.array(words[9 : 9 + count], dtype=np.float64)
    at = 10 + count + _count(words[9 + count])  # after the remissions
    x, y, theta = (float(w) for w in words[at : at + 3])
    return Scan(ranges, first + step * np.arange(count), (x, y, theta), float(words[at + 11]), longest)


def _count(word: bytes) -> int:
    count = int(word)
    if not 0 <= count <= MAX_BEAMS:
        raise ValueError(word)
    return count


def _chunks(path: Path, log: LogSummary, size: int, every: int) -> Iterator[RawChunk]:
    """The points of every so-many-th scan, ``size`` scans at a time."""
    rows, parts = [], []
    row = -1
    for line, good in zip(_scan_lines(path, log.kind, Observer()), log.good, strict=False):
        row += good
        scan = parse_scan(line) if good and row % every == 0 else None
        if scan is None:
            continue
        parts.append(_points(scan, log.longest))
        rows.append(row)
        if len(parts) == size:
            yield _joined(parts, rows)
            rows, parts = [], []
    if parts:
        yield _joined(parts, rows)


def _points(scan: Scan, longest: float) -> Any:
    """(N, 3) end points of the readings that returned, in the frame of the log."""
    limit = longest if math.isinf(scan.longest) else scan.longest
    good = (scan.ranges > 0) & (scan.ranges < limit)
    ranges, angles = scan.ranges[good], scan.angles[good] + scan.pose[2]
    x, y = scan.pose[0] + ranges * np.cos(angles), scan.pose[1] + ranges * np.sin(angles)
    return np.column_stack([x, y, np.zeros(len(ranges))])


def _joined(parts: list[Any], rows: list[int]) -> RawChunk:
    ids = np.repeat(np.array(rows, dtype=np.int32), [len(part) for part in parts])
    return RawChunk(np.concatenate(parts), ids)


def _sample(path: Path, log: LogSummary) -> RawChunk:
    """Some points of scans that are spread over the run."""
    return spread_sample(list(_chunks(path, log, CHUNK_SCANS, -(-len(log.poses) // SAMPLE_SCANS))))


def _matrix(pose: Any) -> Any:
    x, y, theta = pose
    T = np.eye(4)
    T[:2, :2] = [[math.cos(theta), -math.sin(theta)], [math.sin(theta), math.cos(theta)]]
    T[:2, 3] = x, y
    return T


def _scan_lines(path: Path, kind: bytes, observer: Observer) -> Iterator[bytes]:
    """Lines that are scans of ``kind``; what lies between them is passed over at the speed of a search."""
    wanted = b"\n" + kind + b" "
    for lines in _blocks(path, observer):
        at = lines.find(wanted)
        while at >= 0:
            end = lines.find(b"\n", at + 1)
            yield lines[at + 1 : min(end if end >= 0 else len(lines), at + 1 + MAX_LINE)]
            at = lines.find(wanted, end) if end >= 0 else -1


def _blocks(path: Path, observer: Observer) -> Iterator[bytes]:
    """The log in blocks of whole lines, each of which follows a line end."""
    with _opened(path) as handle, damaged(path.name, "CARMEN log"):
        total, held = 0, b"\n"
        while data := handle.read(BLOCK_BYTES):
            observer.check_cancelled()
            total += len(data)
            if total > MAX_BYTES:
                raise InputError(f"{path.name} unpacks to more than {MAX_BYTES:,} bytes, which no log does.")
            held += data
            cut = held.rfind(b"\n")
            if cut > 0:
                yield held[:cut]
            held = held[cut:] if cut > 0 else held[: MAX_LINE + 1]
        yield held


def _opened(path: Path) -> BinaryIO:
    with path.open("rb") as handle:
        packed = handle.read(2) == GZIP
    return gzip.open(path, "rb") if packed else path.open("rb")  # type: ignore[return-value]


def _plain(head: bytes) -> bytes:
    """The first bytes as text, unpacked where they are gzipped."""
    if not head.startswith(GZIP):
        return head
    try:
        return zlib.decompressobj(wbits=zlib.MAX_WBITS | 16).decompress(head, 1 << 16)
    except zlib.error:
        return b""
