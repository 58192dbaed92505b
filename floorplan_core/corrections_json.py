"""Corrections as plain JSON values and back: ``{"correction": "MovePlane", "plane": {...}, "to": [x, y]}``.

Reading trusts nothing: a value that does not fit the declared field is refused with one sentence.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from functools import lru_cache
from typing import Any, get_args, get_type_hints

from floorplan_core.errors import InputError
from floorplan_core.model import corrections as kinds
from floorplan_core.model.corrections import Correction, PlaneAt, Point

FARTHEST = 1e8  # m: no coordinate system of the earth goes farther
LONGEST = 500  # characters of a label or a name
MOST_POINTS = 10_000  # of one correction

Json = dict[str, Any]


def to_json(corrections: Sequence[Correction]) -> list[Json]:
    """Plain values, in the order in which the corrections were made."""
    return [{"correction": type(c).__name__, **_plain(c)} for c in corrections]


def from_json(data: Any) -> tuple[Correction, ...]:
    """The corrections in parsed JSON; :class:`InputError` names the first that is wrong."""
    if not isinstance(data, list):
        raise InputError("The corrections are not a list.")
    return tuple(_correction(entry, k) for k, entry in enumerate(data, start=1))


def point(data: Any) -> Point:
    """A place in metres; ValueError for anything else."""
    if not isinstance(data, list | tuple) or len(data) != 2:
        raise ValueError("a place is two numbers")
    return number(data[0]), number(data[1])


def number(data: Any) -> float:
    """A finite number of metres; ValueError for anything else."""
    if isinstance(data, bool) or not isinstance(data, int | float):
        raise ValueError(f"{data!r} is not a number")
    if not math.isfinite(data) or abs(data) > FARTHEST:
        raise ValueError(f"{data} m is out of bounds")
    return float(data)


def text(data: Any) -> str:
    """A word or two; ValueError for anything else."""
    if not isinstance(data, str) or len(data) > LONGEST:
        raise ValueError("a text is missing or too long")
    return data


def _plain(value: Any) -> Json:
    return {f.name: _plain_value(getattr(value, f.name)) for f in fields(value)}


def _plain_value(value: Any) -> Any:
    if is_dataclass(value):
        return _plain(value)
    return [_plain_value(v) for v in value] if isinstance(value, tuple) else value


@lru_cache(maxsize=1)
def _kinds() -> dict[str, Any]:
    return {kind.__name__: kind for kind in get_args(Correction)}


@lru_cache(maxsize=64)
def _hints(kind: Any) -> dict[str, Any]:
    return get_type_hints(kind, vars(kinds))


def _correction(entry: Any, number_: int) -> Correction:
    name = entry.get("correction") if isinstance(entry, dict) else None
    kind = _kinds().get(name) if isinstance(name, str) else None
    if kind is None:
        raise InputError(f"Correction {number_} is of an unknown kind ({str(name)[:40]!r}).")
    try:
        made: Correction = _made(kind, {k: v for k, v in entry.items() if k != "correction"})
    except (ValueError, TypeError, KeyError) as error:
        raise InputError(f"Correction {number_} ({name}) is damaged: {str(error)[:120]}.") from error
    return made


def _made(kind: Any, data: Any) -> Any:
    if not isinstance(data, dict) or not set(data) <= set(_hints(kind)):
        raise ValueError("it has other fields than it should")
    return kind(**{name: _value(_hints(kind)[name], value) for name, value in data.items()})


def _value(hint: Any, data: Any) -> Any:
    if hint is float:
        return number(data)
    if hint is str:
        return text(data)
    if hint is PlaneAt:
        return _made(PlaneAt, data)
    if hint == Point:
        return point(data)
    if not isinstance(data, list) or len(data) > MOST_POINTS:
        raise ValueError("its list of places is damaged")
    return tuple(point(p) for p in data)
