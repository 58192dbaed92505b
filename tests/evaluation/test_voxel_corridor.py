"""A corridor drawn in voxels: its length and widths are read off as with a laser meter."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.evaluation.voxel_corridor import corridor_dimensions, corridor_sight
from floorplan_core.evaluation.voxel_truth import measured_corridor

CELL = 0.1
ORIGIN = np.array([-2.0, 5.0])


def drawn() -> tuple[np.ndarray, np.ndarray]:
    """Free and standing cells: 20.1 m between the end walls' middles, 2.1 m between the sides'."""
    free, standing = np.zeros((40, 220), dtype=bool), np.zeros((40, 220), dtype=bool)
    free[10:30, 5:205] = True
    standing[9:31, [4, 205]] = True
    standing[[9, 30], 4:206] = True
    return free, standing


def test_length_and_widths() -> None:
    length, *widths = corridor_dimensions(*drawn(), ORIGIN, CELL)
    assert length.metres == pytest.approx(20.1)
    assert length.start == pytest.approx((-1.55, 6.95)) and length.end == pytest.approx((18.55, 6.95))
    assert len(widths) == 20
    assert all(w.metres == pytest.approx(2.1) for w in widths)
    assert widths[0].start == pytest.approx((-0.55, 5.95)) and widths[0].end == pytest.approx((-0.55, 8.05))


def test_a_door_in_the_end_wall_makes_the_corridor_no_longer() -> None:
    free, standing = drawn()
    standing[20:28, 205] = False
    free[20:28, 205:218] = True
    standing[20:28, 218] = True
    length, *_ = corridor_dimensions(free, standing, ORIGIN, CELL)
    assert length.metres == pytest.approx(20.1)


def test_a_corridor_along_the_other_axis() -> None:
    free, standing = drawn()
    along_x, along_y = (
        corridor_dimensions(f, s, o, CELL)
        for f, s, o in ((free, standing, ORIGIN), (free.T, standing.T, ORIGIN[::-1]))
    )
    assert [d.id for d in along_y] == [d.id for d in along_x]
    for a, b in zip(along_x, along_y, strict=True):
        assert b.start == pytest.approx(a.start[::-1]) and b.end == pytest.approx(a.end[::-1])


def test_doors_and_furniture_give_no_width() -> None:
    free, standing = drawn()
    standing[9, 50:60] = False  # an open door: the next surface is 0.9 m farther
    free[1:10, 50:60] = True
    standing[0, 50:60] = True
    standing[10:18, 100:108] = True  # a cabinet
    free[10:18, 100:108] = False
    widths = [d for d in corridor_dimensions(free, standing, ORIGIN, CELL) if "width" in d.id]
    assert len(widths) == 18
    assert {round(w.metres, 6) for w in widths} == {2.1}


def test_what_is_short_or_wide_is_no_corridor() -> None:
    free, standing = drawn()
    assert corridor_dimensions(free[:, 120:], standing[:, 120:], ORIGIN, CELL) == ()
    hall, walls = np.zeros((120, 120), dtype=bool), np.ones((120, 120), dtype=bool)
    hall[1:-1, 1:-1], walls[1:-1, 1:-1] = True, False
    assert corridor_sight(hall, walls) == (59, 0, 119)
    assert corridor_dimensions(hall, walls, ORIGIN, CELL) == ()


def test_what_was_not_seen_ends_a_line_of_sight() -> None:
    free, standing = drawn()
    free[:, 150] = False
    assert corridor_sight(free, standing) == (0, 0, 0)


def test_only_what_stands_at_the_height_of_a_body_is_wall() -> None:
    """A duct that hangs beside the wall above it does not make the corridor narrower."""
    heights = np.arange(0.05, 2.5, CELL)
    free, standing = drawn()
    duct = np.zeros_like(standing)
    duct[10, 5:205] = True

    def voxels(cells: np.ndarray, z: np.ndarray) -> np.ndarray:
        rows, columns = np.nonzero(cells)
        xy = ORIGIN + CELL * (np.column_stack([columns, rows]) + 0.5)
        return np.column_stack([np.repeat(xy, len(z), axis=0), np.tile(z, len(xy))])

    wall = np.concatenate([voxels(standing, heights), voxels(duct, heights[heights > 1.9])])
    length, *widths = measured_corridor(voxels(free, heights[heights < 1.9]), wall, CELL)
    assert length.metres == pytest.approx(20.1)
    assert {round(w.metres, 6) for w in widths} == {2.1}
