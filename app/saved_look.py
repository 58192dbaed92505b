"""The look as JSON in a project file, and back; what is not understood is left as it comes. No Qt."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from floorcast_app.view_state import LAYERS, POINT_COLOURS, Look

_NUMBERS = ("span", "azimuth", "elevation")


def look_to_dict(look: Look) -> dict[str, Any]:
    """Plain JSON values."""
    out: dict[str, Any] = {}
    for field in fields(look):
        value = getattr(look, field.name)
        if isinstance(value, frozenset):
            value = sorted([list(v) if isinstance(v, tuple) else v for v in value])
        out[field.name] = list(value) if isinstance(value, tuple) else value
    return out


def look_from_dict(data: dict[str, Any]) -> Look:
    """The look that ``data`` describes; a value of the wrong kind is ignored."""
    values: dict[str, Any] = {}
    for name, read in _READERS.items():
        try:
            values[name] = read(data[name])
        except (KeyError, TypeError, ValueError, AssertionError):
            continue
    return Look(**values)


def _floats(count: int) -> Any:
    def read(value: Any) -> tuple[float, ...]:
        numbers = tuple(float(v) for v in value)
        assert len(numbers) == count
        return numbers

    return read


def _one_of(words: tuple[str, ...]) -> Any:
    def read(value: Any) -> str:
        assert value in words
        return str(value)

    return read


_READERS: dict[str, Any] = {
    "centre": _floats(2),
    **dict.fromkeys(_NUMBERS, float),
    "layers": lambda v: frozenset(str(x) for x in v) & frozenset(LAYERS),
    "facings": lambda v: frozenset(int(x) for x in v) & frozenset(range(4)),
    "hidden": lambda v: frozenset((str(kind), str(id)) for kind, id in v),
    "point_colour": _one_of(POINT_COLOURS),
    "ceiling_cut": lambda v: None if v is None else float(v),
    "section": lambda v: None if v is None else _floats(4)(v),
    "units": _one_of(("m", "ft-in")),
    "scale_bar": bool,
    "theme": _one_of(("light", "dark")),
    "workspace": _one_of(("inspect", "plan", "run")),
}
