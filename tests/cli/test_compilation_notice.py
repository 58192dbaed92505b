"""Whoever waits for a compiler is told so, once, and nobody else is."""

from __future__ import annotations

from collections.abc import Iterator

import numba
import pytest

from floorplan_core.kernel_cache import on_first_compilation


@pytest.fixture
def told() -> Iterator[list[str]]:
    yield []
    on_first_compilation(lambda: None)


def test_compilation_is_told_once(told: list[str]) -> None:
    on_first_compilation(lambda: told.append("compiling"))
    double = numba.njit(lambda x: x * 2)
    assert double(1) == 2
    assert told == ["compiling"]
    assert double(1.5) == 3.0
    assert told == ["compiling"]


def test_only_who_asked_last_is_told(told: list[str]) -> None:
    on_first_compilation(lambda: told.append("first"))
    on_first_compilation(lambda: told.append("second"))
    assert numba.njit(lambda x: x * 4)(1) == 4
    assert told == ["second"]


def test_calls_of_what_is_compiled_tell_nothing(told: list[str]) -> None:
    triple = numba.njit(lambda x: x * 3)
    assert triple(1) == 3
    on_first_compilation(lambda: told.append("compiling"))
    assert triple(2) == 6
    assert told == []
    triple(2.5)
    assert told == ["compiling"]
