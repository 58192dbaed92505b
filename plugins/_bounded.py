"""Unpacking with an end: a few kilobytes of a recording must not become gigabytes of memory or of disk.

rosbags unpacks whole chunks at once, whatever comes out of them. Its tables of decompressors are filled with
ours, which stop at ``MOST_BYTES``: no chunk and no message of a robot is nearly as large.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any

from floorplan_core.api import InputError

MOST_BYTES = 256 << 20  # of one chunk or message, unpacked; recorders write chunks of 1 to 4 MB
MOST_FILE = 64 << 30  # of a whole file that is unpacked to the disk
MOST_RATIO = (
    200  # of such a file: clouds and pictures shrink to a third, zeros without end to a ten-thousandth
)


class Bomb(InputError):
    """Something that unpacks to more than any recording holds."""


def unpack(make: Callable[[], Any], data: bytes, most: int | None = None) -> bytes:
    """All streams in ``data``, one after the other; ``make()`` gives a decompressor for one of them.

    :class:`Bomb` where more than ``most`` bytes (default: ``MOST_BYTES``) come out.
    """
    most = MOST_BYTES if most is None else most
    parts, size, rest = [], 0, bytes(data)
    while rest:
        stream = make()
        part = stream.decompress(rest, most - size + 1)
        size += len(part)
        if size > most:
            raise Bomb(
                f"A chunk of the recording was refused: {len(data):,} bytes unpack to more than {most:,}, "
                "which no sensor writes."
            )
        if not stream.eof:
            raise ValueError("a compressed chunk ends before its end")
        parts.append(part)
        rest = stream.unused_data or b""
    return b"".join(parts)


class BoundedFile:
    """A compressed file, open for reading, that ends with :class:`Bomb` where it goes on for ever."""

    def __init__(self, file: Any, packed: int) -> None:
        self._file, self._left, self._packed = (
            file,
            max(MOST_BYTES, min(MOST_FILE, MOST_RATIO * packed)),
            packed,
        )

    def read(self, size: int = -1) -> bytes:
        """Up to ``size`` bytes."""
        data: bytes = self._file.read(size)
        self._left -= len(data)
        if self._left < 0:
            raise Bomb(f"The recording was refused: its {self._packed:,} bytes unpack without end.")
        return data

    def __enter__(self) -> BoundedFile:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


class _BoundedZstd:
    """What rosbags uses of the module ``zstd``, with an end."""

    def __init__(self, zstd: Any) -> None:
        self._zstd = zstd

    def __getattr__(self, name: str) -> Any:
        return getattr(self._zstd, name)

    def decompress(self, data: bytes) -> bytes:
        """A whole message."""
        return unpack(self._zstd.ZstdDecompressor, data)

    def open(self, file: Any, mode: str) -> Any:
        """A whole file."""
        opened = self._zstd.open(file, mode)
        if "r" not in mode:
            return opened
        place = file.seek(0, 2)
        file.seek(0)
        return BoundedFile(opened, place)


@lru_cache(maxsize=1)
def bound_rosbags() -> None:
    """Make rosbags unpack with an end; once is enough."""
    from bz2 import BZ2Decompressor

    from lz4.frame import LZ4FrameDecompressor
    from rosbags.rosbag1 import reader as ros1
    from rosbags.rosbag2 import reader as ros2
    from rosbags.rosbag2 import storage_mcap as mcap

    zstd = _BoundedZstd(ros2.zstd)
    ros1.decompressors["bz2"] = partial(unpack, BZ2Decompressor)
    ros1.decompressors["lz4"] = partial(unpack, LZ4FrameDecompressor)
    mcap.DECOMPRESSORS["lz4"] = lambda data, _: unpack(LZ4FrameDecompressor, data)
    mcap.DECOMPRESSORS["zstd"] = lambda data, _: zstd.decompress(data)
    ros2.zstd = zstd
