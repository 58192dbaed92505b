"""Is a program still running? Files that a killed one left behind may be taken over."""

from __future__ import annotations

import os

_QUERY = 0x1000  # PROCESS_QUERY_LIMITED_INFORMATION of Windows


def is_running(pid: int) -> bool:
    """True where a process of this number is there (it may be another program by now)."""
    if pid <= 0:
        return False
    return _on_windows(pid) if os.name == "nt" else _on_posix(pid)


def _on_posix(pid: int) -> bool:
    try:
        os.kill(pid, 0)  # no signal: only asks
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    return True


def _on_windows(pid: int) -> bool:
    import ctypes

    kernel = getattr(ctypes, "windll").kernel32  # noqa: B009 (there is no such name elsewhere)
    handle = kernel.OpenProcess(_QUERY, False, pid)
    if handle:
        kernel.CloseHandle(handle)
    return bool(handle)
