"""Does a value fit a type annotation? For data from files, where nothing else has checked it."""

from __future__ import annotations

import types
from collections.abc import Callable
from typing import Any, Union, get_args, get_origin

import numpy as np


def conforms(value: Any, hint: Any) -> bool:
    """True where ``value`` fits ``hint``: classes, unions, tuples, lists, dictionaries and numpy arrays.

    An integer fits ``float``; the elements of an array must be of the declared type.

    >>> conforms((1.0, 2), tuple[float, float]), conforms("x", int | None)
    (True, False)
    """
    if hint is Any:
        return True
    origin = get_origin(hint)
    if origin is None:
        return _fits_class(value, hint)
    return _CHECKS[origin](value, get_args(hint)) if origin in _CHECKS else False


def _fits_class(value: Any, hint: Any) -> bool:
    if hint is None or hint is type(None):
        return value is None
    if hint is float:
        return isinstance(value, float | int | np.floating | np.integer) and not isinstance(value, bool)
    if hint is int:
        return isinstance(value, int | np.integer) and not isinstance(value, bool)
    if hint is bool:
        return isinstance(value, bool | np.bool_)
    return isinstance(value, hint)


def _fits_tuple(value: Any, items: tuple[Any, ...]) -> bool:
    if not isinstance(value, tuple):
        return False
    if len(items) == 2 and items[1] is Ellipsis:
        return all(conforms(v, items[0]) for v in value)
    return len(value) == len(items) and all(conforms(v, h) for v, h in zip(value, items, strict=True))


def _fits_list(value: Any, items: tuple[Any, ...]) -> bool:
    return isinstance(value, list) and all(conforms(v, items[0]) for v in value)


def _fits_dict(value: Any, items: tuple[Any, ...]) -> bool:
    return isinstance(value, dict) and all(
        conforms(k, items[0]) and conforms(v, items[1]) for k, v in value.items()
    )


def _fits_array(value: Any, items: tuple[Any, ...]) -> bool:
    """``items`` of ``NDArray[np.float64]`` are the shape and ``np.dtype[np.float64]``."""
    if not isinstance(value, np.ndarray):
        return False
    (scalar,) = get_args(items[1]) or (Any,)
    return scalar is Any or bool(np.issubdtype(value.dtype, scalar))


def _fits_union(value: Any, items: tuple[Any, ...]) -> bool:
    return any(conforms(value, hint) for hint in items)


_CHECKS: dict[Any, Callable[[Any, tuple[Any, ...]], bool]] = {
    tuple: _fits_tuple,
    list: _fits_list,
    dict: _fits_dict,
    np.ndarray: _fits_array,
    Union: _fits_union,
    types.UnionType: _fits_union,
}
