"""A fingerprint of a survey, fast enough to take at every opening and saving.

Not for security: it tells a file that was replaced or cut short from the one that was there before. Of each
file it holds the size and some blocks, so it costs milliseconds for gigabytes.
"""

from __future__ import annotations

import hashlib
import os
import stat
from pathlib import Path

BLOCK = 1 << 16  # bytes
BLOCKS = 8  # of a file, spread from its first to its last byte
MOST_FILES = 20_000  # of a folder that are looked at
FILES_READ = 64  # of a folder, spread over it, whose blocks are read; of the others name and size


def digest(path: Path) -> str:
    """64 hexadecimal digits of a file or folder; "" where there is none, or nothing that can be read."""
    made = hashlib.sha256()
    try:
        mode = path.stat().st_mode
        if stat.S_ISDIR(mode):
            _add_folder(made, path)
        elif stat.S_ISREG(mode):
            _add_file(made, path)
        else:
            return ""  # a pipe would wait for ever
    except (OSError, ValueError):
        return ""
    return made.hexdigest()


def _add_folder(made: hashlib._Hash, folder: Path) -> None:
    files = _files(folder)
    every = max(1, len(files) // FILES_READ)
    for k, file in enumerate(files):
        made.update(f"{file.relative_to(folder).as_posix()}\0{file.stat().st_size}\0".encode())
        if k % every == 0:
            _add_file(made, file)


def _files(folder: Path) -> list[Path]:
    """The files in a folder and below, in order; hidden ones are somebody else's."""
    found: list[Path] = []
    for at, folders, names in os.walk(folder):
        folders[:] = sorted(f for f in folders if not f.startswith("."))
        paths = (Path(at) / n for n in sorted(names) if not n.startswith("."))
        found += [p for p in paths if p.is_file()]
        if len(found) >= MOST_FILES:
            break
    return found[:MOST_FILES]


def _add_file(made: hashlib._Hash, path: Path) -> None:
    with path.open("rb") as handle:
        size = os.fstat(handle.fileno()).st_size
        made.update(f"{size}\0".encode())
        last = max(size - BLOCK, 0)
        for start in sorted({last * k // (BLOCKS - 1) for k in range(BLOCKS)}):
            handle.seek(start)
            made.update(handle.read(BLOCK))
