"""A folder of numbered scans with a trajectory: one row for each scan, points in the sensor's frame."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from floorplan_core.errors import InputError
from floorplan_core.model import Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.npz import npz_source
from floorplan_core.readers.pcd import pcd_source
from floorplan_core.readers.ply import ply_source
from floorplan_core.readers.records import RecordLayout, join_chunks, record_chunks, record_sample
from floorplan_core.readers.source import SAMPLE_POINTS, EmptyInput, PointSource, RawChunk, ScanIds
from floorplan_core.readers.text import text_source
from floorplan_core.readers.trajectory import looks_like_trajectory, read_trajectory

NUMBERED = re.compile(r"^(\D*?)(\d+)$")
SAMPLE_SCANS = 64
TRAJECTORY_NAMES = ("trajectory.tum", "trajectory.txt", "poses.tum", "poses.txt", "traj.txt")
KITTI_RECORD = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4")])


@dataclass(frozen=True)
class Scan:
    """One file of the folder and the row of the trajectory that it belongs to."""

    path: Path
    number: int
    row: int = -1


def bin_source(path: Path) -> PointSource:
    """A KITTI scan: float32 x, y, z, intensity without any header."""
    size = path.stat().st_size
    if size == 0:
        raise EmptyInput(f"{path.name} is empty.")
    if size % KITTI_RECORD.itemsize:
        raise InputError(
            f"{path.name} is not a KITTI scan: its {size:,} bytes are no whole number of points of 16 bytes."
        )
    layout = RecordLayout(KITTI_RECORD, 0, size // KITTI_RECORD.itemsize, ("x", "y", "z"))
    return PointSource(
        path, "BIN", partial(record_chunks, path, layout), partial(record_sample, path, layout), layout.count
    )


SOURCES: dict[str, Callable[[Path], PointSource]] = {
    ".ply": ply_source,
    ".pcd": pcd_source,
    ".bin": bin_source,
    ".npz": npz_source,
    ".npy": npz_source,
    ".xyz": text_source,
    ".pts": text_source,
    ".csv": text_source,
}


class ScanFolderReader:
    """Folders of scans in the sensor's frame."""

    name = "scan folder"
    suffixes: tuple[str, ...] = ()
    description = "Folder of numbered scans (000000.ply, .pcd, .bin, .npz, ...) with a trajectory"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.8 for a folder with numbered scans."""
        return 0.8 if not head and path.is_dir() and find_scans(path) else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the folder; :class:`InputError` without a trajectory, or with one of too few rows."""
        scans = find_scans(path)
        file = options.trajectory or find_folder_trajectory(path)
        if file is None:
            raise InputError(
                f"The folder {path.name} holds {len(scans)} scans but no trajectory to place them with; "
                "add trajectory.tum or name one with --trajectory."
            )
        poses = read_trajectory(file, observer)
        scans = assign_rows(path.name, scans, len(poses))
        source = folder_source(path, scans, poses)
        if options.trajectory is None:
            source = replace(source, notes=(f"The trajectory is {file.name}.", *source.notes))
        return assemble(source, replace(options, trajectory=None), observer)


def find_scans(folder: Path) -> list[Scan]:
    """Scans in the order of their numbers: files named by one pattern, of the kind that occurs most."""
    groups: dict[tuple[str, str], list[Scan]] = {}
    try:
        entries = sorted(folder.iterdir())
    except OSError as error:
        raise InputError(f"Cannot read the folder {folder.name}: {error.strerror or error}.") from error
    for entry in entries:
        match = NUMBERED.match(entry.stem)
        if match and entry.suffix.lower() in SOURCES and entry.is_file():
            key = (match.group(1), entry.suffix.lower())
            groups.setdefault(key, []).append(Scan(entry, int(match.group(2))))
    if not groups:
        return []
    largest = max(groups.values(), key=len)  # ties go to the first by name
    return sorted(largest, key=lambda scan: scan.number)


def find_folder_trajectory(folder: Path) -> Path | None:
    """The trajectory in the folder or beside it."""
    candidates = [folder / name for name in TRAJECTORY_NAMES]
    candidates += sorted(folder.glob("*.tum"))[:1]
    candidates += [folder.parent / f"{folder.name}.tum"]
    candidates += [folder.parent / name for name in TRAJECTORY_NAMES]
    usable = (c for c in candidates if c.is_file() and (c.suffix == ".tum" or looks_like_trajectory(c)))
    return next(usable, None)


def assign_rows(folder: str, scans: list[Scan], rows: int) -> list[Scan]:
    """Each scan's row: in order where the counts agree, else by number; :class:`InputError` if neither."""
    if len(scans) == rows:
        return [replace(scan, row=row) for row, scan in enumerate(scans)]
    if len(scans) < rows and scans[-1].number < rows:  # some scans are missing, or the run went on
        return [replace(scan, row=scan.number) for scan in scans]
    raise InputError(
        f"The folder {folder} holds {len(scans)} scans (numbers {scans[0].number} to {scans[-1].number}), "
        f"the trajectory has {rows} rows: one row for each scan is needed."
    )


def folder_source(
    folder: Path, scans: list[Scan], poses: Trajectory, skip: Callable[[str], None] | None = None
) -> PointSource:
    """All scans as one source; each chunk carries the pose of its sensor.

    :param skip: is told what is wrong with a scan that cannot be read, and the others are; None: it raises.
    """
    ids = ScanIds(min(s.row for s in scans), max(s.row for s in scans), True)
    return PointSource(
        folder,
        f"folder of {scans[0].path.suffix.lower().lstrip('.').upper()} scans",
        partial(_chunks, scans, poses, skip),
        partial(_sample, scans, poses, skip),
        None,
        True,
        ids,
        poses,
        (f"{folder.name} holds {len(scans)} scans, each in the frame of its sensor.",),
    )


def _chunks(scans: list[Scan], poses: Trajectory, skip: Callable[[str], None] | None) -> Iterator[RawChunk]:
    for scan in scans:
        with _skipping(scan, skip):
            source = _source_of(scan)
            for chunk in source.chunks() if source else ():
                yield _placed(chunk, scan, poses)


@contextmanager
def _skipping(scan: Scan, skip: Callable[[str], None] | None) -> Iterator[None]:
    """Where ``skip`` wants to know, a scan that cannot be read, or is gone, ends no run."""
    try:
        yield
    except (InputError, OSError) as error:
        if skip is None:
            raise
        reason = error.strerror if isinstance(error, OSError) else str(error)
        skip(f"The scan {scan.path.name} was left out: {(reason or 'unreadable').rstrip('.')}.")


def _source_of(scan: Scan) -> PointSource | None:
    """The points of one scan; None where it has none (a sensor may see nothing)."""
    try:
        return SOURCES[scan.path.suffix.lower()](scan.path)
    except EmptyInput:
        return None


def _placed(chunk: RawChunk, scan: Scan, poses: Trajectory) -> RawChunk:
    return replace(
        chunk,
        scan_id=np.full(len(chunk.points), scan.row, dtype=np.int32),
        T_file_sensor=poses.T_world_sensor[scan.row],
    )


def _sample(scans: list[Scan], poses: Trajectory, skip: Callable[[str], None] | None) -> RawChunk:
    """Some points of some scans, already moved into the frame of the trajectory."""
    chosen = np.unique(np.linspace(0, len(scans) - 1, SAMPLE_SCANS).astype(int))
    each = SAMPLE_POINTS // len(chosen)
    parts = []
    for scan in (scans[k] for k in chosen.tolist()):
        raw = None
        with _skipping(scan, skip):
            source = _source_of(scan)
            raw = source.sample() if source else None
        if raw is None:
            continue
        points = raw.points[:: max(1, len(raw.points) // each)].astype(np.float64)
        T = poses.T_world_sensor[scan.row]
        with np.errstate(over="ignore", invalid="ignore"):
            moved = points @ T[:3, :3].T + T[:3, 3]
        parts.append(RawChunk(moved, np.full(len(points), scan.row, dtype=np.int32)))
    if not parts:
        raise InputError(f"None of the scans {scans[0].path.name} to {scans[-1].path.name} holds a point.")
    return join_chunks(parts)
