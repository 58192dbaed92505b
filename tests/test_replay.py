"""A run is cut into intervals of run time; every point comes in exactly one of them, in scan order."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.errors import InputError
from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.replay import intervals, path_lengths


def trajectory(stamps: list[float]) -> Trajectory:
    poses = np.tile(np.eye(4), (len(stamps), 1, 1))
    poses[:, 0, 3] = np.arange(len(stamps))  # one metre a scan
    return Trajectory(np.array(stamps, dtype=np.float64), poses)


def survey(scan_id: list[int], stamps: list[float], cuts: list[int] | None = None) -> Reconstruction:
    ids = np.array(scan_id, dtype=np.int32)
    points = np.column_stack([np.arange(len(ids)), ids, ids]).astype(np.float32)
    parts = np.split(np.arange(len(ids)), sorted(cuts or []))
    chunks = [PointChunk(points[p], ids[p], ids[p].astype(np.float64)) for p in parts]
    ordered = bool(np.all(np.diff(ids) >= 0))
    return Reconstruction(
        "run.ply", lambda: iter(chunks), len(ids), trajectory(stamps), scans_ordered=ordered
    )


def replayed(run: Reconstruction, every: float) -> list[tuple[float, float, list[int]]]:
    """(end, path length, scan ids) of each interval."""
    return [
        (i.end, i.path_length, [int(s) for chunk in i.chunks for s in chunk.scan_id])  # type: ignore[union-attr]
        for i in intervals(run, every)
    ]


def test_intervals_end_on_the_clock_and_the_last_one_with_the_run() -> None:
    run = survey([0, 0, 1, 2, 3, 3, 4], [100, 104, 110, 119, 123], cuts=[3, 5])
    assert replayed(run, 10) == [(10, 2, [0, 0, 1, 2]), (20, 3, [3, 3]), (23, 4, [4])]


def test_intervals_without_points_are_left_out() -> None:
    assert replayed(survey([0, 2], [0, 50, 99]), 10) == [(10, 0, [0]), (99, 2, [2])]
    assert replayed(survey([0, 1], [0, 30]), 10) == [(10, 0, [0]), (30, 1, [1])]


def test_a_file_in_another_order_is_sorted() -> None:
    run = survey([2, 0, 1, 0], [0, 11, 21], cuts=[1])
    assert replayed(run, 10) == [(10, 0, [0, 0]), (20, 1, [1]), (21, 2, [2])]


def test_a_survey_that_does_not_say_when_is_refused() -> None:
    run = survey([0, 1], [0, 1])
    without_path = Reconstruction("cloud.ply", run.chunks)
    with pytest.raises(InputError, match=r"cloud\.ply has no trajectory"):
        next(intervals(without_path, 1))
    bare = Reconstruction(
        "cloud.ply", lambda: iter([PointChunk(np.zeros((3, 3)))]), trajectory=run.trajectory
    )
    with pytest.raises(InputError, match="carry no scan_id"):
        next(intervals(bare, 1))
    assert list(intervals(Reconstruction("x", lambda: iter(()), trajectory=run.trajectory), 1)) == []


@given(
    st.lists(st.integers(0, 9), max_size=40),
    st.lists(st.integers(0, 40), max_size=4),
    st.lists(st.floats(0, 5), min_size=10, max_size=10),
    st.floats(0.1, 20),
)
def test_every_point_comes_once_and_in_order(ids, cuts, gaps, every) -> None:
    stamps = np.cumsum(gaps).tolist()
    got = replayed(survey(ids, stamps, [c for c in cuts if c <= len(ids)]), every)
    assert [s for _, _, part in got for s in part] == sorted(ids)
    ends = [end for end, _, _ in got]
    assert ends == sorted(ends)
    for end, length, part in got:
        assert all(stamps[s] - stamps[0] <= end + 1e-9 for s in part)
        assert length >= max(part)


def test_path_length() -> None:
    assert path_lengths(trajectory([0, 1, 2])).tolist() == [0, 1, 2]
