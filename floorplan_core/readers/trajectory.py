"""Trajectories in TUM form: ``timestamp tx ty tz qx qy qz qw``, one pose a line, ``#`` comments.

KITTI and EuRoC forms are told by their content: :mod:`floorplan_core.readers.trajectory_forms`.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory
from floorplan_core.observer import Observer
from floorplan_core.readers.trajectory_forms import form_of, read_form

Float = NDArray[np.float64]

COLUMNS = 8
MAX_BYTES = 1 << 30  # ten million poses; more is no trajectory
MIN_QUATERNION = 1e-6  # a shorter quaternion has no direction


def read_trajectory(path: Path, observer: Observer | None = None) -> Trajectory:
    """Poses of a TUM, KITTI or EuRoC file, in the file's own coordinates.

    Quaternions are normalised. Raises :class:`InputError` with the line number for anything that is not a
    pose; stamps that go back are reported through ``observer`` (the rows keep their order, because scan
    ids count rows) and held at the latest stamp before them.
    """
    return parse_trajectory(path, trajectory_text(path), observer)


def parse_trajectory(path: Path, text: str, observer: Observer | None = None) -> Trajectory:
    """The same for the ``text`` of the file, or for as much of it as is there."""
    if (form := form_of(text)) != "tum":
        return read_form(path.name, text, form)
    rows = _rows(path, text)
    stamps = rows[:, 0]
    late = np.flatnonzero(np.diff(stamps) < 0)
    if len(late) and observer is not None:
        observer.warning(
            f"The time stamps of {path.name} go back {len(late)} times, first after row {late[0]}; "
            "rows are used in the order of the file."
        )
    return Trajectory(np.maximum.accumulate(stamps), _poses(rows))


def looks_like_trajectory(path: Path) -> bool:
    """True where the first line that is no comment holds eight numbers, or a pose of another form."""
    try:
        with path.open("rb") as handle:
            head = handle.read(4096).decode("utf-8", "replace")
    except OSError:
        return False
    lines = head.splitlines()
    if form_of(head) != "tum":
        return True
    words = [w for w in map(_words, lines) if w]
    return any(_is_pose(w) for w in words[:2])


def rotation_from_quaternion(q: Float) -> Float:
    """(N, 3, 3) rotations of (N, 4) unit quaternions x, y, z, w."""
    x, y, z, w = q.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def trajectory_text(path: Path) -> str:
    """The whole file; :class:`InputError` where it is too large, unreadable or no text."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise InputError(f"{path.name} is too large for a trajectory ({path.stat().st_size:,} bytes).")
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"Cannot read the trajectory {path.name}: {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path.name} is not a trajectory: it is not text.") from error


def _rows(path: Path, text: str) -> Float:
    """(M, 8) numbers with unit quaternions."""
    at_once = _rows_at_once(text)
    if at_once is not None:
        return at_once
    rows: list[list[float]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        words = _words(line)
        if words and not (not rows and _is_header(words)):
            rows.append(_pose(path, number, words))
    if not rows:
        raise InputError(f"The trajectory {path.name} holds no poses.")
    return np.array(rows)


def _rows_at_once(text: str) -> Float | None:
    """All rows where nothing is wrong with any of them; else None, and the careful way says what is."""
    lines = [words for words in map(_words, text.splitlines()) if words]
    if not lines or any(len(words) != COLUMNS for words in lines):
        return None
    try:
        rows = np.array(lines, dtype=np.float64)
    except ValueError:
        return None
    norms = np.linalg.norm(rows[:, 4:], axis=1, keepdims=True)
    if not np.isfinite(rows).all() or norms.min() < MIN_QUATERNION:
        return None
    rows[:, 4:] /= norms
    return rows


def _words(line: str) -> list[str]:
    return line.split("#", 1)[0].replace(",", " ").replace(";", " ").split()


def _is_header(words: list[str]) -> bool:
    return all(word[0].isalpha() and word.lower() not in ("nan", "inf") for word in words)


def _is_pose(words: list[str]) -> bool:
    try:
        return len([float(w) for w in words]) == COLUMNS
    except ValueError:
        return False


def _pose(path: Path, number: int, words: list[str]) -> list[float]:
    where = f"Line {number} of the trajectory {path.name}"
    if len(words) != COLUMNS:
        raise InputError(
            f"{where} has {len(words)} columns instead of the 8 of TUM form (timestamp tx ty tz qx qy qz qw)."
        )
    try:
        row = [float(word) for word in words]
    except ValueError:
        raise InputError(f"{where} is not a row of numbers: {' '.join(words)[:60]!r}.") from None
    if not all(map(math.isfinite, row)):
        raise InputError(f"{where} holds a value that is not a finite number.")
    norm = math.hypot(*row[4:])
    if norm < MIN_QUATERNION:
        raise InputError(f"{where} has a quaternion of length zero, which is no rotation.")
    return row[:4] + [q / norm for q in row[4:]]


def _poses(rows: Float) -> Float:
    poses = np.zeros((len(rows), 4, 4))
    poses[:, :3, :3] = rotation_from_quaternion(rows[:, 4:])
    poses[:, :3, 3] = rows[:, 1:4]
    poses[:, 3, 3] = 1.0
    return poses
