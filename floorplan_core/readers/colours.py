"""Colour and intensity of points, for whoever shows them: found by name, brought to one form.

Nothing is planned with them. Colours become 8 bits a channel; intensity stays in the file's own scale, which
every scanner chooses for itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.readers.fields import find_name

RGB_NAMES = (("red", "green", "blue"), ("r", "g", "b"), ("diffuse_red", "diffuse_green", "diffuse_blue"))
PACKED_NAMES = ("rgb", "rgba")  # PCD: 0x00RRGGBB in the bits of one number of 4 bytes
INTENSITY_NAMES = ("intensity", "scalar_intensity", "reflectance", "reflectivity", "i")
BYTE, HIGH_BYTE = 255, 256


@dataclass(frozen=True)
class ColourColumns:
    """Names of the columns, as the file writes them; empty where it has none."""

    rgb: tuple[str, ...] = ()  # three, or one with packed bits
    intensity: str = ""

    def __bool__(self) -> bool:
        return bool(self.rgb or self.intensity)

    @property
    def names(self) -> tuple[str, ...]:
        """All of them."""
        return (*self.rgb, self.intensity) if self.intensity else self.rgb


NO_COLOURS = ColourColumns()


def find_colours(names: Sequence[str], packed: bool = False) -> ColourColumns:
    """The columns among ``names``; ``packed``: one number may hold all three channels (PCD)."""
    written = {name.strip().lower(): name for name in reversed(names)}
    triple = next((t for t in RGB_NAMES if all(name in written for name in t)), ())
    rgb = tuple(written[name] for name in triple)
    one = find_name(names, PACKED_NAMES) if packed and not rgb else None
    return ColourColumns(rgb if one is None else (one,), find_name(names, INTENSITY_NAMES) or "")


def rgb_of(rows: Mapping[str, NDArray[Any]] | NDArray[Any], columns: ColourColumns) -> Any:
    """(N, 3) uint8 colours of the columns by name; None where there are none."""
    if len(columns.rgb) == 3:
        return as_rgb(np.column_stack([rows[name] for name in columns.rgb]))
    return unpack_rgb(rows[columns.rgb[0]]) if columns.rgb else None


def intensity_of(rows: Mapping[str, NDArray[Any]] | NDArray[Any], columns: ColourColumns) -> Any:
    """(N,) float32 intensities as the file has them; None where it has none."""
    return np.asarray(rows[columns.intensity], dtype=np.float32) if columns.intensity else None


def as_rgb(channels: NDArray[Any]) -> NDArray[np.uint8]:
    """(N, 3) uint8 of channels of 8 bits, 16 bits (also where only the lower 8 are used), or 0 to 1.

    >>> as_rgb(np.array([[0, 65535, 32768]], dtype=np.uint16)).tolist()
    [[0, 255, 128]]
    >>> as_rgb(np.array([[0, 1.0, 0.5]])).tolist()
    [[0, 255, 128]]
    """
    if channels.dtype == np.uint8:
        return np.asarray(channels, dtype=np.uint8)
    known = np.nan_to_num(channels)
    largest = float(known.max()) if known.size else 0.0
    if known.dtype.kind == "f" and largest <= 1.0:
        known = np.round(known * BYTE)
    elif largest > BYTE:
        known = known // HIGH_BYTE
    return np.asarray(np.clip(known, 0, BYTE), dtype=np.uint8)


def unpack_rgb(packed: NDArray[Any]) -> NDArray[np.uint8] | None:
    """(N, 3) uint8 of 0x00RRGGBB in the bits of 4-byte numbers; None for numbers of another size.

    >>> unpack_rgb(np.array([0x102030], dtype=np.uint32).view(np.float32)).tolist()
    [[16, 32, 48]]
    """
    if packed.dtype.itemsize != 4:
        return None
    bits = np.ascontiguousarray(packed).view(packed.dtype.str[0] + "u4").astype(np.uint32)
    return np.column_stack([(bits >> 16) & BYTE, (bits >> 8) & BYTE, bits & BYTE]).astype(np.uint8)
