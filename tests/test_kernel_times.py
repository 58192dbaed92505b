"""What loading kernels takes is told apart from the work, and does not import what no kernel needs."""

import subprocess
import sys

import pytest

from floorplan_core import kernel_times


class _Time:
    """A clock that stands still until it is moved."""

    def __init__(self) -> None:
        self.now = 100.0

    def perf_counter(self) -> float:
        return self.now


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> _Time:
    stopped = _Time()
    monkeypatch.setattr(kernel_times, "time", stopped)
    monkeypatch.setattr(kernel_times, "_clock", kernel_times._Clock())
    return stopped


def test_a_stopwatch_leaves_out_what_kernels_took(time: _Time) -> None:
    seconds = kernel_times.stopwatch()
    time.now += 2.0
    kernel_times._clock.enter()
    time.now += 5.0
    assert seconds() == pytest.approx(2.0)  # while one is being loaded, too
    kernel_times._clock.leave()
    time.now += 1.0
    assert seconds() == pytest.approx(3.0)
    assert kernel_times.kernel_seconds() == pytest.approx(5.0)


def test_threads_that_load_at_the_same_time_count_once(time: _Time) -> None:
    clock = kernel_times._clock
    for entering in (True, True, False, False):
        clock.enter() if entering else clock.leave()
        time.now += 1.0
    assert kernel_times.kernel_seconds() == pytest.approx(3.0)


def test_without_a_clock_a_stopwatch_shows_wall_time(time: _Time, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel_times, "_clock", None)
    seconds = kernel_times.stopwatch()
    time.now += 2.0
    assert (seconds(), kernel_times.kernel_seconds()) == (2.0, 0.0)


def _run(code: str) -> str:
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return run.stdout.strip()


def test_numba_comes_without_linear_algebra_which_stays_usable() -> None:
    code = """
import sys
from floorplan_core.kernel_cache import import_numba
import_numba()
before = "numba.np.arraymath" in sys.modules, "scipy.linalg" in sys.modules
import numba, numpy as np
product = numba.njit(lambda a: np.dot(a, a))(np.full((2, 2), 3.0))
import scipy.linalg
print(*before, product[0, 0], scipy.linalg.det(np.eye(2)))
"""
    assert _run(code) == "True False 18.0 1.0"


def test_kernels_that_load_are_timed() -> None:
    code = """
from floorplan_core.kernel_times import kernel_seconds, time_kernels
time_kernels()
time_kernels()
before = kernel_seconds()
import numba
numba.njit(lambda a: a + 1)(1)
print(before, kernel_seconds() > 0)
"""
    assert _run(code) == "0.0 True"


def test_finding_the_plugins_loads_no_kernels() -> None:
    code = """
import sys
from floorplan_core.plugins import default_registry
registry = default_registry()
print("numba" in sys.modules, len(registry.readers) > 5, registry.failures())
"""
    assert _run(code) == "False True []"
