"""Which trajectory lies beside a cloud."""

from __future__ import annotations

import re
from pathlib import Path

from floorplan_core.readers.trajectory import looks_like_trajectory

SUFFIXES = (".tum", ".txt", ".csv")


def find_trajectory(cloud: Path) -> Path | None:
    """The trajectory beside a cloud: of its own stem, trajectory3d for points3d, or the plain one."""
    stems = [cloud.stem]
    kind = re.match(r"points(\w*?)(_.*)?$", cloud.stem)
    if kind and kind.group(1):
        stems.append(f"trajectory{kind.group(1)}")
    stems.append("trajectory")
    for stem in stems:
        for suffix in SUFFIXES:
            beside = cloud.parent / (stem + suffix)
            if beside != cloud and beside.is_file() and (suffix == ".tum" or looks_like_trajectory(beside)):
                return beside
    return None
