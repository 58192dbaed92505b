"""Occupancy grid maps: ROS map YAML with its image (map_server), or a bare grey image with a resolution.

A YAML says how grey becomes occupancy: p = (255 - v) / 255, or v / 255 where ``negate``; above
``occupied_thresh`` occupied, below ``free_thresh`` free, else unknown (mode trinary; in mode scale what is
transparent is unknown). A bare image follows the room-segmentation benchmarks: 250 to 255 free, 205 (the grey
of unknown in ROS) and its neighbours unknown, everything else occupied. The first image row is the map's top.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError, UsageError
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, GridMap
from floorplan_core.plain_yaml import read_yaml

IMAGE_SUFFIXES = (".png", ".pgm", ".bmp")
YAML_SUFFIXES = (".yaml", ".yml")
MOST_CELLS = 100_000_000  # 10,000 x 10,000: more is no floor of a building but a mistake
_BARE_FREE, _BARE_UNKNOWN = 250, (204, 206)  # grey values of an image without a YAML
_RESOLUTIONS = (0.001, 1.0)  # m a cell: outside these limits the unit is wrong
_OPAQUE = 255
_ROWS = 256  # of a coloured picture that are looked at together

Grey = NDArray[np.uint8]


@dataclass(frozen=True)
class _Sheet:
    """What a map YAML says."""

    image: Path
    resolution: float
    origin: tuple[float, float, float]
    negate: bool
    occupied: float
    free: float
    scale: bool


def is_grid_map(path: Path) -> bool:
    """True for a picture, and for a YAML that names an image and a resolution."""
    suffix = path.suffix.lower()
    if suffix in IMAGE_SUFFIXES:
        return path.is_file()
    return suffix in YAML_SUFFIXES and path.is_file() and {"image", "resolution"} <= set(_table(path))


def read_grid_map(path: Path, resolution: float | None = None) -> GridMap:
    """Read a map; ``resolution`` (metres a cell) is needed for a bare image and overrides a YAML's.

    :raises InputError: if the file, or the image that it names, is missing, damaged or no map.
    :raises UsageError: if a bare image comes without a resolution.
    """
    if path.suffix.lower() in YAML_SUFFIXES:
        sheet = _read_sheet(path)
        cell = sheet.resolution if resolution is None else resolution
        states = _trinary(*_read_image(sheet.image), sheet)
        return GridMap(path.name, states, _checked(cell, path.name), sheet.origin[:2], sheet.origin[2])
    if resolution is None:
        raise UsageError(
            f"{path.name} is a picture and has no scale; say how many metres a pixel is, "
            "like --resolution 0.05, or give the map's YAML file."
        )
    said = f"{path.name} is a bare image: {_BARE_FREE} and more is free, 205 is unknown, all else is wall."
    grey, _ = _read_image(path)
    return GridMap(path.name, _bare(grey), _checked(resolution, path.name), assumptions=(said,))


def _checked(resolution: float, name: str) -> float:
    low, high = _RESOLUTIONS
    if not low <= resolution <= high:
        raise InputError(
            f"A resolution of {resolution:g} m a pixel for {name} is not between {low:g} and {high:g}; "
            "it is in metres, like 0.05."
        )
    return float(resolution)


def _table(path: Path) -> dict[str, Any]:
    """The YAML's table; an empty one where it holds something else."""
    try:
        data = read_yaml(path)
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def _read_sheet(path: Path) -> _Sheet:
    data = _table(path)
    missing = [key for key in ("image", "resolution") if key not in data]
    if missing:
        raise InputError(f"{path.name} is no map YAML: it does not say {' and '.join(missing)}.")
    try:
        x, y, yaw = (float(v) for v in data.get("origin", (0, 0, 0)))
        occupied, free = float(data.get("occupied_thresh", 0.65)), float(data.get("free_thresh", 0.196))
        sheet = _Sheet(
            _beside(path, data["image"]),
            float(data["resolution"]),
            (x, y, yaw),
            bool(int(data.get("negate", 0))),
            occupied,
            free,
            scale=str(data.get("mode", "trinary")) == "scale",
        )
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{path.name} is a damaged map YAML: {str(error)[:100]}.") from error
    if not all(map(math.isfinite, (x, y, yaw, occupied, free))):
        raise InputError(f"{path.name} is a damaged map YAML: origin and thresholds must be finite numbers.")
    return sheet


def _beside(path: Path, name: Any) -> Path:
    """The image that a YAML names: in its own folder or below, so that nobody's map shows another's files."""
    if not isinstance(name, str):
        raise ValueError("its image is no name of a file")
    image, folder = (path.parent / name).resolve(), path.parent.resolve()
    if Path(name).is_absolute() and not image.is_relative_to(folder):
        image = (folder / Path(name).name).resolve()  # as a map saver wrote it, before both were moved
    if not image.is_relative_to(folder):
        raise InputError(
            f"{path.name} names an image outside its own folder ({name[:60]!r}), which is refused; "
            "put it beside the YAML file and write its name only."
        )
    if not image.is_file():
        raise InputError(f"The map's image {name[:60]} does not exist beside its YAML file.")
    return image


def _read_image(path: Path) -> tuple[Grey, Grey]:
    """(ny, nx) grey and opacity, both 0 to 255; row 0 is the bottom of the picture."""
    from PIL import Image, UnidentifiedImageError

    too_many = f"{path.name} has more than {MOST_CELLS:,} pixels, too many for a map."
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)  # our own limit follows
            picture = Image.open(path)
        with picture:
            if picture.width * picture.height > MOST_CELLS:
                raise InputError(too_many)
            return _grey(picture)
    except Image.DecompressionBombError as error:
        raise InputError(too_many) from error
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError) as error:
        raise InputError(f"{path.name} cannot be read as a picture: {str(error)[:100]}.") from error


def _grey(picture: Any) -> tuple[Grey, Grey]:
    if picture.mode.startswith("I"):  # 16 bits
        grey = (np.asarray(picture).astype(np.float64) / 257).round().clip(0, 255).astype(np.uint8)
        return grey[::-1], np.full_like(grey, _OPAQUE)
    if picture.mode in ("1", "L"):
        grey = np.asarray(picture.convert("L"), dtype=np.uint8)[::-1]
        return grey, np.broadcast_to(np.uint8(_OPAQUE), grey.shape)
    grey, opacity = np.empty((2, picture.height, picture.width), dtype=np.uint8)
    for top in range(0, picture.height, _ROWS):
        rows = slice(top, min(top + _ROWS, picture.height))
        colours = np.asarray(picture.crop((0, rows.start, picture.width, rows.stop)).convert("RGBA"))
        # The mean of the channels, as the robots' map server takes it.
        grey[rows], opacity[rows] = (colours[..., :3].mean(axis=2) + 0.5).astype(np.uint8), colours[..., 3]
    return grey[::-1], opacity[::-1]


def _trinary(grey: Grey, opacity: Grey, sheet: _Sheet) -> Grey:
    """States by the thresholds of the YAML."""
    levels = np.arange(256)
    occupancy = levels / 255.0 if sheet.negate else (255.0 - levels) / 255.0
    table = np.full(256, UNOBSERVED, dtype=np.uint8)
    table[occupancy < sheet.free] = FREE
    table[occupancy > sheet.occupied] = OCCUPIED
    states: Grey = table[grey]
    if sheet.scale:
        states[opacity < _OPAQUE] = UNOBSERVED
    return states


def _bare(grey: Grey) -> Grey:
    """States of an image without thresholds."""
    states = np.full(grey.shape, OCCUPIED, dtype=np.uint8)
    states[grey >= _BARE_FREE] = FREE
    states[(grey >= _BARE_UNKNOWN[0]) & (grey <= _BARE_UNKNOWN[1])] = UNOBSERVED
    return states
