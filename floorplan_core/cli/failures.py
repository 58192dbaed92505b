"""What the user sees of an exception: one sentence and the documented exit status."""

from __future__ import annotations

import errno

from floorplan_core.cli import NO_MEMORY
from floorplan_core.cli.signals import Terminated
from floorplan_core.errors import FloorPlanError

DONE, WRONG_USE, UNREADABLE, NO_PLAN, INTERRUPTED = 0, 2, 3, 4, 130
UNMAPPED = "failed to map segment from shared object"  # a library that found no memory to be loaded into
TERMINATED = 143  # 128 + SIGTERM, as shells count it
DISK_PROBLEMS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO}


def explain(error: BaseException) -> tuple[str, int]:
    """The sentence and the exit status for ``error``."""
    if isinstance(error, FloorPlanError):
        return str(error), error.exit_status
    if isinstance(error, Terminated):
        return "Terminated; nothing was left half-written.", TERMINATED
    if isinstance(error, KeyboardInterrupt):
        return "Interrupted; nothing was left half-written.", INTERRUPTED
    if isinstance(error, MemoryError) or UNMAPPED in str(error):
        return NO_MEMORY, NO_PLAN
    if isinstance(error, OSError):
        return _explain_os_error(error), UNREADABLE
    return _explain_unexpected(error), NO_PLAN


def _explain_os_error(error: OSError) -> str:
    from floorplan_core.files import output_error

    if error.errno in DISK_PROBLEMS:
        return str(output_error(error, error.filename or "the output"))
    where = f"{error.filename}: " if error.filename else ""
    return f"{where}{(error.strerror or str(error)).rstrip('.')}."


def _explain_unexpected(error: BaseException) -> str:
    first_line = (str(error).strip().splitlines() or ["no message"])[0]
    kind = type(error).__name__
    return f"An unexpected {kind} stopped the work ({first_line}); run again with --debug and report it."
