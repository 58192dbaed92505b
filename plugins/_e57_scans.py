"""The scans of an E57 file (ASTM E2807): what each holds (by libE57), and its points in buffers."""

from __future__ import annotations

import struct
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorcast_plugins._e57_layout import stored_records
from floorcast_plugins._e57_packets import Records, UnusualStreams, read_columns
from floorplan_core.api import (
    CHUNK_POINTS,
    InputError,
    RawChunk,
    as_rgb,
    damaged,
    import_library,
    rotation_from_quaternion,
)

HEADER = struct.Struct("<8sIIQQQQ")
PAGE, CHECKSUM = 1024, 4  # bytes of a page, and of the checksum at its end
MAX_XML = 256 << 20  # bytes: some 100,000 scans
CARTESIAN = ("cartesianX", "cartesianY", "cartesianZ")
SPHERICAL = ("sphericalRange", "sphericalAzimuth", "sphericalElevation")
RGB = ("colorRed", "colorGreen", "colorBlue")
SEEN = (*RGB, "intensity")
INVALID = ("cartesianInvalidState", "sphericalInvalidState")
STRUCTURE = ("rowIndex", "columnIndex")
MIN_QUATERNION = 1e-6


@dataclass(frozen=True)
class E57Scan:
    """One scan of the file that holds points."""

    index: int  # in the file's data3D
    count: int
    fields: frozenset[str]
    pose: NDArray[np.float64]  # (4, 4) T_file_scan; identity where none is given
    posed: bool  # a pose is given that is not the identity
    seconds: float  # start of the acquisition; 0 where unknown
    records: Records | None = None  # how its points are stored; None: only libE57 can read them

    @property
    def spherical(self) -> bool:
        """True where only angles and ranges are there."""
        return not self.fields.issuperset(CARTESIAN)

    @property
    def from_sensor(self) -> bool:
        """True where the origin of the scan's frame is where the scanner stood."""
        return self.posed or self.spherical or self.fields.issuperset(STRUCTURE)


def check_file(path: Path) -> bytes:
    """Length, page size and XML section, before a library believes them; the XML that describes the scans."""
    total = path.stat().st_size
    with path.open("rb") as handle:
        head = handle.read(HEADER.size)
        if len(head) < HEADER.size:
            raise InputError(f"{path.name} is truncated inside its E57 header ({len(head)} bytes).")
        _, major, minor, length, at, size, page = HEADER.unpack(head)
        if major != 1:
            raise InputError(f"{path.name} is E57 version {major}.{minor}; readable is version 1.")
        if length != total:
            raise InputError(
                f"{path.name} is truncated or damaged: its header says {length:,} bytes, it has {total:,}."
            )
        if page != PAGE or at + size > total or size > MAX_XML:
            raise InputError(f"{path.name} is damaged: its E57 header points outside the file.")
        handle.seek(at - at % PAGE)
        data = handle.read((size // (PAGE - CHECKSUM) + 2) * PAGE)
    pages = np.frombuffer(data[: len(data) // PAGE * PAGE], np.uint8).reshape(-1, PAGE)
    held = pages[:, : PAGE - CHECKSUM].tobytes()
    if b"<!DOCTYPE" in held:
        raise InputError(f"{path.name} defines XML entities of its own, which is refused: E57 has none.")
    return held[at % PAGE : at % PAGE + size]


@contextmanager
def opened_image(path: Path) -> Iterator[Any]:
    """libE57's image file for one pass: opening it parses the description of all scans."""
    libe57 = import_library("pye57", "pye57", "E57").libe57
    with damaged(path.name, "E57 file"):
        image = libe57.ImageFile(str(path), "r")
    try:
        yield image
    finally:
        image.close()


def list_scans(path: Path, xml: bytes = b"") -> list[E57Scan]:
    """The scans that hold points, in the order of the file; ``xml`` is what :func:`check_file` gave."""
    with opened_image(path) as image, damaged(path.name, "E57 file"):
        root = image.root()
        data = root["data3D"] if root.isDefined("data3D") else []
        scans = [_describe(path, data[k], k) for k in range(len(data))]
    stored = stored_records(xml) if xml else []
    if len(stored) == len(scans):
        scans = [_with_records(scan, records) for scan, records in zip(scans, stored, strict=True)]
    return [scan for scan in scans if scan.count > 0]


def _with_records(scan: E57Scan, records: Records | None) -> E57Scan:
    """How the points are stored, where our reading of the description is that of libE57."""
    same = records is not None and records.count == scan.count and scan.fields.issuperset(records.fields)
    if records is None or not same or not set(_wanted(scan)) <= set(records.fields):
        return scan
    return replace(scan, records=records)


def read_scan(path: Path, scan: E57Scan, size: int = CHUNK_POINTS // 2) -> Generator[RawChunk, None, None]:
    """Valid points in the scan's frame (float64) with what they carry, in buffers.

    Raises :class:`InputError` where fewer records follow than the file promises.
    """
    names, done = _wanted(scan), 0
    if scan.records is not None:
        try:
            for points, columns in read_columns(path, scan.records, names, size):
                done += len(points)
                yield _valid_points(points, dict(zip(names[3:], columns, strict=True)), scan.spherical)
            return
        except UnusualStreams:
            pass
    with opened_image(path) as image:
        for read in _read_by_library(path, image, scan, names, size):
            rest = {name: column[max(0, done) :] for name, column in read.items()}
            done -= len(read[names[0]])
            points = np.column_stack([rest.pop(name) for name in names[:3]])
            if len(points):
                yield _valid_points(points, rest, scan.spherical)


def _wanted(scan: E57Scan) -> list[str]:
    """The fields that we use."""
    names = [*(SPHERICAL if scan.spherical else CARTESIAN)]
    return names + [name for name in (*INVALID, "timeStamp", *SEEN) if name in scan.fields]


def _read_by_library(
    path: Path, image: Any, scan: E57Scan, names: list[str], size: int
) -> Generator[dict[str, Any], None, None]:
    """The columns of all records, a buffer at a time, which is used again."""
    with damaged(path.name, "E57 file"):
        columns, reader = _reader(image, scan, names, min(size, scan.count))
    try:
        left = scan.count
        while left > 0:
            with damaged(path.name, "E57 file"):
                read = int(reader.read())
            if read <= 0:
                raise InputError(
                    f"{path.name} is truncated: scan {scan.index} promises {scan.count:,} points, "
                    f"{scan.count - left:,} of them exist."
                )
            left -= read
            yield {name: column[:read] for name, column in columns.items()}
    finally:
        reader.close()  # an image has one reader at a time, and samples leave theirs early


def _reader(image: Any, scan: E57Scan, names: list[str], size: int) -> tuple[dict[str, Any], Any]:
    libe57 = import_library("pye57", "pye57", "E57").libe57
    columns = {name: np.empty(size, "i1" if name in INVALID else "f8") for name in names}
    buffers = libe57.VectorSourceDestBuffer()
    for name, column in columns.items():
        buffers.append(libe57.SourceDestBuffer(image, name, column, size, True, True))
    points = image.root()["data3D"][scan.index]["points"]
    return columns, points.reader(buffers)


def _valid_points(points: Any, columns: dict[str, Any], spherical: bool) -> RawChunk:
    """What is valid of (N, 3) coordinates and of the other columns."""
    flags = [columns.pop(name) for name in INVALID if name in columns]
    if any(flag.any() for flag in flags):
        valid = np.logical_and.reduce([flag == 0 for flag in flags])
        points = points[valid]
        columns = {name: column[valid] for name, column in columns.items()}
    if spherical:
        with np.errstate(invalid="ignore", over="ignore"):
            a, b, c = points.T
            level = a * np.cos(c)
            points = np.column_stack([level * np.cos(b), level * np.sin(b), a * np.sin(c)])
    stamps = columns["timeStamp"].copy() if "timeStamp" in columns else None
    rgb = as_rgb(np.column_stack([columns[n] for n in RGB])) if set(RGB) <= set(columns) else None
    echo = columns["intensity"].astype(np.float32) if "intensity" in columns else None
    return RawChunk(points, stamps=stamps, rgb=rgb, intensity=echo)


def _describe(path: Path, node: Any, index: int) -> E57Scan:
    libe57 = import_library("pye57", "pye57", "E57").libe57
    points = node["points"]
    prototype = libe57.StructureNode(points.prototype())
    fields = frozenset(prototype.get(k).elementName() for k in range(prototype.childCount()))
    if not (fields.issuperset(CARTESIAN) or fields.issuperset(SPHERICAL)):
        raise InputError(
            f"Scan {index} of {path.name} has neither cartesian nor spherical coordinates (it has: "
            f"{', '.join(sorted(fields))[:100]})."
        )
    pose = _pose(path, node, index)
    posed = bool(np.abs(pose - np.eye(4)).max() > 0)
    return E57Scan(index, int(points.childCount()), fields, pose, posed, _seconds(node))


def _pose(path: Path, node: Any, index: int) -> NDArray[np.float64]:
    pose = np.eye(4)
    if not node.isDefined("pose"):
        return pose
    if node.isDefined("pose/rotation"):
        q = np.array([node["pose"]["rotation"][name].value() for name in "xyzw"], dtype=np.float64)
        norm = float(np.linalg.norm(q))
        if not np.isfinite(norm) or norm < MIN_QUATERNION:
            raise InputError(f"The pose of scan {index} of {path.name} has a quaternion that is no rotation.")
        pose[:3, :3] = rotation_from_quaternion(q[None] / norm)[0]
    if node.isDefined("pose/translation"):
        pose[:3, 3] = [node["pose"]["translation"][name].value() for name in "xyz"]
    if not np.isfinite(pose).all():
        raise InputError(
            f"The pose of scan {index} of {path.name} holds a value that is not a finite number."
        )
    return pose


def _seconds(node: Any) -> float:
    if not node.isDefined("acquisitionStart/dateTimeValue"):
        return 0.0
    value = float(node["acquisitionStart"]["dateTimeValue"].value())
    return value if np.isfinite(value) else 0.0
