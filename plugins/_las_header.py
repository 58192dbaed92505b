"""The public header of a LAS file (ASPRS LAS 1.4 R15), checked before a library believes it; its CRS."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from floorplan_core.api import EmptyInput, InputError

HEADER_BYTES = 375  # of LAS 1.4, the longest
SIZES = {0: 227, 1: 227, 2: 227, 3: 235, 4: 375}  # bytes of the header by minor version
RECORD_BYTES = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)  # least record by point format
VLR_BYTES = 54
SIGNATURE = b"\xdd\xcc"  # of LAS 1.0
MAX_CHUNK_BYTES = 64 << 20  # of one LAZ chunk, unpacked; writers take 50,000 points
COMPRESSED = 0x80  # bit of the point format that LAZ sets
MAX_FIELDS = 1 << 14  # bytes of one record that can be meant
LINEAR_UNITS = {9001: "m", 9002: "ft", 9003: "us-ft"}  # EPSG codes
FOOT, US_FOOT, FEET_APART = 0.3048, 1200 / 3937, 3e-7  # metres; half of what lies between them
MODEL_TYPE, PROJECTED, LINEAR, GEOGRAPHIC = 1024, 3072, 3076, 2  # GeoTIFF keys, and a model type


@dataclass(frozen=True)
class LasHead:
    """What we need of the header."""

    minor: int
    point_format: int
    compressed: bool
    record: int  # bytes
    offset: int  # of the first record
    count: int


def read_las_head(path: Path) -> LasHead:
    """Parse and check the header; :class:`InputError` says what cannot be true."""
    with path.open("rb") as handle:
        data = handle.read(HEADER_BYTES)
    if len(data) < SIZES[2]:
        raise InputError(f"{path.name} is truncated inside its LAS header ({len(data)} bytes).")
    major, minor = data[24], data[25]
    if major != 1 or minor not in SIZES or len(data) < SIZES[minor]:
        raise InputError(f"{path.name} is LAS version {major}.{minor}; readable are 1.0 to 1.4.")
    size, offset, vlrs, form, record, count = struct.unpack_from("<HIIBHI", data, 94)
    if minor == 4:
        count = struct.unpack_from("<Q", data, 247)[0] or count
    head = LasHead(minor, form & 0x3F, bool(form & COMPRESSED), record, offset, count)
    _check(path, head, size, vlrs)
    return head


def _check(path: Path, head: LasHead, size: int, vlrs: int) -> None:
    total = path.stat().st_size
    if head.point_format >= len(RECORD_BYTES):
        raise InputError(f"{path.name} has LAS point format {head.point_format}; known are 0 to 10.")
    if not RECORD_BYTES[head.point_format] <= head.record <= MAX_FIELDS:
        raise InputError(f"{path.name} says that its points take {head.record} bytes each; it is damaged.")
    if size < SIZES[head.minor] or size + vlrs * VLR_BYTES > head.offset or head.offset > total:
        raise InputError(
            f"{path.name} is truncated or damaged: its header puts the first point at byte {head.offset:,} "
            f"after {vlrs:,} records, the file has {total:,} bytes."
        )
    if head.count == 0:
        raise EmptyInput(f"{path.name} is a LAS file of 0 points.")
    if head.minor == 0 and not head.compressed:
        _check_signature(path, head, total)
    held = (total - head.offset) // head.record
    if not head.compressed and held < head.count:
        raise InputError(
            f"{path.name} is truncated: its header promises {head.count:,} points, {held:,} of them exist."
        )
    if head.compressed:
        _check_chunk_table(path, head, total)


def _check_signature(path: Path, head: LasHead, total: int) -> None:
    """LAS 1.0 has two bytes before the first point; some writers put the first point at these bytes."""
    with path.open("rb") as handle:
        handle.seek(head.offset)
        signed = handle.read(2) == SIGNATURE
    if signed and total - head.offset == 2 + head.count * head.record:
        raise InputError(
            f"{path.name} is LAS 1.0 and says that its first point is two bytes before it is; "
            "convert it to LAS 1.2 or later."
        )


def _check_chunk_table(path: Path, head: LasHead, total: int) -> None:
    """The number of chunks, for which decoders make room at once, must be one that the file can hold."""
    with path.open("rb") as handle:
        handle.seek(head.offset)
        words = handle.read(8)
        table = struct.unpack("<q", words)[0] if len(words) == 8 else -1
        if table == -1:  # written by a stream: the place is in the last 8 bytes
            handle.seek(max(head.offset, total - 8))
            words = handle.read(8)
            table = struct.unpack("<q", words)[0] if len(words) == 8 else -1
        if not head.offset + 8 <= table <= total - 8:
            raise InputError(f"{path.name} is truncated or damaged: its LAZ chunk table is missing.")
        handle.seek(table)
        chunks = struct.unpack("<II", handle.read(8))[1]
    if chunks > table - head.offset or chunks > head.count:
        raise InputError(f"{path.name} is damaged: its LAZ chunk table announces {chunks:,} chunks.")


def check_chunks(path: Path, head: LasHead, vlrs: Any) -> None:
    """The compressed chunks, for which decoders make room unasked: none larger than the file, or absurd.

    A decoder that finds no memory ends the process, and no exception tells of it.
    """
    import lazrs

    data = [vlr.record_data for vlr in vlrs if type(vlr).__name__ == "LasZipVlr"]
    if not data:
        raise InputError(f"{path.name} is damaged: it is compressed and does not say how.")
    layout = lazrs.LazVlr(data[0])
    if layout.item_size() != head.record:
        raise InputError(
            f"{path.name} is damaged: its compressed points take {layout.item_size()} bytes each, "
            f"its header says {head.record}."
        )
    most = MAX_CHUNK_BYTES // head.record
    if not layout.uses_variable_size_chunks() and not 0 < layout.chunk_size() <= most:
        raise InputError(f"{path.name} is damaged: its LAZ chunks hold {layout.chunk_size():,} points each.")
    with path.open("rb") as handle:
        handle.seek(head.offset)
        chunks = lazrs.read_chunk_table(handle, layout)
    held = path.stat().st_size - head.offset
    if sum(size for _, size in chunks) > held or max((n for n, _ in chunks), default=0) > most:
        raise InputError(f"{path.name} is damaged: the sizes in its LAZ chunk table exceed the file.")
    if sum(n for n, _ in chunks) < head.count:
        raise InputError(
            f"{path.name} is truncated: its header promises {head.count:,} points, "
            f"its {len(chunks):,} chunks hold fewer."
        )


def reference_system(vlrs: Any) -> tuple[str, str]:
    """CRS (WKT or "EPSG:n", "" where none), unit ("m", "ft", "us-ft", "deg" or "auto") that a file states."""
    for vlr in vlrs:
        text = getattr(vlr, "string", "")
        if type(vlr).__name__ == "WktCoordinateSystemVlr" and text:
            return text.strip("\x00 "), unit_of_wkt(text)
    keys = {
        key.id: key.value_offset
        for vlr in vlrs
        if type(vlr).__name__ == "GeoKeyDirectoryVlr"
        for key in vlr.geo_keys
        if key.tiff_tag_location == 0
    }
    code = keys.get(PROJECTED, 0)
    unit = "deg" if keys.get(MODEL_TYPE) == GEOGRAPHIC else LINEAR_UNITS.get(keys.get(LINEAR, 0), "auto")
    return (f"EPSG:{code}" if 0 < code < 32767 else ""), unit


def unit_of_wkt(text: str) -> str:
    """ "m", "ft" or "us-ft" of the first unit of length, "deg" for a geographic system, else "auto"."""
    if re.match(r"\s*GEOG", text):
        return "deg"
    for factor in re.findall(r'UNIT\["[^"]*",\s*([0-9.eE+-]+)', text):
        value = float(factor) if re.fullmatch(r"[0-9]+\.?[0-9]*([eE][+-]?[0-9]+)?", factor) else 0.0
        if value == 1.0:
            return "m"
        if abs(value - FOOT) < FEET_APART:
            return "ft"
        if abs(value - US_FOOT) < FEET_APART:
            return "us-ft"
    return "auto"


def name_of_crs(crs: str) -> str:
    """The name by which people call it."""
    match = re.match(r'\s*\w+\["([^"]+)"', crs)
    return match.group(1) if match else crs
