"""Objects to a JSON tree and back: plain values as they are, everything else as a tagged list ``[tag, ...]``.

=========  =============================================================================
tag        what follows
=========  =============================================================================
``t``      items of a tuple
``l``      items of a list
``d``      key, value, key, value, ... of a dictionary
``f``      the name of a float that JSON has no number for (``nan``, ``inf``, ``-inf``)
``a``      type, start and shape of an array
``s``      type, start of a numpy scalar
``e``      class and value of an enum
``g``      hexadecimal WKB of a shapely geometry
``c``      class and values of a settings model
``o``      class, then field, value, field, value, ... of a dataclass
=========  =============================================================================
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from enum import Enum
from functools import lru_cache
from importlib import import_module
from typing import Any, get_type_hints

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import UsageError
from floorplan_core.type_check import conforms


class Pools:
    """Arrays by type, in the order in which they were added, and how many numbers each type has so far."""

    def __init__(self) -> None:
        self.parts: dict[str, list[NDArray[Any]]] = {}
        self._counts: dict[str, int] = {}

    def add(self, name: str, flat: NDArray[Any]) -> int:
        """Append ``flat``; returns the place of its first number."""
        start = self._counts.get(name, 0)
        self.parts.setdefault(name, []).append(flat)
        self._counts[name] = start + len(flat)
        return start


class Malformed(Exception):
    """The tree or an array of a file does not make sense; the text says why."""


@lru_cache(maxsize=1)
def known_classes() -> dict[str, type]:
    """The classes that may appear in a file, by name."""
    from floorplan_core import config, model

    models = {n: getattr(model, n) for n in model.__all__ if isinstance(getattr(model, n), type)}
    settings = {
        n: c for n, c in vars(config).items() if isinstance(c, type) and issubclass(c, config.Section)
    }
    return models | settings


STAGE_CLASSES = {  # of stage results; imported only when one is met, as compiled code comes with them
    "Evidence": "floorplan_core.model.evidence",
    "Surfels": "floorplan_core.geometry.surfel_map",
    "Part": "floorplan_core.stages.wings",
    "SegmentRows": "floorplan_core.stages.layout_segments",
}


def find_class(name: str) -> type | None:
    """The class called ``name``, if it may appear in a file."""
    if name in STAGE_CLASSES:
        found: type = getattr(import_module(STAGE_CLASSES[name]), name)
        return found
    return known_classes().get(name)


def encode(value: Any, pools: Pools) -> Any:
    """The tree of ``value``; its arrays are appended to ``pools``. TypeError for what is not data."""
    if value is None or isinstance(value, bool | str) or type(value) is int:
        return value
    if type(value) is float:
        return value if math.isfinite(value) else ["f", repr(value)]
    for kind, encoder in _ENCODERS:
        if isinstance(value, kind):
            return encoder(value, pools)
    return _encode_object(value, pools)


def _pool(array: NDArray[Any], pools: Pools) -> tuple[str, int]:
    """Append ``array`` to the pool of its type; returns the pool's name and the start within it."""
    if array.dtype.kind not in "biuf":
        raise TypeError(f"An array of {array.dtype} cannot be saved; numbers and booleans can.")
    little = array.astype(array.dtype.newbyteorder("<"), copy=False)
    name = little.dtype.str.lstrip("<|")
    return name, pools.add(name, little.ravel())


def _encode_array(value: NDArray[Any], pools: Pools) -> Any:
    return ["a", *_pool(value, pools), list(value.shape)]


def _encode_dict(value: dict[Any, Any], pools: Pools) -> Any:
    return ["d", *(encode(part, pools) for item in value.items() for part in item)]


def _encode_object(value: Any, pools: Pools) -> Any:
    """Dataclasses, settings and geometries."""
    name = type(value).__name__
    known = find_class(name) is type(value)
    if known and dataclasses.is_dataclass(value):
        parts = ((f.name, encode(getattr(value, f.name), pools)) for f in dataclasses.fields(value))
        return ["o", name, *(part for pair in parts for part in pair)]
    if known:
        return ["c", name, value.model_dump(mode="json")]
    if hasattr(value, "geom_type"):
        import shapely

        return ["g", shapely.to_wkb(value, hex=True, byte_order=1)]
    raise TypeError(f"A {name} cannot be saved; only data can.")


_ENCODERS: tuple[tuple[Any, Callable[[Any, Pools], Any]], ...] = (
    (Enum, lambda v, pools: ["e", type(v).__name__, v.value]),
    (tuple, lambda v, pools: ["t", *(encode(x, pools) for x in v)]),
    (list, lambda v, pools: ["l", *(encode(x, pools) for x in v)]),
    (dict, _encode_dict),
    (np.ndarray, _encode_array),
    (np.generic, lambda v, pools: ["s", *_pool(np.asarray(v)[None], pools)]),
)


def decode(tree: Any, pools: dict[str, NDArray[Any]]) -> Any:
    """The object that ``tree`` describes. Raises :class:`Malformed`."""
    if tree is None or isinstance(tree, bool | str | int | float):
        return tree
    if not isinstance(tree, list) or not tree or not isinstance(tree[0], str) or tree[0] not in _DECODERS:
        raise Malformed("its tree has an unknown tag")
    try:
        return _DECODERS[tree[0]](tree[1:], pools)
    except (TypeError, IndexError, AttributeError, UsageError) as error:
        raise Malformed(f"a {tree[0]!r} entry is wrong: {error}") from error


def _decode_dict(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    values = [decode(part, pools) for part in parts]
    return dict(zip(values[::2], values[1::2], strict=True))


def _decode_float(parts: list[Any], pools: dict[str, NDArray[Any]]) -> float:
    return {"nan": math.nan, "inf": math.inf, "-inf": -math.inf}[parts[0]]


def _decode_array(parts: list[Any], pools: dict[str, NDArray[Any]]) -> NDArray[Any]:
    name, start, shape = parts
    if not all(type(n) is int and n >= 0 for n in (start, *shape)):
        raise Malformed("the place of an array is wrong")
    count = math.prod(shape)
    if name not in pools or start + count > len(pools[name]):
        raise Malformed("an array is missing")
    return pools[name][start : start + count].reshape(shape)  # of the pool, as no other array has this part


def _decode_scalar(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    return _decode_array([parts[0], parts[1], [1]], pools)[0]


def _decode_enum(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    kind = _known(parts[0])
    if not issubclass(kind, Enum):
        raise Malformed(f"{parts[0]} is no enum")
    return kind(parts[1])


def _decode_geometry(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    import shapely

    try:
        return shapely.from_wkb(parts[0])
    except shapely.errors.ShapelyError as error:
        raise Malformed("a polygon is damaged") from error


def _decode_settings(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    from floorplan_core.config import Section

    kind = _known(parts[0])
    if not issubclass(kind, Section):
        raise Malformed(f"{parts[0]} is no settings model")
    return kind.model_validate(parts[1])


def _decode_dataclass(parts: list[Any], pools: dict[str, NDArray[Any]]) -> Any:
    kind = _known(parts[0])
    if not dataclasses.is_dataclass(kind):
        raise Malformed(f"{parts[0]} is no dataclass")
    values = {name: decode(part, pools) for name, part in zip(parts[1::2], parts[2::2], strict=True)}
    for name, hint in _hints(kind).items():
        if name in values and not conforms(values[name], hint):
            raise Malformed(f"{parts[0]}.{name} is a {type(values[name]).__name__}, which it cannot be")
    if not _required(kind) <= set(values) <= {f.name for f in dataclasses.fields(kind)}:
        raise Malformed(f"its {parts[0]} comes from another version of Floorcast")
    return kind(**values)


@lru_cache(maxsize=64)
def _required(kind: type) -> frozenset[str]:
    """The fields without a default: files of earlier versions lack those that came later."""
    none = dataclasses.MISSING
    fields = dataclasses.fields(kind)  # type: ignore[arg-type]
    return frozenset(f.name for f in fields if f.default is none and f.default_factory is none)


def _known(name: Any) -> type:
    found = find_class(name) if isinstance(name, str) else None
    if found is None:
        raise Malformed(f"it holds an unknown {name!r}")
    return found


@lru_cache(maxsize=64)
def _hints(kind: type) -> dict[str, Any]:
    """The declared types of the fields; names that a module imports for type checkers only are given here."""
    from floorplan_core import config

    return get_type_hints(kind, localns={"Config": config.Config})


_DECODERS: dict[str, Callable[[list[Any], dict[str, NDArray[Any]]], Any]] = {
    "t": lambda parts, pools: tuple(decode(x, pools) for x in parts),
    "l": lambda parts, pools: [decode(x, pools) for x in parts],
    "d": _decode_dict,
    "f": _decode_float,
    "a": _decode_array,
    "s": _decode_scalar,
    "e": _decode_enum,
    "g": _decode_geometry,
    "c": _decode_settings,
    "o": _decode_dataclass,
}
