"""Writing STEP physical files (ISO 10303-21), the form in which IFC models are exchanged: plain text."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Ref:
    """An entity of the file, by its number."""

    number: int


@dataclass(frozen=True)
class Word:
    """A value of an enumeration."""

    text: str


@dataclass(frozen=True)
class Typed:
    """A value that names its type, as in a property."""

    kind: str
    value: Any


DERIVED = Word("")  # an attribute that follows from others


class StepFile:
    """Collects entities in order, which gives them their numbers."""

    def __init__(self, schema: str, view: str, name: str, program: str) -> None:
        self._schema, self._view, self._name, self._program = schema, view, name, program
        self._lines: list[str] = []

    def add(self, kind: str, *values: Any) -> Ref:
        """One entity with its attributes, of which None is one that is not set."""
        ref = Ref(len(self._lines) + 1)
        self._lines.append(f"#{ref.number}={kind.upper()}({','.join(map(step_value, values))});")
        return ref

    def text(self, date: str) -> str:
        """The whole file. ``date`` is ISO 8601."""
        name = ",".join(step_value(v) for v in (self._name, date, [""], [""], "", self._program, ""))
        return "\n".join(
            [
                "ISO-10303-21;",
                "HEADER;",
                f"FILE_DESCRIPTION(({step_value(f'ViewDefinition [{self._view}]')}),'2;1');",
                f"FILE_NAME({name});",
                f"FILE_SCHEMA(({step_value(self._schema)}));",
                "ENDSEC;",
                "DATA;",
                *self._lines,
                "ENDSEC;",
                "END-ISO-10303-21;",
                "",
            ]
        )


def step_value(value: Any) -> str:
    """A value as it stands in a file."""
    match value:
        case None:
            return "$"
        case bool():
            return ".T." if value else ".F."
        case Ref():
            return f"#{value.number}"
        case Word():
            return f".{value.text}." if value.text else "*"
        case Typed():
            return f"{value.kind.upper()}({step_value(value.value)})"
        case str():
            return f"'{_escaped(value)}'"
        case int():
            return str(value)
        case float():
            return _real(value)
        case Sequence():
            return f"({','.join(map(step_value, value))})"
    raise TypeError(f"{type(value).__name__} has no form in a STEP file")


def _real(value: float) -> str:
    """Six decimals at most, always with a point."""
    text = f"{value:.6f}".rstrip("0")
    return "0." if text == "-0." else text


def _escaped(text: str) -> str:
    """Quotes and backslashes doubled; what is not ASCII as UTF-16 code units."""
    doubled = text.replace("\\", "\\\\").replace("'", "''")
    return re.sub(r"[^\x20-\x7e]+", _code_units, doubled)


def _code_units(match: re.Match[str]) -> str:
    return "\\X2\\" + match[0].encode("utf-16-be", "replace").hex().upper() + "\\X0\\"
