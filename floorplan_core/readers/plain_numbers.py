"""A kernel for tables of plain numbers in text: several times as fast as the parsers of libraries.

Only numbers are read whose value one division or product of exact floats gives: at most 2 ** 53 without the
decimal point, and at most 22 places from it (Clinger 1990). Their result is the nearest float, as any correct
parser's. For everything else the caller asks another parser.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

_EXACT = 1 << 53  # integers up to here are floats
_MOST = 22  # powers of ten up to here are floats
_POWERS = np.array([10.0**k for k in range(_MOST + 1)])
_SPACE, _TAB, _LINE, _RETURN, _HASH = 32, 9, 10, 13, 35
_PLUS, _MINUS, _POINT, _ZERO, _NINE, _LOWER_E, _UPPER_E = 43, 45, 46, 48, 57, 101, 69
_FAR = 10_000  # no exponent counts further than this


def parse_numbers(
    text: bytes, columns: int, used: Sequence[int], separator: str = " ", decimal: str = "."
) -> NDArray[np.float64] | None:
    """(N, U) plain numbers in the ``used`` columns of text whose every line holds ``columns`` words.

    Words end at spaces, tabs and at ``separator``; those of other columns may be anything without a ``#``.
    None where the text is anything else, empty lines and more digits than a float has included.
    """
    held = np.frombuffer(text, dtype=np.uint8)
    lines = int(np.count_nonzero(held == _LINE)) + (len(held) > 0 and held[-1] != _LINE)
    places = np.full(columns, -1, dtype=np.int64)
    places[list(used)] = np.arange(len(used))
    out = np.empty((lines, len(used)))
    return out if _parse(held, ord(separator), ord(decimal), places, out, _POWERS) else None


@njit(cache=True, inline="always")
def _is_space(byte, separator):  # type: ignore[no-untyped-def]
    return byte in (_SPACE, separator, _TAB, _RETURN)


@njit(cache=True, nogil=True)
def _parse(text, separator, decimal, places, out, powers):  # type: ignore[no-untyped-def]
    rows, columns = len(out), len(places)
    at, row, column = 0, 0, 0
    while at < len(text):
        byte = text[at]
        if _is_space(byte, separator):
            at += 1
        elif byte == _LINE:
            if column != columns:
                return False
            row, column, at = row + 1, 0, at + 1
        else:
            if row >= rows or column >= columns:
                return False
            if places[column] < 0:
                at = _skip(text, at, separator)
            else:
                at, out[row, places[column]] = _number(text, at, separator, decimal, powers)
            if at < 0:
                return False
            column += 1
    return (column == 0 and row == rows) or (column == columns and row == rows - 1)


@njit(cache=True, nogil=True)
def _skip(text, at, separator):  # type: ignore[no-untyped-def]
    """The place behind the word at ``at``; -1 where it may begin a comment."""
    while at < len(text) and not (_is_space(text[at], separator) or text[at] == _LINE):
        if text[at] == _HASH:
            return -1
        at += 1
    return at


@njit(cache=True, nogil=True)
def _number(text, at, separator, decimal, powers):  # type: ignore[no-untyped-def]
    """The place behind the number at ``at``, and its value; -1 where there is no plain one."""
    negative = text[at] == _MINUS
    if negative or text[at] == _PLUS:
        at += 1
    whole: Any = 0
    digits, places, point = 0, 0, False
    while at < len(text):
        byte = np.int64(text[at])
        if _ZERO <= byte <= _NINE:
            if whole > _EXACT // 10 - 1:
                return -1, 0.0
            whole = 10 * whole + byte - _ZERO
            digits += 1
            places += point
        elif byte in (_POINT, decimal) and not point:
            point = True
        else:
            break
        at += 1
    if digits == 0:
        return -1, 0.0
    exponent = 0
    if at < len(text) and (text[at] == _LOWER_E or text[at] == _UPPER_E):
        at, exponent = _exponent(text, at + 1)
        if at < 0:
            return -1, 0.0
    if at < len(text) and not (_is_space(text[at], separator) or text[at] == _LINE):
        return -1, 0.0
    exponent -= places
    if abs(exponent) > _MOST:
        return -1, 0.0
    value = whole / powers[-exponent] if exponent < 0 else whole * powers[exponent]
    return at, -value if negative else value


@njit(cache=True, nogil=True)
def _exponent(text, at):  # type: ignore[no-untyped-def]
    """The place behind an exponent, and its value; -1 where there is none."""
    down = at < len(text) and text[at] == _MINUS
    if down or (at < len(text) and text[at] == _PLUS):
        at += 1
    value: Any = 0
    first = at
    while at < len(text) and _ZERO <= np.int64(text[at]) <= _NINE:
        value = min(10 * value + np.int64(text[at]) - _ZERO, _FAR)
        at += 1
    return (-1, 0) if at == first else (at, -value if down else value)
