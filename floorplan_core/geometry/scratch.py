"""Arrays that live in nameless files of the temporary folder instead of in memory.

The system writes their pages out and takes them back as memory is needed, so that only disk bounds them. The
files have no name from the moment they are made: whatever ends the process, nothing of them stays.
"""

from __future__ import annotations

import errno
import math
import mmap
import os
import tempfile
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from floorplan_core.errors import OutputError

_IN_MEMORY = frozenset({"tmpfs", "ramfs"})  # kinds of file systems whose files are memory
_ON_DISK = Path("/var/tmp")  # where systems keep temporary files on disk when /tmp is memory
_MOUNTS = Path("/proc/self/mounts")


def disk_array(shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
    """An array of zeros in a file; its disk space is taken now, so that writing to it cannot fail.

    Raises :class:`OutputError` where the disk is full.
    """
    count = math.prod(shape)
    size = max(1, count * np.dtype(dtype).itemsize)
    folder = scratch_folder()
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            _take(file, size)
            held = mmap.mmap(file.fileno(), size)
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise OutputError(
                f"The survey is larger than memory, and no temporary file of {size / 1e6:.0f} MB can be made "
                f"in {folder} ({error.strerror or error}); set TMPDIR to a folder on a disk."
            ) from error
        raise OutputError(
            f"The survey is larger than memory, and {folder} has no room for a temporary file of "
            f"{size / 1e6:.0f} MB; free space there, set TMPDIR to a folder on a larger disk, or enlarge "
            "voxels.size."
        ) from error
    return np.frombuffer(held, dtype=dtype, count=count).reshape(shape)


def let_go(array: NDArray[Any]) -> None:
    """Leave the pages of a :func:`disk_array` to its file: they count no more as memory of this process."""
    held = array
    while isinstance(held, np.ndarray) and held.base is not None:
        held = held.base
    if isinstance(held, memoryview):
        held = held.obj
    if isinstance(held, mmap.mmap) and hasattr(mmap, "MADV_DONTNEED"):
        held.madvise(mmap.MADV_DONTNEED)


def scratch_folder() -> Path:
    """The temporary folder; where that is memory itself, the one that systems keep on disk."""
    folder = Path(tempfile.gettempdir())
    if _is_memory(folder) and os.access(_ON_DISK, os.W_OK) and not _is_memory(_ON_DISK):
        return _ON_DISK
    return folder


def _take(file: IO[bytes], size: int) -> None:
    """Make the file so long, with blocks of the disk behind all of it where the system can."""
    if hasattr(os, "posix_fallocate"):
        os.posix_fallocate(file.fileno(), 0, size)
    else:
        file.truncate(size)


def _is_memory(folder: Path) -> bool:
    """True where files of this folder are memory, as far as the system tells."""
    try:
        lines = _MOUNTS.read_text(encoding="utf-8", errors="replace").splitlines()
        place = folder.resolve()
    except OSError:
        return False
    kind, depth = "", -1
    for line in lines:
        fields = line.split(" ")
        if len(fields) < 3:
            continue
        mount = Path(fields[1].replace("\\040", " "))
        if len(mount.parts) >= depth and place.is_relative_to(mount):
            kind, depth = fields[2], len(mount.parts)
    return kind in _IN_MEMORY
