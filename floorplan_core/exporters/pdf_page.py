"""An SVG drawing of ours as a PDF page (reportlab, BSD). Millimetres, y down, as in the SVG.

Knows what ``svg_canvas`` writes and no more: groups, boxes, lines, circles, text, paths of straight lines and
quarter circles, and hatches, which PDF viewers show finer drawn as lines than as a pattern.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO
from typing import Any
from xml.etree import ElementTree

from floorplan_core.exporters.sheet import Papers, paper_size

POINTS_PER_MM = 72 / 25.4
INHERITED = (
    *("fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin"),
    *("font-weight", "text-anchor"),
)
PLAIN_LOOK = {"fill": "#000000", "stroke": "none", "stroke-width": "1", "text-anchor": "start"}
SHIFT = {"start": 0.0, "middle": 0.5, "end": 1.0}  # of the width of a text, to the left
MITER = 0  # reportlab's number for pointed corners
EVEN_ODD = 0  # and for filling that leaves holes free
FACES = {"400": "Inter-Regular", "600": "Inter-SemiBold"}  # by weight

Point = tuple[float, float]
Step = tuple[str, list[Point]]  # of a path, as reportlab calls it, and its points
Look = dict[str, str]


@dataclass(frozen=True)
class Hatch:
    """A pattern of the SVG: stripes on a translucent ground."""

    step: float  # mm from stripe to stripe
    turn: float  # degrees, clockwise
    ground: str
    ground_opacity: float
    colour: str
    opacity: float
    width: float  # mm, of a stripe


def pdf_of_svg(svg: str, papers: Papers) -> bytes:
    """The drawing in the middle of the smallest of ``papers`` that holds it, else on a page of its size."""
    root = ElementTree.fromstring(svg)
    width, height = (float(v) for v in root.attrib["viewBox"].split()[2:])
    sheet = paper_size(width, height, papers) or (width, height)
    file = BytesIO()
    page = _Page(file, sheet, {h.attrib["id"]: _hatch(h) for h in root.iter(_tag("pattern"))})
    page.describe(root.findtext(_tag("title"), ""))
    page.centre(width, height)
    page.draw(root, PLAIN_LOOK)
    page.save()
    return file.getvalue()


def _tag(name: str) -> str:
    return "{http://www.w3.org/2000/svg}" + name


def _hatch(pattern: ElementTree.Element) -> Hatch:
    ground, stripe = pattern
    (_, (turn,)), *_ = _transforms(pattern.attrib["patternTransform"])
    return Hatch(
        float(pattern.attrib["width"]),
        turn,
        ground.attrib["fill"],
        float(ground.attrib["fill-opacity"]),
        stripe.attrib["stroke"],
        float(stripe.attrib["stroke-opacity"]),
        float(stripe.attrib["stroke-width"]) / 2,  # the tile cuts off the half beyond its edge
    )


def _transforms(text: str) -> list[tuple[str, tuple[float, ...]]]:
    """Names and numbers of a ``transform``, in order."""
    calls = re.findall(r"(\w+)\(([^)]*)\)", text)
    return [(name, tuple(float(v) for v in numbers.replace(",", " ").split())) for name, numbers in calls]


@lru_cache(maxsize=1)
def _load_faces() -> None:
    """Make the workbench's font known to reportlab, which keeps it for the life of the program."""
    from importlib.resources import files

    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont

    for name in FACES.values():
        data = (files("floorcast_resources") / "fonts" / f"{name}.ttf").read_bytes()
        pdfmetrics.registerFont(TTFont(name, BytesIO(data)))


class _Page:
    """Draws elements; what an element does not say of its look is inherited from its group."""

    def __init__(self, file: BytesIO, size: Point, hatches: dict[str, Hatch]) -> None:
        from reportlab.pdfgen.canvas import Canvas

        _load_faces()
        self._size = size
        points = (size[0] * POINTS_PER_MM, size[1] * POINTS_PER_MM)
        self._canvas: Any = Canvas(file, pagesize=points, invariant=1, pageCompression=1)
        self._canvas.translate(0, points[1])
        self._canvas.scale(POINTS_PER_MM, -POINTS_PER_MM)
        self._hatches = hatches

    def centre(self, width: float, height: float) -> None:
        """Put what is drawn from now on, of this size, in the middle of the page."""
        self._canvas.translate((self._size[0] - width) / 2, (self._size[1] - height) / 2)

    def describe(self, title: str) -> None:
        """What viewers show as the document's name."""
        self._canvas.setTitle(title)
        self._canvas.setCreator("Floorcast")
        self._canvas.setAuthor("")
        self._canvas.setSubject("")

    def save(self) -> None:
        """End the page and the document."""
        self._canvas.showPage()
        self._canvas.save()

    def draw(self, element: ElementTree.Element, look: Look) -> None:
        """Draw ``element`` and what is in it."""
        look = {**look, **{k: v for k, v in element.attrib.items() if k in INHERITED}}
        self._canvas.saveState()
        for name, numbers in _transforms(element.attrib.get("transform", "")):
            scale = numbers * 2 if name == "scale" else numbers
            getattr(self._canvas, name)(*scale)
        kind = element.tag.removeprefix(_tag(""))
        if kind in ("svg", "g"):
            for child in element:
                self.draw(child, look)
        elif kind == "text":
            self._text(element, look)
        elif kind not in ("defs", "title"):
            self._shape(list(_outline(kind, element.attrib)), look)
        self._canvas.restoreState()

    def _text(self, element: ElementTree.Element, look: Look) -> None:
        size, face = float(element.attrib["font-size"]), FACES[look.get("font-weight", "400")]
        text = element.text or ""
        shift = SHIFT[look["text-anchor"]] * self._canvas.stringWidth(text, face, size)
        self._canvas.scale(1, -1)
        self._canvas.setFont(face, size)
        self._canvas.setFillColor(look["fill"])
        self._canvas.drawString(-shift, 0, text)

    def _shape(self, outline: list[Step], look: Look) -> None:
        path = self._canvas.beginPath()
        for step, points in outline:
            getattr(path, step)(*(v for point in points for v in point))
        fill, stroke = look["fill"], look["stroke"] != "none"
        if fill.startswith("url("):
            self._fill_hatched(path, self._hatches[fill[5:-1]], [p for _, points in outline for p in points])
        elif fill != "none":
            self._canvas.setFillColor(fill)
        if stroke:
            self._canvas.setStrokeColor(look["stroke"])
            self._canvas.setLineWidth(float(look["stroke-width"]))
            self._canvas.setDash([float(v) for v in look.get("stroke-dasharray", "").split()])
            self._canvas.setLineJoin(MITER)
        self._canvas.drawPath(path, stroke=stroke, fill=fill[0] == "#", fillMode=EVEN_ODD)

    def _fill_hatched(self, path: Any, hatch: Hatch, corners: list[Point]) -> None:
        self._canvas.saveState()
        self._canvas.setFillColor(hatch.ground, alpha=hatch.ground_opacity)
        self._canvas.clipPath(path, stroke=0, fill=1, fillMode=EVEN_ODD)
        self._canvas.rotate(hatch.turn)
        self._canvas.setStrokeColor(hatch.colour, alpha=hatch.opacity)
        self._canvas.setLineWidth(hatch.width)
        self._canvas.lines(_stripes(hatch, corners))
        self._canvas.restoreState()


def _stripes(hatch: Hatch, corners: list[Point]) -> list[tuple[float, float, float, float]]:
    """Middles of the stripes over the bounds of ``corners``, in the hatch's own turned axes."""
    c, s = math.cos(math.radians(hatch.turn)), math.sin(math.radians(hatch.turn))
    across, along = ([c * x + s * y for x, y in corners], [c * y - s * x for x, y in corners])
    first, last = math.floor(min(across) / hatch.step), math.ceil(max(across) / hatch.step)
    places = (i * hatch.step + hatch.width / 2 for i in range(first, last))
    return [(x, min(along), x, max(along)) for x in places]


def _outline(kind: str, values: dict[str, str]) -> Iterator[Step]:
    """Steps of a path and their points."""
    if kind == "path":
        yield from _path(values["d"])
    elif kind == "line":
        yield "moveTo", [_point(values, "x1", "y1")]
        yield "lineTo", [_point(values, "x2", "y2")]
    elif kind == "rect":
        (x, y), (w, h) = _point(values, "x", "y"), _point(values, "width", "height")
        yield "moveTo", [(x, y)]
        yield from (("lineTo", [corner]) for corner in ((x + w, y), (x + w, y + h), (x, y + h)))
        yield "close", []
    else:
        yield from _circle(_point(values, "cx", "cy"), float(values["r"]))


def _circle(middle: Point, radius: float) -> Iterator[Step]:
    """Four quarters, from the right on."""
    x, y = middle
    corners = [(x + radius, y), (x, y + radius), (x - radius, y), (x, y - radius)]
    yield "moveTo", corners[:1]
    for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
        yield "curveTo", [*_quarter(start, end, radius, True), end]


def _point(values: dict[str, str], x: str, y: str) -> Point:
    return float(values[x]), float(values[y])


def _path(data: str) -> Iterator[Step]:
    at = (0.0, 0.0)
    for letter, text in re.findall(r"([MLAZ])([^MLAZ]*)", data):
        numbers = [float(v) for v in text.replace(",", " ").split()]
        if letter == "Z":
            yield "close", []
            continue
        end = (numbers[-2], numbers[-1])
        if letter == "A":
            yield "curveTo", [*_quarter(at, end, numbers[0], bool(numbers[4])), end]
        else:
            yield "moveTo" if letter == "M" else "lineTo", [end]
        at = end


def _quarter(start: Point, end: Point, radius: float, clockwise: bool) -> tuple[Point, Point]:
    """The two inner points of the Bezier curve nearest to an arc of a quarter circle or less."""
    (x0, y0), (x1, y1) = start, end
    chord = math.hypot(x1 - x0, y1 - y0)
    angle = 2 * math.asin(min(chord / (2 * radius), 1.0))
    reach = 4 / 3 * math.tan(angle / 4) * radius
    turn = angle / 2 if clockwise else -angle / 2
    heading = math.atan2(y1 - y0, x1 - x0)
    a, b = heading - turn, heading + turn  # of the arc where it begins and where it ends
    return (
        (x0 + reach * math.cos(a), y0 + reach * math.sin(a)),
        (x1 - reach * math.cos(b), y1 - reach * math.sin(b)),
    )
