"""How much memory there is, and one clear sentence before the system would end the program for want of it."""

from __future__ import annotations

from pathlib import Path

from floorplan_core.errors import NoPlanError

_MEMINFO = Path("/proc/meminfo")
_GROUPS = Path("/proc/self/cgroup")
_TREE = Path("/sys/fs/cgroup")
_LIMITS = (  # controller, its files for the limit of memory and for what is used of it
    ("", "memory.max", "memory.current"),  # version 2 of control groups
    ("memory", "memory.limit_in_bytes", "memory.usage_in_bytes"),  # version 1
)
_RESERVE = 64e6  # bytes that are left to others


def free_memory() -> float | None:
    """Bytes that this process may still take before the system ends it; None where it does not say.

    The memory that is available, or what the limits of its control groups (containers) leave of it.
    """
    try:
        lines = dict(line.split(":", 1) for line in _MEMINFO.read_text().splitlines() if ":" in line)
        free = float(lines["MemAvailable"].split()[0]) * 1024
    except (OSError, KeyError, ValueError):
        return None
    return min([free, *_left_by_groups()])


def fits(needed: float) -> bool:
    """True where so many more bytes are free, or the system does not say."""
    free = free_memory()
    return free is None or needed <= max(0.0, free - _RESERVE)


def require_memory(needed: float, what: str) -> None:
    """Raise :class:`NoPlanError` where ``needed`` more bytes are not free; ``what`` takes them."""
    if not fits(needed):
        free = free_memory() or 0.0
        raise NoPlanError(
            f"{what} takes about {needed / 1e6:,.0f} MB more memory, and {free / 1e6:,.0f} MB are free; "
            "enlarge voxels.size (twice the size takes a quarter), crop the survey, or end other programs."
        )


def _left_by_groups() -> list[float]:
    """What each limit on this process, or on a group above its own, leaves."""
    left = []
    for controller, limit, usage in _LIMITS:
        root = _TREE / controller
        for place in {root / group for group in _groups(controller)}:
            while place.is_relative_to(root):
                left += _left(place, limit, usage)
                place = place.parent
    return left


def _left(group: Path, limit: str, usage: str) -> list[float]:
    """The limit less what is used; files that the system can drop count as free. [] where there is none."""
    try:
        most, used = float((group / limit).read_text()), float((group / usage).read_text())
        pairs = [line.split() for line in (group / "memory.stat").read_text().splitlines()]
    except (OSError, ValueError):  # no such group, or "max"
        return []
    stat = {pair[0]: float(pair[1]) for pair in pairs if len(pair) == 2}
    kept = sum(stat.get(f"total_{name}", stat.get(name, 0.0)) for name in ("active_file", "inactive_file"))
    return [max(0.0, most - used + min(kept, used))]


def _groups(controller: str) -> list[str]:
    """This process's group of one controller; and the root, which is its own where it runs in a container."""
    groups = [""]
    try:
        for line in _GROUPS.read_text().splitlines():
            _, controllers, path = line.split(":", 2)
            if controller in controllers.split(","):
                groups.append(path.strip("/"))
    except (OSError, ValueError):
        pass
    return groups
