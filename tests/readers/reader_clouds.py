"""Synthetic rooms, writers for every format, and an observer that remembers, for the tests of the readers."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer

ROOM = (8.0, 5.0, 2.6)


class Remembering(Observer):
    """Keeps the warnings."""

    def __init__(self) -> None:
        super().__init__()
        self.warnings: list[str] = []

    def warning(self, text: str) -> None:
        self.warnings.append(text)


def room(rng, size=ROOM, density=120.0, noise=0.01, tables=4):
    """(N, 3) points of a furnished box room, metres, z up, one corner at the origin; float64."""
    x, y, _ = size
    parts = []
    for axis in range(3):
        others = [a for a in range(3) if a != axis]
        area = size[others[0]] * size[others[1]]
        for side in (0.0, size[axis]):
            p = rng.uniform(0, 1, (int(area * density), 3)) * size
            p[:, axis] = side
            parts.append(p)
    for _ in range(tables):
        corner = rng.uniform(0, 1, 2) * (x - 1.6, y - 0.8)
        top = rng.uniform(0, 1, (int(1.28 * density), 3)) * (1.6, 0.8, 0) + (*corner, 0.74)
        legs = rng.uniform(0, 1, (int(1.5 * density), 3)) * (1.6, 0.05, 0.74) + (*corner, 0)
        parts += [top, legs]
    points = np.concatenate(parts)
    return points + rng.normal(0, noise, points.shape)


def path_in_room(count=40, height=1.2):
    """(M, 8) TUM rows of a sensor that walks around the room, turning with its path."""
    a = np.linspace(0, 2 * np.pi, count)
    x, y = 4.0 + 2.5 * np.cos(a), 2.5 + 1.3 * np.sin(a)
    z = height + 0.01 * np.sin(7 * a)
    return np.column_stack([0.5 * np.arange(count), x, y, z, 0 * a, 0 * a, np.sin(a / 2), np.cos(a / 2)])


def write_tum(path: Path, rows) -> Path:
    lines = [" ".join(f"{v:.9g}" for v in row) for row in rows]
    path.write_text("# timestamp tx ty tz qx qy qz qw\n" + "\n".join(lines) + "\n")
    return path


PLY_NAMES = {
    "i1": "char",
    "u1": "uchar",
    "i2": "short",
    "u2": "ushort",
    "i4": "int",
    "u4": "uint",
    "f4": "float",
    "f8": "double",
}


def ply_header(form: str, elements) -> bytes:
    lines = ["ply", f"format {form} 1.0", "comment made by a test"]
    for name, count, properties in elements:
        lines.append(f"element {name} {count}")
        lines += [f"property {p}" for p in properties]
    return ("\n".join(lines) + "\nend_header\n").encode()


def write_ply(path: Path, form: str, columns: dict, before=b"", before_elements=(), after=b"") -> Path:
    """``columns`` maps a property's name to an array; its dtype is what is written."""
    order = {"binary_big_endian": ">"}.get(form, "<")
    count = len(next(iter(columns.values())))
    properties = [f"{PLY_NAMES[a.dtype.str[1:]]} {name}" for name, a in columns.items()]
    head = ply_header(form, [*before_elements, ("vertex", count, properties)])
    if form == "ascii":
        cast = [a.tolist() for a in columns.values()]
        body = "".join(" ".join(repr(v) for v in row) + "\n" for row in zip(*cast, strict=True)).encode()
    else:
        dtype = [(name, order + a.dtype.str[1:]) for name, a in columns.items()]
        rows = np.empty(count, dtype=dtype)
        for name, a in columns.items():
            rows[name] = a
        body = rows.tobytes()
    path.write_bytes(head + before + body + after)
    return path


def xyz_columns(points, dtype="f4", **more) -> dict:
    return {name: points[:, k].astype(dtype) for k, name in enumerate("xyz")} | more


def lzf_literal(data: bytes) -> bytes:
    """LZF that only uses literal runs: valid, if not small."""
    runs = (data[k : k + 32] for k in range(0, len(data), 32))
    return b"".join(bytes([len(run) - 1]) + run for run in runs)


def write_pcd(path: Path, storage: str, columns: dict, viewpoint="0 0 0 1 0 0 0", points=None) -> Path:
    count = len(next(iter(columns.values())))
    kinds = [a.dtype.kind.upper() for a in columns.values()]
    sizes = [str(a.dtype.itemsize) for a in columns.values()]
    head = (
        f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {' '.join(columns)}\n"
        f"SIZE {' '.join(sizes)}\nTYPE {' '.join(kinds)}\nCOUNT {' '.join('1' for _ in kinds)}\n"
        f"WIDTH {count}\nHEIGHT 1\nVIEWPOINT {viewpoint}\nPOINTS {points or count}\nDATA {storage}\n"
    ).encode()
    if storage == "ascii":
        cast = [a.tolist() for a in columns.values()]
        body = "".join(" ".join(repr(v) for v in row) + "\n" for row in zip(*cast, strict=True)).encode()
    elif storage == "binary":
        rows = np.empty(count, dtype=[(n, a.dtype) for n, a in columns.items()])
        for name, a in columns.items():
            rows[name] = a
        body = rows.tobytes()
    else:
        raw = b"".join(a.tobytes() for a in columns.values())
        packed = lzf_literal(raw)
        body = struct.pack("<II", len(packed), len(raw)) + packed
    path.write_bytes(head + body)
    return path


def all_points(survey: Reconstruction):
    """(points, scan ids) of a whole pass."""
    chunks = list(survey.chunks())
    points = np.concatenate([c.points for c in chunks])
    ids = [c.scan_id for c in chunks if c.scan_id is not None]
    return points, np.concatenate(ids) if ids else None
