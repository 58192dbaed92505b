"""The records of an E57 scan (ASTM E2807, 9.3): pages with checksums, packets, streams of packed bits.

libE57 reads them too, but holds Python's lock and takes four times as long; here the loops are kernels that
leave the other core free. Where a scan is laid out as no writer that we know does it, libE57 reads it.

A file is pages of 1020 bytes and a CRC-32C. A scan is a sequence of packets; a data packet holds a piece of
the stream of each field, and the pieces of one field, one after the other, are its values with equally many
bits each, lowest bit first. Floats are stored as they are; integers as what they exceed their minimum by.
"""

from __future__ import annotations

import struct
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from io import FileIO
from pathlib import Path
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from floorplan_core.api import InputError

PAGE, HELD = 1024, 1020  # bytes of a page, and of what it holds before its checksum
SECTION = struct.Struct("<B7xQQQ")  # id, length, places of the first packet and of the index
VECTOR_SECTION = 1
BLOCK_PAGES = 2048  # that are read at a time: 2 MB
STREAM_BYTES = 16 << 20  # of one field that may wait for the others
SPARE = 16  # bytes after a stream that a kernel may read over
_POLYNOMIAL = 0x82F63B78  # CRC-32C, reflected
_SLICES = 8


class UnusualStreams(Exception):
    """The fields of a scan are interleaved in another way than kernels can follow in bounded memory."""


Columns = tuple[NDArray[np.float64], list[NDArray[np.float64]]]


@dataclass(frozen=True)
class Field:
    """How the values of one field are stored."""

    stream: int  # its place among the streams of a packet
    kind: int  # bytes of a float (4 or 8); 0 for integers
    bits: int  # of a value; 0 where all are the minimum
    minimum: int = 0
    scale: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Records:
    """Where the records of a scan are."""

    place: int  # byte of the file at which the section begins
    count: int
    streams: int  # in each packet
    fields: dict[str, Field]


def read_columns(
    path: Path, records: Records, names: Sequence[str], size: int
) -> Generator[Columns, None, None]:
    """The fields ``names`` of all records, at most ``size`` at a time: (N, 3) of three, and the rest.

    :class:`InputError` for a wrong checksum or packet, or where fewer records exist than the scan promises;
    :class:`UnusualStreams` where libE57 must go on after what was given.
    """
    with path.open("rb", buffering=0) as handle:
        yield from _Streams(path, handle, records, names, size).columns()


class _Streams:
    """The bytes of the fields that are wanted, as far as they were read and not used yet."""

    def __init__(self, path: Path, handle: FileIO, records: Records, names: Sequence[str], size: int) -> None:
        self._path, self._handle, self._records = path, handle, records
        self._size = max(8, size // 8 * 8)  # of a chunk: whole bytes, whatever the bits of a value
        self._fields = [records.fields[name] for name in names]
        self._wanted = np.full(records.streams, -1, dtype=np.int64)
        for row, field in enumerate(self._fields):
            self._wanted[field.stream] = row
        self._bytes = np.empty((len(self._fields), 4 * BLOCK_PAGES * PAGE), dtype=np.uint8)
        self._fill = np.zeros(len(self._fields), dtype=np.int64)
        self._held = np.empty((BLOCK_PAGES + 70) * HELD, dtype=np.uint8)  # 64 KB: a packet that is not whole
        self._first, self._last = 0, 0  # of the held bytes that no packet used yet
        self._left = 0  # bytes of the section behind the first of them
        self._page, self._pages = 0, path.stat().st_size // PAGE
        self._block = min(BLOCK_PAGES, 64 + 8 * min(size, records.count) * records.streams // PAGE)
        self._raw = np.empty(self._block * PAGE, dtype=np.uint8)

    def columns(self) -> Generator[Columns, None, None]:
        """Chunks of the columns."""
        self._open_section()
        left = self._records.count
        while left > 0:
            wanted = min(self._size, left)
            while (there := self._complete()) < wanted and self._advance(left - there):
                pass
            # whole bytes are taken: eight values of any width, and at the end what is left
            take = wanted if there >= left else min(there, wanted) // 8 * 8
            if take == 0:
                self._make_room()
                continue
            yield self._take(take)
            left -= take

    def _complete(self) -> int:
        """Records of which all wanted fields are there."""
        there = [int(8 * n) // f.bits for n, f in zip(self._fill, self._fields, strict=True) if f.bits]
        return min(there, default=self._records.count)

    def _make_room(self) -> None:
        """A stream runs ahead of the others: let it, within bounds."""
        capacity = 2 * self._bytes.shape[1]
        if capacity > STREAM_BYTES:
            raise UnusualStreams
        larger = np.empty((len(self._fields), capacity), dtype=np.uint8)
        larger[:, : self._bytes.shape[1]] = self._bytes
        self._bytes = larger

    def _open_section(self) -> None:
        self._go_to(self._records.place)
        head = self._held[self._first : min(self._last, self._first + SECTION.size)].tobytes()
        kind, length, first, _ = SECTION.unpack(head) if len(head) == SECTION.size else (0, 0, 0, 0)
        if kind != VECTOR_SECTION or first + PAGE > self._pages * PAGE:
            raise InputError(f"{self._path.name} is damaged: no points where its description puts them.")
        ahead = _held_before(first) - _held_before(self._records.place)
        self._left = length - ahead
        if 0 < ahead <= self._last - self._first:
            self._first += ahead
        else:
            self._go_to(first)

    def _go_to(self, place: int) -> None:
        self._page, skipped = divmod(place, PAGE)
        self._first = self._last = 0
        self._read_pages()
        self._first = min(skipped, self._last)

    def _read_pages(self) -> bool:
        """Put the next pages behind what is held; False at the end of the file."""
        count = min(self._block, self._pages - self._page)
        kept = self._last - self._first
        self._held[:kept] = self._held[self._first : self._last].copy()
        self._first, self._last = 0, kept
        if count <= 0:
            return False
        self._handle.seek(self._page * PAGE)
        raw = self._raw[: count * PAGE]
        if self._handle.readinto(raw.data) != len(raw):
            raise InputError(
                f"{self._path.name} became shorter while it was read; copy it whole and try again."
            )
        wrong = _strip_pages(raw, self._held[kept : kept + count * HELD])
        if wrong >= 0:
            raise InputError(
                f"{self._path.name} is damaged: page {self._page + wrong:,} has a wrong checksum."
            )
        self._page += count
        self._last = kept + count * HELD
        return True

    def _advance(self, missing: int) -> bool:
        """Sort further packets into the streams; False where there is no room for them."""
        end = min(self._last, self._first + max(0, self._left))
        used, state = _sort_packets(
            self._held[:end], self._first, self._wanted, self._bytes, self._fill, SPARE
        )
        moved = used - self._first
        self._left -= moved
        self._first = used
        if moved:
            return True
        if state == _FULL:
            return False
        if state == _WRONG:
            raise InputError(f"{self._path.name} is damaged: it has a packet of points that cannot be one.")
        if end < self._last or not self._read_pages():
            raise InputError(
                f"{self._path.name} is truncated: {missing:,} of the {self._records.count:,} points of a "
                "scan do not exist."
            )
        return True

    def _take(self, count: int) -> Columns:
        """The first ``count`` values of each field; their bytes are gone then."""
        points, rest_of = np.empty((count, 3)), [np.empty(count) for _ in self._fields[3:]]
        for row, (field, out) in enumerate(zip(self._fields, [*points.T, *rest_of], strict=True)):
            stream = self._bytes[row]
            used = -(-count * field.bits // 8)
            if field.kind:
                out[:] = stream[:used].view(f"<f{field.kind}")
            else:
                _unpack(stream, field.bits, field.minimum, field.scale, field.offset, out)
            left = max(0, int(self._fill[row]) - used)
            stream[:left] = stream[used : used + left].copy()
            self._fill[row] = left
        return points, rest_of


def _held_before(place: int) -> int:
    """How many bytes the pages hold up to a place in the file."""
    return place // PAGE * HELD + place % PAGE


def _crc_tables() -> NDArray[np.uint32]:
    """(8, 256) tables by which eight bytes are taken at once (slicing-by-8, Kounavis and Berry 2005)."""
    tables = np.zeros((_SLICES, 256), dtype=np.uint32)
    for n in range(256):
        crc = n
        for _ in range(8):
            crc = (crc >> 1) ^ (_POLYNOMIAL if crc & 1 else 0)
        tables[0, n] = crc
    for k in range(1, _SLICES):
        tables[k] = (tables[k - 1] >> 8) ^ tables[0, tables[k - 1] & 0xFF]
    return tables


_TABLES = _crc_tables()


def _strip_pages(raw: NDArray[np.uint8], out: NDArray[np.uint8]) -> int:
    """Copy what pages hold; the first page whose checksum is wrong, or -1."""
    words = out.view("<u4") if out.ctypes.data % 4 == 0 else np.empty(len(out) // 4, dtype="<u4")
    wrong = int(_strip_words(raw.view("<u4").reshape(-1, PAGE // 4), words.reshape(-1, HELD // 4), _TABLES))
    if words.base is None:
        out[:] = words.view(np.uint8)
    return wrong


_MORE, _FULL, _WRONG = 0, 1, 2  # why no further packet was sorted


@njit(cache=True, inline="always")
def _take_eight(crc: Any, a: Any, b: Any, t: Any) -> Any:
    """The checksum after two more words; the lowest byte of a word comes first."""
    a ^= crc
    return (
        t[7, a & np.uint32(0xFF)]
        ^ t[6, (a >> np.uint32(8)) & np.uint32(0xFF)]
        ^ t[5, (a >> np.uint32(16)) & np.uint32(0xFF)]
        ^ t[4, a >> np.uint32(24)]
        ^ t[3, b & np.uint32(0xFF)]
        ^ t[2, (b >> np.uint32(8)) & np.uint32(0xFF)]
        ^ t[1, (b >> np.uint32(16)) & np.uint32(0xFF)]
        ^ t[0, b >> np.uint32(24)]
    )


@njit(cache=True, inline="always")
def _is_right(crc: Any, a: Any, stored: Any, t: Any) -> Any:
    """True where the checksum, after the last word, is the one stored: its highest byte comes first."""
    a ^= crc
    crc = np.uint32(0xFFFFFFFF) ^ (
        t[3, a & np.uint32(0xFF)]
        ^ t[2, (a >> np.uint32(8)) & np.uint32(0xFF)]
        ^ t[1, (a >> np.uint32(16)) & np.uint32(0xFF)]
        ^ t[0, a >> np.uint32(24)]
    )
    swapped = (
        (stored >> np.uint32(24))
        | ((stored >> np.uint32(8)) & np.uint32(0xFF00))
        | ((stored & np.uint32(0xFF00)) << np.uint32(8))
        | ((stored & np.uint32(0xFF)) << np.uint32(24))
    )
    return crc == swapped


@njit(cache=True, nogil=True)
def _strip_words(pages: Any, out: Any, t: Any) -> Any:
    """Copy what (P, 256) words of pages hold to (P, 255); the first page whose checksum is wrong, or -1.

    Four pages at a time: within one each step waits for the one before, a processor does four side by side.
    """
    last = len(pages) - 1
    for first in range(0, len(pages), 4):
        i, j, k, m = first, min(first + 1, last), min(first + 2, last), min(first + 3, last)
        a = b = c = d = np.uint32(0xFFFFFFFF)
        for at in range(0, 254, 2):
            a = _take_eight(a, pages[i, at], pages[i, at + 1], t)
            b = _take_eight(b, pages[j, at], pages[j, at + 1], t)
            c = _take_eight(c, pages[k, at], pages[k, at + 1], t)
            d = _take_eight(d, pages[m, at], pages[m, at + 1], t)
        for page, crc in ((i, a), (j, b), (k, c), (m, d)):
            if not _is_right(crc, pages[page, 254], pages[page, 255], t):
                return page
        for page in range(first, m + 1):
            for at in range(255):
                out[page, at] = pages[page, at]
    return -1


@njit(cache=True, inline="always")
def _word(held: Any, at: Any) -> Any:
    """16 bits, the lower byte first; signed, since numba makes floats of signed and unsigned together."""
    return np.int64(held[at]) + (np.int64(held[at + 1]) << 8)


@njit(cache=True, nogil=True)
def _copy(piece: Any, to: Any) -> None:
    """As ``to[:] = piece``, which numba does byte by byte, at a sixteenth of this speed."""
    for k in range(len(to)):
        to[k] = piece[k]


@njit(cache=True, nogil=True)
def _sort_packets(held: Any, at: Any, wanted: Any, streams: Any, fill: Any, spare: Any) -> Any:
    """Append the pieces of whole packets to their streams; the place reached, and why it went no further."""
    room = streams.shape[1] - spare
    while at + 6 <= len(held):
        length = _word(held, at + 2) + 1
        if held[at] > 2 or length < 6 or length % 4:
            return at, _WRONG
        if at + length > len(held):
            break
        if held[at] == 1:
            count = _word(held, at + 4)
            piece = at + 6 + 2 * count
            if count != len(wanted) or piece > at + length:
                return at, _WRONG
            for pass_ in range(2):  # first whether all fits, then the bytes
                start = piece
                for s in range(count):
                    size = _word(held, at + 6 + 2 * s)
                    row = wanted[s]
                    if start + size > at + length:
                        return at, _WRONG
                    if row >= 0 and pass_ == 0 and fill[row] + size > room:
                        return at, _FULL
                    if row >= 0 and pass_ == 1:
                        _copy(held[start : start + size], streams[row, fill[row] : fill[row] + size])
                        fill[row] += size
                    start += size
        at += length
    return at, _MORE


@njit(cache=True, nogil=True)
def _unpack(stream: Any, bits: Any, minimum: Any, scale: Any, offset: Any, out: Any) -> None:
    """Values of ``bits`` bits, lowest first, that exceed ``minimum``; scaled."""
    mask = ~np.uint64(0) if bits == 64 else (np.uint64(1) << np.uint64(bits)) - np.uint64(1)
    for i in range(len(out)):
        value = np.uint64(0)
        if bits:
            at, shift = (i * bits) >> 3, (i * bits) & 7
            for k in range(8):
                value |= np.uint64(stream[at + k]) << np.uint64(8 * k)
            value >>= np.uint64(shift)
            if shift + bits > 64:
                value |= np.uint64(stream[at + 8]) << np.uint64(64 - shift)
        out[i] = (np.int64(value & mask) + np.int64(minimum)) * scale + offset
