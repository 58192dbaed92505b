"""Rows of numbers in text (ASCII PLY and PCD, XYZ, PTS, CSV): blocks of whole lines become arrays.

A block in which every line holds the same number of plain numbers is parsed at once, one whose other columns
hold words by numpy's table reader; any other block goes line by line, where lines that are no points are left
out and counted.
"""

from __future__ import annotations

import io
import os
import warnings
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from floorplan_core.readers.records import as_scan_id, join_chunks
from floorplan_core.readers.source import SAMPLE_BLOCKS, SAMPLE_POINTS, RawChunk, ScanIds

Float = NDArray[np.float64]

BLOCK_BYTES = 4 << 20  # some 130,000 points
PARSERS = min(4, max(2, os.cpu_count() or 1))  # blocks at a time: the kernel does without Python's lock
KERNEL_FROM = 1 << 18  # bytes: for less text no kernel is loaded
MAX_LINE_BYTES = 1 << 16  # a longer line is no row of numbers
ORDER_PASS_BYTES = 32 << 20  # up to here a whole pass is cheap enough to learn the order of the scans


@dataclass(frozen=True)
class TextLayout:
    """Where the rows of a text file are and which columns we use."""

    offset: int  # bytes before the first row
    columns: int
    xyz: tuple[int, int, int]
    scan_id: int | None = None
    stamp: int | None = None
    separator: str = " "  # " ", "," or ";"; spaces and tabs always separate, too
    decimal_comma: bool = False
    end: int | None = None  # byte after the last row, where something else may follow


def text_chunks(path: Path, layout: TextLayout) -> Iterator[RawChunk]:
    """All rows, a block of text at a time and in their order; ``PARSERS`` threads parse those ahead."""
    waiting: deque[tuple[bytes, Future[Float | None]]] = deque()
    with ThreadPoolExecutor(PARSERS) as pool:
        for block in _line_blocks(path, layout.offset, layout.end):
            waiting.append((block, pool.submit(_parse_by_kernel, block, layout)))
            if len(waiting) > PARSERS:
                block, rows = waiting.popleft()
                yield _block_chunk(block, layout, rows.result())
        for block, rows in waiting:
            yield _block_chunk(block, layout, rows.result())


def text_sample(path: Path, layout: TextLayout, blocks: int = SAMPLE_BLOCKS) -> RawChunk:
    """Some 250 rows in each of so many blocks that are spread evenly over the file."""
    end = path.stat().st_size if layout.end is None else layout.end
    # 32 bytes are a usual row of three coordinates; longer rows only make the sample smaller.
    block = SAMPLE_POINTS // SAMPLE_BLOCKS * 32
    if end - layout.offset <= block * blocks:
        return parse_block(b"".join(_line_blocks(path, layout.offset, layout.end)), layout)
    parts = []
    with path.open("rb") as handle:
        for start in np.linspace(layout.offset, end - block, blocks).astype(np.int64).tolist():
            handle.seek(start)
            if start != layout.offset:
                handle.readline(MAX_LINE_BYTES)
            data = handle.read(block)
            parts.append(parse_block(data[: data.rfind(b"\n") + 1], layout))
    return join_chunks(parts)


def text_scan_ids(path: Path, layout: TextLayout) -> ScanIds | None:
    """Range and order of the scan ids; None without such a column, or where the file is too long to look."""
    if layout.scan_id is None or path.stat().st_size > ORDER_PASS_BYTES:
        return None
    ids = join_chunks(
        [*text_chunks(path, layout), _rows_to_chunk(np.empty((0, len(_used(layout)))), layout)]
    ).scan_id
    if ids is None or not len(ids):
        return None
    return ScanIds(int(ids.min()), int(ids.max()), bool((ids[1:] >= ids[:-1]).all()))


def find_rows(path: Path, offset: int, count: int) -> tuple[int, int]:
    """How many of ``count`` lines that hold anything follow ``offset``, and the byte after them."""
    found, end = 0, offset
    for block in _line_blocks(path, offset, None):
        lines = block.splitlines(keepends=True)
        held = sum(1 for line in lines if line.strip())
        if found + held < count:
            found, end = found + held, end + len(block)
            continue
        for line in lines:
            if found == count:
                break
            found += bool(line.strip())
            end += len(line)
        break
    return found, end


def skip_lines(path: Path, offset: int, count: int) -> int:
    """The byte after ``count`` further lines (or the end of the file)."""
    with path.open("rb") as handle:
        handle.seek(offset)
        for _ in range(count):
            if not handle.readline(MAX_LINE_BYTES):
                break
        return handle.tell()


def parse_block(block: bytes, layout: TextLayout) -> RawChunk:
    """Points of whole lines."""
    return _block_chunk(block, layout, _parse_by_kernel(block, layout))


def _block_chunk(block: bytes, layout: TextLayout, rows: Float | None) -> RawChunk:
    """What the kernel made of the block; where it could not, what other parsers do."""
    if rows is None and len(block) > MAX_LINE_BYTES and block.find(b"\n", 0, MAX_LINE_BYTES) < 0:
        after = parse_block(block.partition(b"\n")[2], layout)  # of a line so long no table is made
        return replace(after, dropped=after.dropped + 1)
    if rows is None:
        text = normalise(block, layout)
        rows = _parse_at_once(text, layout)
        rows = _parse_columns(text, layout) if rows is None else rows
    return _rows_to_chunk(rows, layout) if rows is not None else _parse_lines(text, layout)


def _parse_by_kernel(block: bytes, layout: TextLayout) -> Float | None:
    if len(block) <= KERNEL_FROM:
        return None
    from floorplan_core.readers.plain_numbers import parse_numbers  # compiled: only for what is worth it

    decimal = "," if layout.decimal_comma else "."
    return parse_numbers(block, layout.columns, _used(layout), layout.separator, decimal)


def normalise(block: bytes, layout: TextLayout) -> bytes:
    """The block with spaces between its columns and points before its decimals."""
    block = block.replace(b'"', b"")
    if min(layout.xyz) > 0 and layout.separator != " ":
        block = _with_whole_cells(block, layout.separator.encode())
    if layout.decimal_comma:
        block = block.replace(b",", b".")
    elif layout.separator == ",":
        block = block.replace(b",", b" ")
    return block.replace(b";", b" ") if layout.separator == ";" else block


def _with_whole_cells(block: bytes, separator: bytes) -> bytes:
    """Cells before the coordinates stay one column each, also where they are empty or hold a space."""
    block = block.replace(b" ", b"").replace(b"\n" + separator, b"\nnan" + separator)
    if block.startswith(separator):
        block = b"nan" + block
    for _ in range(2):  # of three in a row the middle one is met by the second time only
        block = block.replace(2 * separator, separator + b"nan" + separator)
    return block


def _parse_at_once(text: bytes, layout: TextLayout) -> Float | None:
    """The used columns, here and below in the order of :func:`_used`."""
    lines = text.count(b"\n") + (not text.endswith(b"\n") and bool(text))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            values = np.fromstring(text, dtype=np.float64, sep=" ")
        except (ValueError, DeprecationWarning):
            return None
    if len(values) != lines * layout.columns:
        return None
    return values.reshape(lines, layout.columns)[:, _used(layout)]


def _parse_columns(text: bytes, layout: TextLayout) -> Float | None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.loadtxt(io.StringIO(text.decode("latin-1")), usecols=_used(layout), ndmin=2)
        except (ValueError, UserWarning):  # a line that is no point, or no line at all
            return None


def _used(layout: TextLayout) -> list[int]:
    return [c for c in (*layout.xyz, layout.scan_id, layout.stamp) if c is not None]


def _parse_lines(text: bytes, layout: TextLayout) -> RawChunk:
    values, dropped = [], 0
    used = _used(layout)
    for line in text.splitlines():
        words = line[:MAX_LINE_BYTES].split(b"#", 1)[0].split()
        if not words or words[0].startswith(b"//"):
            continue
        try:
            values.append([float(words[c]) for c in used])
        except (IndexError, ValueError):
            dropped += 1
    return _rows_to_chunk(np.array(values).reshape(-1, len(used)), layout, dropped)


def _rows_to_chunk(rows: Float, layout: TextLayout, dropped: int = 0) -> RawChunk:
    """``rows`` hold the used columns only."""
    ids = None if layout.scan_id is None else as_scan_id(rows[:, 3])
    stamps = None if layout.stamp is None else rows[:, -1].copy()
    return RawChunk(np.ascontiguousarray(rows[:, :3]), ids, stamps, dropped=dropped)


def _line_blocks(path: Path, offset: int, end: int | None) -> Iterator[bytes]:
    """Blocks of whole lines from ``offset`` to ``end``; a line longer than a block is cut there."""
    left = (path.stat().st_size if end is None else end) - offset
    with path.open("rb") as handle:
        handle.seek(offset)
        rest = b""
        while left > 0 and (data := handle.read(min(BLOCK_BYTES, left))):
            left -= len(data)
            if b"\n" not in data and b"\r" in data:
                data = data.replace(b"\r", b"\n")  # old Macintosh line ends
            cut = data.rfind(b"\n") + 1
            if cut == 0 and len(rest) < BLOCK_BYTES:
                rest += data
                continue
            yield rest + (data[:cut] if cut else data)
            rest = data[cut:] if cut else b""
        if rest:
            yield rest
