"""PLY: ASCII and binary of both byte orders, any order and type of properties, other elements skipped."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from floorplan_core.errors import InputError
from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.colours import NO_COLOURS, find_colours
from floorplan_core.readers.fields import SCAN_ID_NAMES, STAMP_NAMES, find_name, find_xyz
from floorplan_core.readers.ply_header import MAX_HEADER_BYTES, PlyElement, PlyHeader, parse_ply_header
from floorplan_core.readers.ply_lists import constant_record, skip_list_element
from floorplan_core.readers.records import RecordLayout, record_chunks, record_sample, scan_ids_of
from floorplan_core.readers.source import EmptyInput, PointSource
from floorplan_core.readers.text_rows import (
    TextLayout,
    find_rows,
    skip_lines,
    text_chunks,
    text_sample,
    text_scan_ids,
)


class PlyReader:
    """Point clouds (and the vertices of meshes) in PLY files."""

    name = "PLY"
    suffixes: tuple[str, ...] = (".ply",)
    description = "Polygon file format: ASCII or binary, optional scan_id"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.9 where the file begins with the line ``ply``: a reader of meshes may be surer."""
        return 0.9 if head[:4] in (b"ply\n", b"ply\r") else 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where header and contents do not agree."""
        return assemble(ply_source(path, options.colours), options, observer)


def ply_source(path: Path, colours: bool = True) -> PointSource:
    """The vertices of a PLY file; where it is binary, without ``colours`` if nobody wants them."""
    header = read_ply_header(path)
    vertex = header.element("vertex")
    if vertex is None:
        names = ", ".join(e.name for e in header.elements) or "none"
        raise InputError(f"{path.name} is a PLY file without vertices (its elements: {names}).")
    if vertex.count == 0:
        raise EmptyInput(f"{path.name} is a PLY file of 0 points.")
    if header.byte_order:
        return _binary_source(path, header, vertex, colours)
    return _text_source(path, header, vertex)


def read_ply_header(path: Path) -> PlyHeader:
    """Read and parse the header, however long its comments are (up to ``MAX_HEADER_BYTES``)."""
    with path.open("rb") as handle:
        head = handle.read(MAX_HEADER_BYTES)
    return parse_ply_header(head, path.name)


def _binary_source(path: Path, header: PlyHeader, vertex: PlyElement, colours: bool) -> PointSource:
    size = path.stat().st_size
    offset = header.size
    for element in header.elements[: header.elements.index(vertex)]:
        offset = skip_list_element(path, element, header.byte_order, offset)
    dtype = constant_record(path, vertex, header.byte_order, offset)
    present = max(0, size - offset) // dtype.itemsize
    if present < vertex.count:
        raise InputError(
            f"{path.name} is truncated: its header promises {vertex.count:,} points, "
            f"the file holds {present:,} of them; copy it again."
        )
    names = list(dtype.names or ())
    layout = RecordLayout(
        dtype,
        offset,
        vertex.count,
        _coordinates(path, names),
        find_name(names, SCAN_ID_NAMES),
        find_name(names, STAMP_NAMES),
        find_colours(names) if colours else NO_COLOURS,
    )
    return PointSource(
        path,
        "PLY",
        partial(record_chunks, path, layout),
        partial(record_sample, path, layout),
        vertex.count,
        layout.scan_id is not None,
        scan_ids_of(path, layout),
    )


def _text_source(path: Path, header: PlyHeader, vertex: PlyElement) -> PointSource:
    names = _text_columns(path, vertex)
    before = sum(e.count for e in header.elements[: header.elements.index(vertex)])
    offset = skip_lines(path, header.size, min(before, path.stat().st_size))
    present, end = find_rows(path, offset, vertex.count)
    if present < vertex.count:
        raise InputError(
            f"{path.name} is truncated: its header promises {vertex.count:,} points, "
            f"the file has lines for {present:,} of them; copy it again."
        )
    x, y, z = (names.index(n) for n in _coordinates(path, names))
    scan_id, stamp = find_name(names, SCAN_ID_NAMES), find_name(names, STAMP_NAMES)
    layout = TextLayout(
        offset,
        len(names),
        (x, y, z),
        None if scan_id is None else names.index(scan_id),
        None if stamp is None else names.index(stamp),
        end=end,
    )
    return PointSource(
        path,
        "PLY",
        partial(text_chunks, path, layout),
        partial(text_sample, path, layout),
        vertex.count,
        scan_id is not None,
        text_scan_ids(path, layout),
    )


def _text_columns(path: Path, vertex: PlyElement) -> list[str]:
    """Names of the leading columns; what comes after a list cannot be told by its column."""
    names: list[str] = []
    for item in vertex.properties:
        if item.count_type:
            break
        names.append(item.name)
    return names


def _coordinates(path: Path, names: list[str]) -> tuple[str, str, str]:
    xyz = find_xyz(names)
    if xyz is None:
        raise InputError(
            f"{path.name} has no coordinates: its points have {', '.join(names) or 'no properties'}, "
            "not x, y, z."
        )
    return xyz
