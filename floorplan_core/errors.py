"""The one family of errors that users see: each says what failed, with which values, and what to try.

``exit_status`` is the documented status of the command line (0 done, 2 wrong use, 3 unreadable input,
4 readable but no plan can be made, 130 interrupted).
"""

from __future__ import annotations


class FloorPlanError(Exception):
    """Base of all errors that Floorcast raises on purpose; its text is one clear sentence."""

    exit_status = 4

    def __str__(self) -> str:
        """The sentence on one line: names of files may hold line ends."""
        return " ".join(super().__str__().splitlines())


class UsageError(FloorPlanError):
    """The call itself is wrong: an unknown option, a value out of bounds, options that exclude each other."""

    exit_status = 2


class InputError(FloorPlanError):
    """The input cannot be read, or is not what it claims to be."""

    exit_status = 3


class OutputError(FloorPlanError):
    """A result cannot be written (no space, no permission)."""

    exit_status = 3


class NoPlanError(FloorPlanError):
    """The input was read, but no floor plan can be made of it."""

    exit_status = 4


class Cancelled(FloorPlanError):
    """The work was cancelled by the user; nothing was written."""

    exit_status = 130


def let_interrupt_through(error: BaseException) -> None:
    """Raise the Ctrl-C that ``error`` was made of, if any.

    Compiled code, and Python itself where it imports compiled modules, make errors of their own of one that
    comes while they run; who takes these for a failure of somebody else would go on.
    """
    seen: set[int] = set()
    cause: BaseException | None = error
    while cause is not None and id(cause) not in seen:
        if isinstance(cause, KeyboardInterrupt):
            raise cause
        seen.add(id(cause))
        cause = cause.__cause__ or cause.__context__
