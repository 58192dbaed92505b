"""Models of buildings are closed volumes: below a window stands wall, and nobody walks through it."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from floorplan_core.pipeline import process
from tests.box_world import Box, slabs, wall
from tests.plugins.plugin_files import opened

WIDTH, DEPTH, THICK = 8.1, 5.0, 0.3
WINDOWS = {  # of the walls to the south and north: along the wall, metres
    "south": [(1.0, 2.5), (5.5, 6.7)],
    "north": [(1.0, 2.5), (5.5, 6.7)],
}


def with_windows(near: float, far: float, windows, sill: float, top: float) -> list[Box]:
    """A wall across y with openings that begin above the floor."""
    below = [(a, near, 0.0, b, far, sill) for a, b in windows]
    return [*wall(1, near, far, -THICK, WIDTH + THICK, *((a, b, top) for a, b in windows)), *below]


def building(sill: float, top: float) -> trimesh.Trimesh:
    """Two rooms with a door between them and windows on two sides."""
    boxes = [
        *slabs(-THICK, -THICK, WIDTH + THICK, DEPTH + THICK),
        *wall(0, -THICK, 0.0, 0.0, DEPTH),
        *wall(0, WIDTH, WIDTH + THICK, 0.0, DEPTH),
        *wall(0, 4.0, 4.1, 0.0, DEPTH, (2.0, 2.9, 2.1)),
        *with_windows(-THICK, 0.0, WINDOWS["south"], sill, top),
        *with_windows(DEPTH, DEPTH + THICK, WINDOWS["north"], sill, top),
    ]
    made = []
    for box in boxes:
        low, high = np.array(box[:3]), np.array(box[3:])
        one = trimesh.creation.box(high - low)
        one.apply_translation((low + high) / 2)
        made.append(one)
    return trimesh.util.concatenate(made)


@pytest.mark.parametrize(("sill", "top"), [(0.9, 2.1), (1.0, 2.2)])
def test_windows_of_a_model_are_no_doors(tmp_path, sill, top):
    path = tmp_path / "house.ply"
    building(sill, top).export(path)
    plan = process(opened(path))
    assert [round(region.area) for region in plan.regions] == [20, 20]
    (door,) = plan.doors
    assert door.width == pytest.approx(0.9, abs=0.05)
