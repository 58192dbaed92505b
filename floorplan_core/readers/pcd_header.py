"""The header of a PCD file (Point Cloud Library): fields, counts, viewpoint, and how the data is stored."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from floorplan_core.errors import InputError

MAX_HEADER_BYTES = 1 << 16
MAX_COUNT = 1 << 53
MAX_FIELD_COUNT = 1 << 16  # the longest descriptors have some thousand entries
TYPES = {"F": "f", "I": "i", "U": "u"}
SIZES = {"f": (4, 8), "i": (1, 2, 4, 8), "u": (1, 2, 4, 8)}
STORAGES = ("ascii", "binary", "binary_compressed")


@dataclass(frozen=True)
class PcdHeader:
    """A parsed header."""

    names: tuple[str, ...]  # made unique
    dtype: np.dtype[Any]  # one packed record; fields of COUNT > 1 are sub-arrays
    counts: tuple[int, ...]
    points: int
    viewpoint: tuple[float, ...] | None  # tx ty tz qw qx qy qz; None where it is the default
    storage: str  # "ascii", "binary" or "binary_compressed"
    size: int  # bytes up to the first byte of data


def parse_pcd_header(head: bytes, name: str) -> PcdHeader:
    """Parse the first bytes of a PCD file; :class:`InputError` names the entry that is wrong."""
    entries, size = _entries(head, name)
    for needed in ("FIELDS", "SIZE", "TYPE", "DATA"):
        if needed not in entries:
            raise InputError(f"{name} claims to be PCD but its header has no {needed} line.")
    key = "header"
    try:
        key = "DATA"
        storage = entries["DATA"][0].lower()
        if storage not in STORAGES:
            raise ValueError(storage)
        key = "COUNT"
        names = _unique(entries["FIELDS"])
        counts = tuple(int(word) for word in entries.get("COUNT", ["1"] * len(names)))
        if any(not 1 <= count <= MAX_FIELD_COUNT for count in counts):
            raise ValueError(counts)
        key = "FIELDS, SIZE, TYPE"
        dtype = _record(names, entries["TYPE"], entries["SIZE"], counts)
        key = "POINTS"
        points = _points(entries)
        key = "VIEWPOINT"
        viewpoint = _viewpoint(entries.get("VIEWPOINT", []))
    except (ValueError, KeyError, IndexError):
        raise InputError(f"{name} claims to be PCD but {key} in its header is not valid.") from None
    return PcdHeader(names, dtype, counts, points, viewpoint, storage, size)


def _entries(head: bytes, name: str) -> tuple[dict[str, list[str]], int]:
    """Words of each header line by its key, and the bytes up to the data."""
    entries: dict[str, list[str]] = {}
    start = 0
    while "DATA" not in entries:
        end = head.find(b"\n", start)
        if end < 0:
            raise InputError(f"{name} claims to be PCD but its header does not end (no DATA line).")
        words = head[start:end].decode("latin-1").split("#", 1)[0].split()
        start = end + 1
        if words:
            entries[words[0].upper()] = words[1:]
    return entries, start


def _unique(names: list[str]) -> tuple[str, ...]:
    """Names that numpy takes: padding is called ``_`` again and again."""
    return tuple(
        name if names.index(name) == place and name != "_" else f"{name}#{place}"
        for place, name in enumerate(names)
    )


def _record(
    names: tuple[str, ...], types: list[str], sizes: list[str], counts: tuple[int, ...]
) -> np.dtype[Any]:
    if not len(names) == len(types) == len(sizes) == len(counts):
        raise ValueError(names)
    fields: list[tuple[Any, ...]] = []
    for name, kind, size, count in zip(names, types, sizes, counts, strict=True):
        code = TYPES[kind.upper()]
        if int(size) not in SIZES[code]:
            raise ValueError(size)
        fields.append((name, f"<{code}{size}") if count == 1 else (name, f"<{code}{size}", (count,)))
    return np.dtype(fields)


def _points(entries: dict[str, list[str]]) -> int:
    if "POINTS" in entries:
        points = int(entries["POINTS"][0])
    else:
        points = int(entries["WIDTH"][0]) * int(entries.get("HEIGHT", ["1"])[0])
    if not 0 <= points <= MAX_COUNT:
        raise ValueError(points)
    return points


def _viewpoint(words: list[str]) -> tuple[float, ...] | None:
    values = tuple(float(word) for word in words)
    if not values or values == (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0):
        return None
    if len(values) != 7 or not all(map(math.isfinite, values)) or not any(values[3:]):
        raise ValueError(words)
    return values
