"""Writing SVG: numbers, escaping, elements. Millimetres of paper, y down, three decimals."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np
import shapely

FONT = "Inter, 'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"
ENLARGED = 20  # times that text is written
# Widths in em, of the widest face in the font stack, so that text fits whichever face is there.
NARROW, DIGIT, WIDE, USUAL = 0.36, 0.64, 0.98, 0.62


def number(value: float) -> str:
    """Three decimals, without trailing zeros or a negative zero."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def text_width(text: str, size: float) -> float:
    """Estimated width of ``text`` in the unit of ``size``; never less than it takes in a usual sans face."""
    return size * _ems(text)


@lru_cache(maxsize=4096)  # the size at which a text fits is looked for again and again
def _ems(text: str) -> float:
    return sum(_em(c) for c in text)


def _em(c: str) -> float:
    if c in "ilj.,:;|'!()[] ·":
        return NARROW
    if c.isdigit():
        return DIGIT
    return WIDE if c in "MWmw@%¼½¾≈" or ord(c) > 0x2E7F else (DIGIT + 0.08 if c.isupper() else USUAL)


def printable(text: str) -> str:
    """``text`` without the control characters that XML cannot hold."""
    if text.isprintable():
        return text
    return "".join(
        c if (c >= " " and c not in "\x7f\ufffe\uffff") and not _surrogate(c) else " " for c in text
    )


def _surrogate(c: str) -> bool:
    return "\ud800" <= c <= "\udfff"


def attributes(values: dict[str, Any]) -> str:
    """`` name="value"`` for each; underscores become hyphens, None is left out, numbers are formatted."""
    parts = []
    for name, value in values.items():
        if value is None:
            continue
        if isinstance(value, int | float):
            parts.append(f' {_hyphened(name)}="{number(value)}"')
        else:
            parts.append(f" {_hyphened(name)}={_quoted(str(value))}")
    return "".join(parts)


@lru_cache(maxsize=256)
def _hyphened(name: str) -> str:
    return name.replace("_", "-")


@lru_cache(maxsize=1024)  # mostly colours and ways to draw, the same few for all elements
def _quoted(value: str) -> str:
    return quoteattr(printable(value))


def polygon_path(geometry: Any) -> str:
    """Path data of a shapely Polygon or MultiPolygon already in page coordinates."""
    points, ring = shapely.get_coordinates(shapely.get_rings(shapely.get_parts(geometry)), return_index=True)
    ends = np.flatnonzero(np.diff(ring, append=-1)).tolist()  # the last point of a ring is its first
    texts = [f"{number(x)},{number(y)}" for x, y in points.tolist()]
    return "".join(
        "M" + "L".join(texts[start:end]) + "Z"
        for start, end in zip([0, *(e + 1 for e in ends)], ends, strict=False)
    )


class SvgCanvas:
    """Collects elements in order; ``group`` nests them."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._depth = 1

    def add(self, name: str, content: str | None = None, **values: Any) -> None:
        """One element; ``content`` is markup that is already escaped."""
        end = "/>" if content is None else f">{content}</{name}>"
        self.lines.append(f"{' ' * self._depth}<{name}{attributes(values)}{end}")

    @contextmanager
    def group(self, title: str | None = None, **values: Any) -> Iterator[None]:
        """A ``<g>`` around what is added inside the ``with`` block."""
        self.lines.append(f"{' ' * self._depth}<g{attributes(values)}>")
        self._depth += 1
        if title is not None:
            self.title(title)
        yield
        self._depth -= 1
        self.lines.append(f"{' ' * self._depth}</g>")

    def title(self, text: str) -> None:
        """A tooltip for the group that is open."""
        self.lines.append(f"{' ' * self._depth}<title>{escape(printable(text))}</title>")

    def area(self, geometry: Any, **values: Any) -> None:
        """A filled shapely geometry; nothing where it is empty."""
        data = polygon_path(geometry)
        if data:
            self.add("path", d=data, fill_rule="evenodd", **values)

    def line(self, a: Sequence[float], b: Sequence[float], **values: Any) -> None:
        """A straight line."""
        self.add("line", x1=float(a[0]), y1=float(a[1]), x2=float(b[0]), y2=float(b[1]), **values)

    def box(self, x: float, y: float, width: float, height: float, **values: Any) -> None:
        """A rectangle."""
        self.add("rect", x=x, y=y, width=width, height=height, **values)

    def text(self, text: str, x: float, y: float, size: float, *, turn: float = 0.0, **values: Any) -> None:
        """Text with its baseline at (x, y), turned clockwise by ``turn`` degrees about that point.

        It is written large and scaled down: viewers that know whole font sizes only cut off what millimetres
        have behind the point, 1.9 to 1.
        """
        turned = f" rotate({number(turn)})" if turn else ""
        place = f"translate({number(x)} {number(y)}){turned} scale({number(1 / ENLARGED)})"
        self.add("text", escape(printable(text)), transform=place, font_size=size * ENLARGED, **values)
