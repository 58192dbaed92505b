"""Two threads: halves of a range, and work that is begun before its result is needed."""

from __future__ import annotations

import threading

import pytest

from floorplan_core.geometry.halves import begin, in_halves


@pytest.mark.parametrize(("count", "parts"), [(0, 1), (9, 1), (10, 2), (11, 2)])
def test_the_halves_are_the_whole(count, parts):
    done: list[tuple[int, int]] = []
    in_halves(lambda a, b: done.append((a, b)), count, worth=10)
    assert len(done) == parts
    assert sorted(i for a, b in done for i in range(a, b)) == list(range(count))


def test_begun_work_runs_meanwhile_and_gives_its_result():
    reached = threading.Event()
    result = begin(lambda: reached.wait(30) and 42)
    reached.set()  # were it not in a thread of its own, nobody would come here
    assert result() == 42


def test_what_begun_work_raises_comes_with_its_result():
    result = begin(lambda: [][0])
    with pytest.raises(IndexError):
        result()
