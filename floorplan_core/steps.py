"""Running the steps of a plan: progress, wall time, cancellation, and what need not be done again.

A step says what it is made of. Where an earlier run made it of the very same things, its result is taken
from the memory: a changed setting or correction reruns only what depends on it. Results are remembered step
by step, so a run that was cancelled half way is half done the next time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar, cast

from floorplan_core.config import Section
from floorplan_core.kernel_times import stopwatch
from floorplan_core.model.corrections import Correction
from floorplan_core.observer import Observer

T = TypeVar("T")

_BY_VALUE = (
    str,
    int,
    float,
    bool,
    Section,
    Correction,
)  # all else is the same only where it is the same object


class StepMemory:
    """The result of every step and what it was made of, from one plan of a survey to the next."""

    def __init__(self) -> None:
        self._kept: dict[str, tuple[tuple[object, ...], object]] = {}
        self._parts: dict[str, StepMemory] = {}

    def part(self, name: str) -> StepMemory:
        """The memory of a part of the building that is laid out by itself."""
        return self._parts.setdefault(name, StepMemory())

    def find(self, step: str, made_of: tuple[object, ...]) -> tuple[object] | None:
        """The result of ``step`` in a tuple; None where it was not made of these things."""
        known = self._kept.get(step)
        return (known[1],) if known is not None and _same(known[0], made_of) else None

    def keep(self, step: str, made_of: tuple[object, ...], result: object) -> None:
        """Remember a result; an earlier one of ``step`` is forgotten."""
        self._kept[step] = (made_of, result)


def _same(a: object, b: object) -> bool:
    if a is b:
        return True
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(_same, a, b))
    return type(a) is type(b) and isinstance(a, _BY_VALUE) and bool(a == b)


class StageRunner:
    """Runs step after step of one plan; ``seconds`` holds the wall time of each stage, kernels loaded."""

    def __init__(
        self,
        observer: Observer,
        given: Sequence[object] = (),
        seconds: dict[str, float] | None = None,
        memory: StepMemory | None = None,
    ) -> None:
        self.seconds = dict(seconds or {})
        self._observer = observer
        self._given = iter(given)
        self._memory = memory
        self._count: dict[str, int] = {}

    def part(self, name: str, observer: Observer) -> StageRunner:
        """The runner of a part that is laid out by itself: it remembers its own steps."""
        return StageRunner(observer, memory=None if self._memory is None else self._memory.part(name))

    def __call__(self, name: str, work: Callable[[], T], *made_of: object) -> T:
        """The result of ``work``, the next step of stage ``name``: given, remembered, or made now."""
        self._observer.check_cancelled()
        if (known := next(self._given, None)) is not None:
            return cast(T, known)
        self._count[name] = self._count.get(name, 0) + 1
        return self._remembered(f"{name} {self._count[name]}", lambda: self._timed(name, work), made_of)

    def correct(self, name: str, work: Callable[[], T], *made_of: object) -> T:
        """What a person makes of the machine's result: remembered, but no stage's step, and never given."""
        self._observer.check_cancelled()
        return self._remembered(f"correct {name}", work, made_of)

    def _remembered(self, step: str, work: Callable[[], T], made_of: tuple[object, ...]) -> T:
        if self._memory is None:
            return work()
        if (found := self._memory.find(step, made_of)) is not None:
            return cast(T, found[0])
        result = work()
        self._memory.keep(step, made_of, result)
        return result

    def _timed(self, name: str, work: Callable[[], T]) -> T:
        self._observer.stage_started(name)
        seconds = stopwatch()
        result = work()
        took = seconds()
        self.seconds[name] = self.seconds.get(name, 0.0) + took
        self._observer.stage_finished(name, took, result)
        return result
