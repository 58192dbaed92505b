"""A run that is still being recorded: a folder of scans and its trajectory, followed while they grow."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

import numpy as np

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError, UsageError
from floorplan_core.model import Reconstruction, Trajectory
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble, chunk_factory
from floorplan_core.readers.local import local_trajectory
from floorplan_core.readers.scans import Scan, find_folder_trajectory, find_scans, folder_source
from floorplan_core.readers.trajectory import parse_trajectory, trajectory_text
from floorplan_core.replay import Interval, interval_numbers, path_lengths

POLL = 0.2  # s between two looks at the folder; a scan is whole when it did not grow from one to the next


@dataclass(frozen=True)
class Batch:
    """The scans of one interval, and the poses that were known when it was over, as the files have them."""

    number: int
    scans: list[Scan]
    poses: Trajectory


class GrowingFolder:
    """Scans in the order of their numbers, each as soon as its file is whole and its pose is written.

    The number of a scan, counted from that of the first (0, 1 or any), is its row of the trajectory; one
    whose number is below one that was handed out comes too late.

    :param patience: seconds without a new scan after which the run is taken as over.
    """

    def __init__(
        self,
        folder: Path,
        trajectory: Path | None,
        patience: float,
        observer: Observer,
        wait: Callable[[float], None] = time.sleep,
    ) -> None:
        if folder.exists() and not folder.is_dir():
            raise UsageError(f"{folder.name} is a file; --follow is for a folder of scans that grows.")
        self.folder = folder
        self._given, self._patience, self._observer, self._wait = trajectory, patience, observer, wait
        self._sizes: dict[Path, int] = {}
        self._start: int | None = None  # number of the scan that belongs to the first pose
        self._last = -1  # number of the last one that was handed out
        self._text = ""
        self._poses: Trajectory | None = None

    def scans(self) -> Iterator[tuple[Scan, Trajectory]]:
        """Each scan once, with the poses so far; ends when nothing new came for so long."""
        idle = 0.0
        while idle < self._patience:
            self._observer.check_cancelled()
            poses = self._known_poses()
            rows = 0 if poses is None else len(poses)
            fresh = [s for s in self._whole_scans(rows) if s.row < rows]
            for scan in fresh:
                self._last = scan.number
                yield scan, poses  # type: ignore[misc]  # fresh is empty without poses
            idle = 0.0 if fresh else idle + POLL
            if not fresh:
                self._wait(POLL)

    def _whole_scans(self, rows: int) -> list[Scan]:
        """The new scans up to the first whose file still grew since the last look.

        The first number belongs to the first of ``rows`` poses, unless the run was on already: a robot may
        keep its last scans only.
        """
        found = find_scans(self.folder) if self.folder.is_dir() else []
        if found and rows and self._start is None:
            first = found[0].number
            self._start = 0 if 1 < first < rows else first
        fresh = [replace(s, row=s.number - (self._start or 0)) for s in found if s.number > self._last]
        sizes = {scan.path: size for scan in fresh if (size := _size(scan.path)) is not None}
        before, self._sizes = self._sizes, sizes
        growing = (k for k, s in enumerate(fresh) if before.get(s.path) != sizes.get(s.path, -1))
        return fresh[: next(growing, len(fresh))]

    def _known_poses(self) -> Trajectory | None:
        """The poses whose lines are whole; None while there are none."""
        file = self._given or (find_folder_trajectory(self.folder) if self.folder.is_dir() else None)
        if file is None or not file.exists():
            return None
        text = trajectory_text(file)
        text = text[: text.rfind("\n") + 1]
        if text != self._text and any(line.strip() and line[0] != "#" for line in text.splitlines()):
            self._text, self._poses = text, parse_trajectory(file, text, self._observer)
        return self._poses


def _size(path: Path) -> int | None:
    """Bytes; None where the file is gone."""
    with suppress(OSError):
        return path.stat().st_size
    return None


def follow(
    growing: GrowingFolder, every: float, config: InputConfig, observer: Observer
) -> tuple[Reconstruction, Iterator[Interval]]:
    """The run and its intervals of ``every`` seconds of run time, each as soon as it is over.

    Unit, up axis and shift are guessed from the first interval. Raises :class:`InputError` where no whole
    scan with a pose came in time.
    """
    batches = _batches(growing, every)
    first = next(batches, None)
    if first is None:
        raise InputError(
            f"No whole scan with a pose came into {growing.folder} in time; scans are numbered files "
            "(000000.ply, …), and each needs its row of the trajectory."
        )
    source = folder_source(growing.folder, first.scans, first.poses, lambda _: None)  # they are told below
    run = assemble(source, ReadOptions(config), observer)
    return run, (_interval(run, growing.folder, b, every, observer) for b in chain([first], batches))


def _batches(growing: GrowingFolder, every: float) -> Iterator[Batch]:
    """The scans, gathered until one of a later interval comes or the run is over."""
    batch: Batch | None = None
    for scan, poses in growing.scans():
        number = int(interval_numbers(poses.stamps[[0, scan.row]], every)[1])
        if batch is not None and batch.number == number:
            batch = Batch(number, [*batch.scans, scan], poses)
            continue
        if batch is not None:
            yield replace(batch, poses=poses)
        batch = Batch(number, [scan], poses)
    if batch is not None:
        yield batch


def _interval(run: Reconstruction, folder: Path, batch: Batch, every: float, observer: Observer) -> Interval:
    trajectory = local_trajectory(batch.poses, run.local_frame)
    source = folder_source(folder, batch.scans, batch.poses, observer.warning)
    chunks = chunk_factory(source, run.local_frame, len(trajectory), observer)()
    numbers = interval_numbers(trajectory.stamps, every)
    last = int(np.searchsorted(numbers, batch.number, side="right")) - 1
    end = min((batch.number + 1) * every, float(np.ptp(trajectory.stamps)))
    return Interval(end, float(path_lengths(trajectory)[last]), chunks, trajectory)
