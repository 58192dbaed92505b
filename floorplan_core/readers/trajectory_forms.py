"""Other forms of trajectories: KITTI (a 3 x 4 matrix a line), EuRoC (nanoseconds, quaternion w first)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError
from floorplan_core.model import Trajectory

Float = NDArray[np.float64]

KITTI, MATRIX, EUROC = 12, 16, 17  # columns of each form; EuRoC estimates may leave out all after the pose
POSE = 8  # columns of stamp, position and quaternion
NANOSECONDS_FROM = 1e16  # a stamp as large counts nanoseconds: in seconds it would be 300 million years
MAX_SKEW = 0.05  # largest deviation of R R' from the identity that rounding explains
MIN_QUATERNION = 1e-6  # a shorter quaternion has no direction


def form_of(text: str) -> str:
    """ "kitti", "euroc", or "tum" for everything else, by the first line of numbers."""
    for line in text.splitlines()[:50]:
        row = _numbers(line)
        if row is None:
            continue
        if len(row) in (KITTI, MATRIX) and is_rigid(_matrices(np.array([row])), mirrored=None)[0]:
            return "kitti"
        if row[0] >= NANOSECONDS_FROM and (len(row) == EUROC or len(row) == POSE):
            return "euroc"
        return "tum"
    return "tum"


def read_form(name: str, text: str, form: str) -> Trajectory:
    """Poses of a KITTI or EuRoC file; :class:`InputError` with the line that is wrong."""
    rows, lines = _table(name, text)
    return _kitti(name, rows, lines) if form == "kitti" else _euroc(name, rows, lines)


def is_rigid(T: Float, mirrored: bool | None = False) -> NDArray[np.bool_]:
    """(M,) which of (M, 4, 4) matrices are rotations with a translation, up to rounding.

    :param mirrored: True: a rotation and a reflection, as poses in a left-handed world are; None: either.
    """
    R = T[:, :3, :3]
    with np.errstate(over="ignore", invalid="ignore"):
        skew = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2))
        good = (skew <= MAX_SKEW) & np.isfinite(T).all(axis=(1, 2))
        return np.asarray(good if mirrored is None else good & ((np.linalg.det(R) < 0) == mirrored))


def are_reflections(T: Float) -> bool:
    """True where all of (M, 4, 4) poses turn a right-handed sensor's axes into left-handed ones, M > 0."""
    return len(T) > 0 and bool((np.linalg.det(T[:, :3, :3]) < 0).all())


def nearest_rotations(R: Float) -> Float:
    """(M, 3, 3) the orthonormal matrices nearest to almost orthonormal ones, by their singular values."""
    u, _, v = np.linalg.svd(R)
    return np.asarray(u @ v)


def _kitti(name: str, rows: Float, lines: list[int]) -> Trajectory:
    """One pose a row; the file has no times, so rows are a second apart."""
    poses = _matrices(rows)
    bad = np.flatnonzero(~is_rigid(poses, mirrored=are_reflections(poses[:1])))
    if len(bad):
        raise InputError(f"Line {lines[bad[0]]} of the trajectory {name} is no rotation with a translation.")
    poses[:, :3, :3] = nearest_rotations(poses[:, :3, :3])
    return Trajectory(np.arange(len(poses), dtype=np.float64), poses)


def _euroc(name: str, rows: Float, lines: list[int]) -> Trajectory:
    """Nanoseconds, x y z, quaternion w x y z, and more that is not used."""
    from floorplan_core.readers.trajectory import rotation_from_quaternion

    q = rows[:, [5, 6, 7, 4]]
    norms = np.linalg.norm(q, axis=1)
    bad = np.flatnonzero(~(np.isfinite(rows[:, :POSE]).all(axis=1) & (norms > MIN_QUATERNION)))
    if len(bad):
        raise InputError(f"Line {lines[bad[0]]} of the trajectory {name} holds no pose of finite numbers.")
    poses = np.zeros((len(rows), 4, 4))
    poses[:, :3, :3] = rotation_from_quaternion(q / norms[:, None])
    poses[:, :3, 3], poses[:, 3, 3] = rows[:, 1:4], 1.0
    return Trajectory(np.maximum.accumulate(rows[:, 0] * 1e-9), poses)


def _matrices(rows: Float) -> Float:
    """(M, 4, 4) from rows of 12 or 16 numbers, row-major."""
    poses = np.zeros((len(rows), 4, 4))
    poses[:, :3] = rows[:, :12].reshape(-1, 3, 4)
    poses[:, 3, 3] = 1.0
    return poses


def _table(name: str, text: str) -> tuple[Float, list[int]]:
    """All rows of numbers and the lines on which they stand; as many columns on each."""
    rows: list[list[float]] = []
    lines: list[int] = []
    for number, row in _rows(name, text):
        if rows and len(row) != len(rows[0]):
            raise InputError(
                f"Line {number} of the trajectory {name} has {len(row)} columns, those before {len(rows[0])}."
            )
        rows.append(row)
        lines.append(number)
    return np.array(rows), lines


def _rows(name: str, text: str) -> Iterator[tuple[int, list[float]]]:
    started = False
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.split("#", 1)[0].replace(",", " ").split()
        row = _numbers(line)
        if row is not None:
            started = True
            yield number, row
        elif words and started:
            raise InputError(
                f"Line {number} of the trajectory {name} is not a row of numbers: {line[:60]!r}."
            )


def _numbers(line: str) -> list[float] | None:
    words = line.split("#", 1)[0].replace(",", " ").replace(";", " ").split()
    try:
        return [float(word) for word in words] or None
    except ValueError:
        return None
