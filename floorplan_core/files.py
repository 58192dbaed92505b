"""Files that appear together, whole, or not at all.

Results are first written under their own names in a hidden folder inside the target folder (the same file
system, so that a rename is enough), then moved into place. An error or Ctrl-C before that moment leaves the
target folder as it was; an error while moving puts the earlier files back.
"""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import FrameType

from floorplan_core.errors import OutputError
from floorplan_core.process_ids import is_running

STAGING_PREFIX = ".floorcast-"
_STAGED = re.compile(re.escape(STAGING_PREFIX) + r"\d+-[^/\\]*[/\\]")
HELD = (signal.SIGINT, signal.SIGTERM)
STALE = 3600.0  # s: a younger folder may be that of a program on another machine that shares the disk

_REASONS = {
    errno.ENOSPC: "there is no space left on the disk; free some, or choose another folder with --out",
    errno.EDQUOT: "the disk quota is used up; free some space, or choose another folder",
    errno.EFBIG: "the file would be larger than this system allows",
    errno.EACCES: "permission denied; choose a folder that you may write to",
    errno.EPERM: "permission denied; choose a folder that you may write to",
    errno.EROFS: "the file system is read-only; choose another folder",
    errno.ENOTDIR: "a part of this path is a file, not a folder",
    errno.EEXIST: "there is a file of this name where a folder is wanted",
    errno.EISDIR: "there is a folder of this name where a file is wanted",
    errno.ENAMETOOLONG: "the name is too long",
    errno.EIO: "the disk reports an error",
}


def output_error(error: OSError, target: Path | str) -> OutputError:
    """The one sentence for a failed write to ``target``, where a staged file is to be in the end."""
    target = _STAGED.sub("", str(target))
    reason = _REASONS.get(error.errno or 0) or (error.strerror or str(error)).rstrip(".").lower()
    return OutputError(f"Cannot write {target}: {reason}.")


@contextmanager
def output_folder(folder: Path) -> Iterator[Path]:
    """A staging folder whose files replace those of ``folder`` when the block ends without an error.

    ``folder`` is made where missing, and removed again if the block fails. Raises :class:`OutputError`,
    before the block begins where the folder cannot be written to.
    """
    made: list[Path] = []
    staging: Path | None = None
    try:
        with writing(folder), uninterrupted():  # or a signal comes before we know what there is to remove
            made = _make_folder(folder)
            _forget_stale(folder)
            staging = Path(tempfile.mkdtemp(prefix=f"{STAGING_PREFIX}{os.getpid()}-", dir=folder))
        yield staging
        with writing(folder), uninterrupted():
            _move_into_place(staging, folder)
        made = []
    finally:
        with uninterrupted():
            _discard(staging, made)


@contextmanager
def output_file(path: Path) -> Iterator[Path]:
    """A temporary path of the same name; the file replaces ``path`` when the block ends without an error."""
    if path.is_dir():
        raise output_error(IsADirectoryError(errno.EISDIR, ""), path)
    with output_folder(path.parent) as staging, writing(path):
        yield staging / path.name


@contextmanager
def writing(target: Path) -> Iterator[None]:
    """Turn the system's errors of a block that writes ``target`` into :class:`OutputError`."""
    try:
        yield
    except OSError as error:
        raise output_error(error, target) from error


def write_text(path: Path, text: str) -> None:
    """Write UTF-8 ``text`` to ``path``, whole or not at all."""
    with output_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Hold Ctrl-C and SIGTERM back until the block is done (moving files takes milliseconds)."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[int] = []
    ours = [s for s in HELD if signal.getsignal(s) is not None]  # None: a library's, in C, is left alone
    previous = {int(s): signal.signal(s, lambda number, _: held.append(number)) for s in ours}
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
        for number in held[:1]:
            _deliver(number, previous[number])


Handler = Callable[[int, FrameType | None], object] | int | signal.Handlers | None


def _deliver(number: int, handler: Handler) -> None:
    """What would have happened when the signal came; one whose handler is the system's ends the program."""
    if callable(handler):
        handler(number, None)
    elif handler != signal.SIG_IGN:
        signal.raise_signal(number)


def _make_folder(folder: Path) -> list[Path]:
    """Make ``folder`` with its parents; returns what was made, deepest first."""
    missing = [p for p in (folder, *folder.parents) if not os.path.lexists(p)]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:  # a full disk may hold some of them
        _discard(None, [p for p in missing if p.is_dir()])
        raise
    return missing


def _forget_stale(folder: Path) -> None:
    """Remove what programs left that were killed while they wrote here."""
    for staging in folder.glob(f"{STAGING_PREFIX}*-*"):
        pid = staging.name.removeprefix(STAGING_PREFIX).partition("-")[0]
        if not pid.isdecimal() or is_running(int(pid)) or not staging.is_dir():
            continue
        with suppress(OSError):
            if time.time() - staging.stat().st_mtime > STALE:
                shutil.rmtree(staging, ignore_errors=True)


def _discard(staging: Path | None, made: list[Path]) -> None:
    if staging is not None:
        shutil.rmtree(staging, ignore_errors=True)
    for folder in made:
        try:
            folder.rmdir()
        except OSError:  # somebody else put something there meanwhile: it is theirs
            return


def _move_into_place(staging: Path, folder: Path) -> None:
    """Move all of ``staging`` into ``folder``; puts back what was there if one move fails."""
    keep = staging / ".replaced"
    names = sorted(p.relative_to(staging) for p in staging.rglob("*") if p.is_file())
    done: list[Path] = []
    try:
        for name in names:
            with writing(folder / name):
                _replace(staging / name, folder / name, keep / name)
            done.append(name)
    except OutputError:
        for name in reversed(done):
            _put_back(folder / name, keep / name)
        raise


def _replace(new: Path, target: Path, keep: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "", str(target))
    if target.exists():
        keep.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(target, keep, follow_symlinks=False)
    os.replace(new, target)


def _put_back(target: Path, keep: Path) -> None:
    if keep.exists():
        os.replace(keep, target)
    else:
        target.unlink(missing_ok=True)
