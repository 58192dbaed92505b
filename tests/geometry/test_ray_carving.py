"""Rays through voxels: the compiled walk against one written in plain Python."""

from __future__ import annotations

import math
from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from floorplan_core.geometry import ray_carving
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.geometry.ray_steps import MOST, ONE, SHIFT
from floorplan_core.geometry.voxel_keys import BIAS, EMPTY

SIZE = 0.1
LIMITS = (0.05, 30.0)
LEVELS = 40


def _walk(origin: np.ndarray, point: np.ndarray) -> list[tuple[int, int, int]]:
    """Voxels of one ray, one step of a voxel along its longest axis at a time, in the same fixed point."""
    o, p = origin * (1 / SIZE), point * (1 / SIZE)
    longest = max(*np.abs(p - o), 1e-9)
    at = [math.floor(v * ONE) for v in o]
    step = [int((b - a) / longest * ONE) for a, b in zip(o, p, strict=True)]
    end = tuple(math.floor(v) for v in p)
    out = []
    for _ in range(int(longest) + 1):
        voxel = tuple(v >> SHIFT for v in at)
        if voxel == end:
            break
        out.append(voxel)
        at = [a + s for a, s in zip(at, step, strict=True)]
    return out


def _bits(
    misses: MissMap, least: int = 1, low=(-6.0, -6.0), shape=(120, 120), z0: float = -2.0
) -> np.ndarray:
    return misses.column_bits(np.eye(3), np.array(low), SIZE, shape, z0, LEVELS, (least, least))[0]


def _counted(bits: np.ndarray, low=(-60, -60, -20)) -> set[tuple[int, int, int]]:
    levels = (bits[..., None] >> np.arange(LEVELS, dtype=np.uint64)) & np.uint64(1)
    iy, ix, k = np.nonzero(levels)
    return set(zip((ix + low[0]).tolist(), (iy + low[1]).tolist(), (k + low[2]).tolist(), strict=True))


def _carved(origins: np.ndarray, points: np.ndarray, pieces: int = 1) -> MissMap:
    misses = MissMap(SIZE)
    scan = np.arange(len(points), dtype=np.int32)
    for part, ids in zip(np.array_split(points, pieces), np.array_split(scan, pieces), strict=True):
        misses.carve(part, ids, origins, LIMITS)
    return misses


@settings(max_examples=40)
@given(seed=st.integers(0, 2**16))
def test_counts_equal_those_of_a_plain_walk(seed):
    rng = np.random.default_rng(seed)
    ends = rng.uniform([-5, -5, -1.9], [5, 5, 1.9], (2, 40, 3))
    expected = Counter(v for o, p in zip(*ends, strict=True) for v in _walk(o, p))
    misses = _carved(*ends, pieces=3)
    for least in (1, 2, 3):
        assert _counted(_bits(misses, least)) == {v for v, n in expected.items() if n >= least}


def test_no_ray_reaches_its_point_or_passes_it():
    rng = np.random.default_rng(4)
    for _ in range(60):
        point = rng.uniform([-5, -5, -1.9], [5, 5, 1.9])
        inside = _counted(_bits(_carved(np.zeros((1, 3)), point[None])))
        assert tuple(np.floor(point / SIZE).astype(int)) not in inside
        reach = np.linalg.norm(point) + SIZE * math.sqrt(3)
        assert all(np.linalg.norm((np.array(v) + 0.5) * SIZE) <= reach for v in inside)


def test_a_ray_is_a_line_without_holes():
    ray = sorted(_counted(_bits(_carved(np.zeros((1, 3)) + 0.05, np.array([[4.02, 1.3, 0.9]])))))
    assert len(ray) == 40  # 39.7 voxels along x, the one of the point left out
    assert [v[0] for v in ray] == list(range(40))
    assert all(max(abs(a - b) for a, b in zip(v, w, strict=True)) == 1 for v, w in pairwise(ray))


def test_growth_and_chunks_do_not_change_the_counts():
    rng = np.random.default_rng(5)
    origins = rng.uniform(-5, 5, (400, 3)) * [1, 1, 0.3]
    points = origins + rng.uniform(-14, 14, (400, 3))  # far enough to enter hundreds of blocks
    whole, parts = _carved(origins, points), _carved(origins, points, 50)
    assert whole.blocks == parts.blocks > 256  # more than the map starts with
    for least in (1, 2):
        assert np.array_equal(_bits(whole, least), _bits(parts, least))
    expected = {v for o, p in zip(origins, points, strict=True) for v in _walk(o, p)}
    inside = {v for v in expected if all(-60 <= c < 60 for c in v[:2]) and -20 <= v[2] < 20}
    assert _counted(_bits(whole)) == inside


@pytest.mark.parametrize("apart", [0.001, 0.01, 0.1])
def test_neighbouring_rays_of_one_place_count_as_each_would_alone(apart):
    rng = np.random.default_rng(8)
    turn = np.arange(900) * apart
    reach = 4 + np.repeat(rng.uniform(-2, 2, 30), 30)  # edges at which a ray ends far behind the one before
    points = np.stack([np.cos(turn), np.sin(turn), 0.3 * np.sin(9 * turn)], 1) * reach[:, None]
    points[::97] = np.nan
    place, misses = np.array([[0.02, -0.03, 0.04]]), MissMap(SIZE)
    misses.carve(points, np.zeros(900, dtype=np.int32), place, LIMITS)
    passed = Counter(v for p in points[np.isfinite(points[:, 0])] for v in _walk(place[0], p))
    for least in (1, 2, 5, 40, MOST):
        assert _counted(_bits(misses, least)) == {v for v, rays in passed.items() if rays >= least}


def test_what_has_no_sensor_or_no_range_casts_no_ray():
    points = np.array([[1, 0, 0], [np.nan, 0, 0], [0, 0, 0.01], [500, 0, 0], [np.inf, 0, 0]], dtype=float)
    misses = MissMap(SIZE)
    misses.carve(points[:1], np.array([-1], dtype=np.int32), np.zeros((0, 3)), LIMITS)
    misses.carve(points[1:], np.zeros(4, dtype=np.int32), np.zeros((1, 3)), LIMITS)
    assert misses.blocks == 0


def test_counts_saturate():
    misses = MissMap(SIZE)
    points = np.tile([[0.35, 0.05, 0.05]], (700, 1))
    misses.carve(points, np.zeros(700, dtype=np.int32), np.full((1, 3), 0.05), LIMITS)
    assert _counted(_bits(misses, MOST)) == {(0, 0, 0), (1, 0, 0), (2, 0, 0)}


@pytest.mark.parametrize("degrees", [0, 17, 45, 90, 200])
def test_columns_in_a_turned_grid_see_the_same_space(degrees):
    rng = np.random.default_rng(6)
    origins = np.zeros((3000, 3))
    points = rng.uniform(-1, 1, (3000, 3))
    points *= 4 / np.linalg.norm(points, axis=1, keepdims=True) * [1, 1, 0.4]
    misses = _carved(origins, points)
    angle = math.radians(degrees)
    rotation = np.array(
        [[math.cos(angle), math.sin(angle), 0], [-math.sin(angle), math.cos(angle), 0], [0, 0, 1]]
    )
    turned = misses.column_bits(rotation, np.array([-6.0, -6.0]), SIZE, (120, 120), -2.0, LEVELS, (1, 1))[0]
    iy, ix = np.mgrid[0:120, 0:120]
    straight = _counted(_bits(misses))
    for k in range(0, LEVELS, 13):
        centre = np.stack([ix, iy, np.full_like(ix, k)], -1) + 0.5
        local = (centre.reshape(-1, 3) * SIZE + [-6.0, -6.0, -2.0]) @ rotation  # grid to local
        voxels = map(tuple, np.floor(local / SIZE + 1e-12).astype(int).tolist())
        expected = np.array([v in straight for v in voxels]).reshape(120, 120)
        assert np.mean(expected != ((turned >> np.uint64(k)) & np.uint64(1)).astype(bool)) < 0.002


def test_marked_voxels_are_free_without_rays():
    rng = np.random.default_rng(8)
    points = rng.uniform(-20, 20, (5000, 3))
    misses = MissMap(SIZE)
    misses.mark(np.vstack([points, [[np.nan, 0, 0], [1e9, 0, 0]]]), 3)
    keys = np.unique(np.floor(points / SIZE).astype(int), axis=0)
    held = misses._pool[: misses.blocks]
    assert np.count_nonzero(held) == len(keys)
    assert held.sum() == 3 * len(points)


def _counts(misses: MissMap) -> dict[int, bytes]:
    """The counts of every block by its key."""
    used = np.flatnonzero(misses._keys != EMPTY)
    return {int(misses._keys[s]): misses._pool[misses._ids[s]].tobytes() for s in used}


def test_two_maps_taken_together_are_the_map_of_all_rays():
    rng = np.random.default_rng(5)
    origins, points = rng.uniform(-20, 20, (2, 3000, 3))
    whole, first, second = (_carved(origins[part], points[part]) for part in np.s_[:, ::3, 1::3])
    first.take(second)
    first.take(_carved(origins[2::3], points[2::3]))
    assert _counts(first) == _counts(whole)
    assert second.blocks == 0 and not second._pool.any()
    second.take(whole)  # a map that was emptied can be used again
    assert _counts(second) == _counts(first)


def test_counts_of_two_maps_saturate():
    origins, points = np.zeros((MOST - 50, 3)), np.tile([[2.0, 0.0, 0.0]], (MOST - 50, 1))
    misses = _carved(origins, points)
    misses.take(_carved(origins, points))
    assert misses._pool.max() == MOST


@pytest.mark.parametrize("bits", [1, 11, 20])
def test_what_lies_beyond_the_window_is_counted_alike(monkeypatch, bits):
    """Rays here, rays a kilometre off, and rays five kilometres off, some of them before the window grows."""
    rng = np.random.default_rng(9)
    origins = np.repeat([[0.0, 0, 0], [900, -700, 20], [0, 0, 0], [-5000, 10, 0]], 50, axis=0)
    points = origins + rng.uniform(-20, 20, (200, 3)) * [1, 1, 0.2]
    monkeypatch.setattr(ray_carving, "_WINDOW_BITS", bits)
    misses = _carved(origins, points, pieces=7)
    held = {}
    for key, counts in _counts(misses).items():
        corner = np.array([key >> 42, key >> 21 & (1 << 21) - 1, key & (1 << 21) - 1]) - BIAS
        for at, n in enumerate(counts):
            if n:
                held[tuple(16 * corner + [at >> 8, at >> 4 & 15, at & 15])] = n
    assert held == Counter(v for o, p in zip(origins, points, strict=True) for v in _walk(o, p))


def test_a_ray_longer_than_what_is_kept_at_a_time():
    misses = MissMap(0.02)
    misses.carve(np.array([[24.99, 0.01, 0.01]]), np.zeros(1, dtype=np.int32), np.full((1, 3), 0.01), LIMITS)
    assert misses._pool.sum() == np.count_nonzero(misses._pool) == 1249  # the voxel of the point left out


def test_tilted_columns_are_those_of_every_level_by_itself():
    rng = np.random.default_rng(11)
    points = rng.uniform([-4, -4, -1.5], [4, 4, 1.5], (3000, 3))
    misses = _carved(np.zeros((3000, 3)), points)
    tilt = np.array([[1.0, 0, 0.05], [0, 1, -0.11], [-0.05, 0.11, 1]])
    rotation = np.linalg.qr(tilt)[0] * np.sign(np.diag(np.linalg.qr(tilt)[1]))
    low, z0 = np.array([-3.0, -3.0]), -1.5
    whole = misses.column_bits(rotation, low, SIZE, (60, 60), z0, 30, (1, 4))
    for k in range(30):
        alone = misses.column_bits(rotation, low, SIZE, (60, 60), z0 + k * SIZE, 1, (1, 4))
        for columns, level in zip(whole, alone, strict=True):
            differing = ((columns >> np.uint64(k)) & np.uint64(1)) != level
            assert differing.mean() < 0.001  # z0 + k * cell is rounded once more
