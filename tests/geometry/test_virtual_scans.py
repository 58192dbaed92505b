"""Rays in a small voxel map."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.geometry.virtual_scans import directions, seen_free

RAYS = directions(720, 21, 0.6)
WALL = np.uint64((1 << 30) - 1)


def boxed(n: int = 41) -> np.ndarray:
    """A room of walls 30 voxels high, without floor or ceiling."""
    columns = np.zeros((n, n), dtype=np.uint64)
    columns[[0, -1], :] = columns[:, [0, -1]] = WALL
    return columns


def free_at(bits: np.ndarray, level: int) -> np.ndarray:
    return (bits >> np.uint64(level)) & np.uint64(1) > 0


def middle(*xy: float) -> np.ndarray:
    return np.array([[*xy, 12.5]])


def test_directions_are_unit_vectors_all_around() -> None:
    assert np.linalg.norm(RAYS, axis=1) == pytest.approx(1.0)
    assert RAYS.sum(axis=0) == pytest.approx(0.0, abs=1e-6)
    assert np.arcsin(RAYS[:, 2]).max() == pytest.approx(0.6)


def test_a_room_is_free_to_its_walls_and_no_farther() -> None:
    room = boxed()
    seen = seen_free(room, middle(20.5, 20.5), RAYS, 100, 4)
    assert free_at(seen, 12)[1:-1, 1:-1].all()
    assert not free_at(seen, 12)[[0, -1], :].any()


def test_behind_a_pillar_nothing_is_known() -> None:
    room = boxed()
    room[18:23, 28:30] = WALL
    seen = free_at(seen_free(room, middle(20.5, 20.5), RAYS, 100, 4), 12)
    assert not seen[20, 30:40].any()
    assert seen[20, 21:28].all()


def test_a_ray_that_meets_nothing_tells_nothing() -> None:
    room = boxed()
    room[:, -1] = 0
    seen = free_at(seen_free(room, middle(20.5, 20.5), RAYS, 100, 4), 12)
    assert not seen[20, 30:].any()
    assert seen[20, 1:20].all()


def test_surfaces_out_of_reach_or_too_near_tell_nothing() -> None:
    room = boxed()
    assert not seen_free(room, middle(20.5, 20.5), RAYS, 10, 4).any()
    assert not seen_free(room, middle(20.5, 20.5), RAYS, 100, 60).any()
