"""Names under which files store the columns that we use, compared in lower case."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

XYZ_NAMES = (
    ("x", "y", "z"),
    ("//x", "y", "z"),
    ("px", "py", "pz"),
    ("pos_x", "pos_y", "pos_z"),
    ("x_m", "y_m", "z_m"),
    ("easting", "northing", "elevation"),
    ("easting", "northing", "height"),
    ("east", "north", "height"),
    ("rechtswert", "hochwert", "höhe"),
)
SCAN_ID_NAMES = (
    "scan_id", "scanid", "scan_index", "scan_idx", "scan_number", "scan", "frame_id", "frame_index", "frame",
    "pose_id", "pose_index", "station_id", "scan_ids",
)  # fmt: skip
STAMP_NAMES = ("timestamp", "stamp", "stamps", "time", "gps_time", "gpstime")


def find_xyz(names: Sequence[str]) -> tuple[str, str, str] | None:
    """The three names (as written) that hold the coordinates, or None."""
    written = {name.strip().lower(): name for name in reversed(names)}
    for triple in XYZ_NAMES:
        if all(name in written for name in triple):
            return written[triple[0]], written[triple[1]], written[triple[2]]
    return None


def find_name(names: Iterable[str], wanted: Sequence[str]) -> str | None:
    """The first of ``wanted`` that is among ``names``, as written there, or None."""
    written = {name.strip().lower(): name for name in names}
    return next((written[name] for name in wanted if name in written), None)
