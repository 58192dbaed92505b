"""A kernel for tables of plain numbers in text: several times as fast as the parsers of libraries.

Only numbers are read whose value one division or product of exact floats gives: at most 2 ** 53 without the
decimal point, and at most 22 places from it (Clinger 1990). Their result is the nearest float, as any correct
parser's. For everything else the caller asks another parser.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

_EXACT = 1 << 53  # integers up to here are floats
_MOST = 22  # powers of ten up to here are floats
_POWERS = np.array([10.0**k for k in range(_MOST + 1)])
_SPACE, _TAB, _LINE, _RETURN = 32, 9, 10, 13
_PLUS, _MINUS, _POINT, _ZERO, _NINE, _LOWER_E, _UPPER_E = 43, 45, 46, 48, 57, 101, 69
_FAR = 10_000  # no exponent counts further than this


def parse_numbers(text: bytes, rows: int, columns: int) -> NDArray[np.float64] | None:
    """(rows, columns) of text whose every line holds ``columns`` plain numbers between spaces and tabs.

    None where the text is anything else, empty lines and more digits than a float has included.
    """
    out = np.empty((rows, columns))
    return out if _parse(np.frombuffer(text, dtype=np.uint8), out, _POWERS) else None


@njit(cache=True, inline="always")
def _is_space(byte):  # type: ignore[no-untyped-def]
    return byte in (_SPACE, _TAB, _RETURN)


@njit(cache=True, nogil=True)
def _parse(text, out, powers):  # type: ignore[no-untyped-def]
    rows, columns = out.shape
    at, row, column = 0, 0, 0
    while at < len(text):
        byte = text[at]
        if _is_space(byte):
            at += 1
        elif byte == _LINE:
            if column != columns:
                return False
            row, column, at = row + 1, 0, at + 1
        else:
            if row >= rows or column >= columns:
                return False
            at, value = _number(text, at, powers)
            if at < 0:
                return False
            out[row, column] = value
            column += 1
    return (column == 0 and row == rows) or (column == columns and row == rows - 1)


@njit(cache=True, nogil=True)
def _number(text, at, powers):  # type: ignore[no-untyped-def]
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
        elif byte == _POINT and not point:
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
    if at < len(text) and not (_is_space(text[at]) or text[at] == _LINE):
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
