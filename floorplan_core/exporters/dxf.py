"""plan.dxf: the plan for CAD, in metres and in the coordinates of the input's world.

Layers are named as the US National CAD Standard (AIA) names them; what is predicted has dashed layers of its
own that end in ``-PRED``, so that a drafter can freeze what nobody saw. Dimensions are DIMENSION entities.
DXF has no unit but ``$INSUNITS``, which says metres in every style: imperial drawings keep the geometry of
the survey and only write feet and inches. The same plan always gives the same bytes.
"""

from __future__ import annotations

import io
import logging
import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from floorplan_core.drawing_style import NEARLY, PLAIN, DrawingStyle
from floorplan_core.exporters.dimensions import Span, chain, overall_span
from floorplan_core.exporters.door_symbols import Leaf, swings
from floorplan_core.exporters.svg_labels import display_name
from floorplan_core.exporters.walls import poche, predicted_floor
from floorplan_core.model import FloorPlan, Region

Float = NDArray[np.float64]

# Name, colour of the AutoCAD index, dashed.
LAYERS = (
    ("A-WALL", 7, False),
    ("A-WALL-PATT", 8, False),
    ("A-WALL-PRED", 8, True),
    ("A-DOOR", 2, False),
    ("A-AREA", 4, False),
    ("A-AREA-PRED", 9, True),
    ("A-AREA-IDEN", 7, False),
    ("A-ANNO-DIMS", 8, False),
    ("A-ANNO-TTLB", 7, False),
)
DASH = (0.3, 0.2, -0.1)  # m: whole, drawn, free
NAME, NOTE, DIMENSION, TITLE = 0.22, 0.15, 0.15, 0.3  # m: heights of text, 3 mm at 1:50 to 1:75
LINE = 1.6  # distance of lines over height of text
ROW = 0.9  # m between the walls and the chain of dimensions, and to the overall one
HATCH = 0.15  # m between the lines over predicted floor
VIEW, WIDE = 1.2, 1.5  # height of the first view over that of the plan; width of screens over their height
STYLE = "FLOORCAST"
INCHES = 1 / 0.0254  # in a metre
ARCHITECTURAL = {  # feet, inches and quarters of them beside each other, both also where they are zero
    "dimlunit": 4,
    "dimlfac": INCHES,
    "dimdec": 2,
    "dimfrac": 2,
    "dimzin": 1,
}
SIDES = ((1, 1), (1, -1), (0, 1), (0, -1))  # axis of the faces' normal and its sign


class DxfExporter:
    """Writes ``plan.dxf`` (AutoCAD 2010 and later)."""

    name = "DXF"
    suffixes: tuple[str, ...] = (".dxf",)
    description = (
        "A CAD drawing in metres: walls, doors, areas, dimensions; predicted parts on layers of their own."
    )

    def __init__(self, style: DrawingStyle = PLAIN) -> None:
        self._style = style

    def styled(self, style: DrawingStyle) -> DxfExporter:
        """The exporter of drawings whose dimensions and words are in these units, in this language."""
        return DxfExporter(style)

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the drawing of ``plan`` to ``path``."""
        path.write_text(dxf_text(plan, self._style), encoding="utf-8", newline="\n")


def dxf_text(plan: FloorPlan, style: DrawingStyle = PLAIN) -> str:
    """The drawing of ``plan`` as the text of an ASCII DXF document."""
    with _same_bytes():
        drawing = _Drawing(plan, style)
        drawing.draw_areas()
        drawing.draw_walls()
        drawing.draw_doors()
        drawing.draw_dimensions()
        drawing.draw_title()
        drawing.look_at_it()
        for kind in sorted({entity.dxftype() for entity in drawing.document.entitydb.values()}):
            drawing.document.classes.add_class(kind)  # else in the order of a set, which changes by the run
        stream = io.StringIO()
        drawing.document.write(stream)
    return stream.getvalue()


@contextmanager
def _same_bytes() -> Iterator[None]:
    """Without time stamps and random identifiers, as ezdxf offers for tests; and without its remarks."""
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # on fonts, a cache that cannot be written
    import ezdxf

    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


class _Drawing:
    """A document with our layers, and the parts of a plan to put into it."""

    def __init__(self, plan: FloorPlan, style: DrawingStyle) -> None:
        import ezdxf
        from ezdxf import units

        self.plan, self.walls, self.style = plan, poche(plan), style
        self.document = ezdxf.new("R2010", units=units.M)
        self.document.linetypes.add("DASHED", DASH, description="Predicted __ __ __")
        for name, colour, dashed in LAYERS:
            self.document.layers.add(name, color=colour, linetype="DASHED" if dashed else "Continuous")
        self._add_dimension_style()
        self.space = self.document.modelspace()

    def look_at_it(self) -> None:
        """Begin with the plan in view: in land-survey coordinates nothing lies where drawings begin."""
        x0, y0, x1, y1 = self.plan.bounds
        corners = self.plan.to_world(np.array([[x0, y0], [x1, y0], [x0, y1], [x1, y1]]))
        (left, low), (right, high) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
        self.space.reset_extents((left, low, 0.0), (right, high, 0.0))
        height = VIEW * max(high - low, (right - left) / WIDE)
        self.document.set_modelspace_vport(height, ((left + right) / 2, (low + high) / 2))

    def _add_dimension_style(self) -> None:
        style = self.document.dimstyles.new(STYLE)
        style.dxf.update(
            {
                "dimtxt": DIMENSION,
                "dimtsz": DIMENSION / 2,  # ticks instead of arrows
                "dimexo": DIMENSION,
                "dimexe": DIMENSION,
                "dimgap": DIMENSION / 3,
                "dimtad": 1,  # text above the line
                "dimdec": 3,
                "dimdsep": ord(self.style.short(0.5)[1]),
                "dimtix": 1,  # inside, however short: the width of text depends on the fonts of a machine
                "dimzin": 0,
                "dimlunit": 2,
                **(ARCHITECTURAL if self.style.imperial else {}),
            }
        )

    def draw_areas(self) -> None:
        """Regions with their names, and the floor in them that nobody saw."""
        for region in self.plan.regions:
            self._outline(region.polygon, "A-AREA")
            self._label(region)
        self._hatch(predicted_floor(self.plan), "A-AREA-PRED", lines=True)

    def draw_walls(self) -> None:
        """Seen walls filled, guessed ones in dashes."""
        for part in _polygons(self.walls.observed):
            self._outline(part, "A-WALL")
        self._hatch(self.walls.observed, "A-WALL-PATT", lines=False)
        for part in _polygons(self.walls.guessed):
            self._outline(part, "A-WALL-PRED")

    def draw_doors(self) -> None:
        """Leaves with their swing; openings as their two faces."""
        openings = self.walls.openings
        for opening, leaves in zip(openings, swings(openings, self.plan.regions), strict=True):
            for leaf in leaves:
                self._leaf(leaf)
            if not leaves:
                for face in opening.faces:
                    self._line(face, "A-DOOR")

    def draw_dimensions(self) -> None:
        """The clear lengths along each side of the building, and the overall ones beyond them."""
        if not self.plan.regions:
            return
        bounds = self.plan.bounds
        for axis, sign in SIDES:
            across = bounds[axis + 2 * (sign > 0)]
            for span in chain(self.plan.regions, axis, sign):
                self._dimension(span, axis, across + sign * ROW)
            if sign > 0:
                whole = replace(overall_span(self.plan.regions, 1 - axis), face=across)
                self._dimension(whole, axis, across + 2 * sign * ROW)

    def draw_title(self) -> None:
        """What it is, and how to read it; below the plan."""
        x0, y0, _, _ = self.plan.bounds
        for k, (text, height) in enumerate(self._title()):
            at = np.array([[x0, y0 - 3 * ROW - k * LINE * TITLE]])
            self._text(text, self._to_world(at)[0], height, "A-ANNO-TTLB")

    def _title(self) -> list[tuple[str, float]]:
        plan = self.plan
        area = sum(r.area for r in plan.regions)
        unseen = sum(r.area * r.speculated_fraction for r in plan.regions)
        share = 100 * unseen / area if area else 0.0
        say, units = self.style.say, "Dimensions in feet and inches, drawn in metres"
        return [
            (say("Floor plan of {}", self.style.title or plan.source), TITLE),
            (
                say(
                    "Net area to the inside of walls {}, {} % of it predicted, not seen",
                    _plain(self.style.area(area)),
                    f"{share:.0f}",
                ),
                NOTE,
            ),
            (
                say(
                    "{}, coordinates of the input; layers -PRED hold what was predicted",
                    say(units if self.style.imperial else "Metres"),
                ),
                NOTE,
            ),
        ]

    def _to_world(self, points: Float) -> Float:
        return np.round(self.plan.to_world(points), 6) + 0.0

    def _angle(self) -> float:
        """Degrees of the plan's x axis in the world, so that text along the walls is read from below."""
        return _slope(*self.plan.to_world(np.array([[0.0, 0.0], [1.0, 0.0]])))

    def _outline(self, polygon: Any, layer: str) -> None:
        for ring in (polygon.exterior, *polygon.interiors):
            points = self._to_world(shapely.get_coordinates(ring)[:-1])
            self.space.add_lwpolyline(points.tolist(), close=True, dxfattribs={"layer": layer})

    def _hatch(self, area: Any, layer: str, lines: bool) -> None:
        for part in _polygons(area):
            hatch = self.space.add_hatch(dxfattribs={"layer": layer})
            if lines:
                hatch.set_pattern_fill("ANSI31", scale=1.0, definition=[[45.0, (0, 0), (-HATCH, HATCH), []]])
            for k, ring in enumerate((part.exterior, *part.interiors)):
                points = self._to_world(shapely.get_coordinates(ring)[:-1])
                hatch.paths.add_polyline_path(points.tolist(), is_closed=True, flags=1 if k == 0 else 16)

    def _line(self, ends: Float, layer: str) -> None:
        a, b = self._to_world(ends)
        self.space.add_line(a.tolist(), b.tolist(), dxfattribs={"layer": layer})

    def _leaf(self, leaf: Leaf) -> None:
        self._line(np.array([leaf.hinge, leaf.tip]), "A-DOOR")
        if leaf.shut:
            return
        hinge, *ends = self._to_world(np.array([leaf.hinge, leaf.tip, leaf.closed]))
        a, b = (math.degrees(math.atan2(y, x)) for x, y in (end - hinge for end in ends))
        first, last = (
            (a, b) if (b - a) % 360 <= 180 else (b, a)
        )  # the quarter, also where the world is mirrored
        radius = float(np.hypot(*(ends[0] - hinge)))
        self.space.add_arc(
            hinge.tolist(), radius, round(first, 6), round(last, 6), dxfattribs={"layer": "A-DOOR"}
        )

    def _label(self, region: Region) -> None:
        at = shapely.get_coordinates(shapely.point_on_surface(region.polygon))
        seen = self.style.say("{} % seen", f"{100 * (1 - region.speculated_fraction):.0f}")
        note = seen if region.name.isdigit() else f"{self.style.say(region.label)}, {seen}"
        rows = [
            (display_name(region, self.style), NAME),
            (_plain(self.style.area(region.area)), NOTE),
            (note, NOTE),
        ]
        turn = math.radians(self._angle())
        down = np.array([math.sin(turn), -math.cos(turn)])
        start = self._to_world(at)[0]
        for k, (text, height) in enumerate(rows):
            place = np.round(start + (k - 1) * LINE * NAME * down, 6)
            self._text(text, place, height, "A-AREA-IDEN", centred=True)

    def _text(self, text: str, at: Float, height: float, layer: str, centred: bool = False) -> None:
        from ezdxf.enums import TextEntityAlignment

        entity = self.space.add_text(text, height=height, rotation=self._angle(), dxfattribs={"layer": layer})
        alignment = TextEntityAlignment.MIDDLE_CENTER if centred else TextEntityAlignment.LEFT
        entity.set_placement(at.tolist(), align=alignment)

    def _dimension(self, span: Span, axis: int, across: float) -> None:
        """A dimension between the ends of ``span``, its line at ``across``; ≈ where an end is guessed."""
        faces = np.array([[span.start, span.face], [span.end, span.face]])
        line = np.array([[(span.start + span.end) / 2, across]])
        points = np.vstack([faces, line])
        a, b, base = self._to_world(points if axis == 1 else points[:, ::-1])
        measured = f"{NEARLY if span.guessed else ''}<>"
        dimension = self.space.add_linear_dim(
            base.tolist(),
            a.tolist(),
            b.tolist(),
            angle=_slope(a, b),
            text=_plain(self.style.dimension(span.length, span.guessed)) if self.style.imperial else measured,
            dimstyle=STYLE,
            dxfattribs={"layer": "A-ANNO-DIMS"},
        )
        dimension.render()
        dimension.dimension.dxf.text = (
            measured  # ezdxf draws decimals only; CAD programs measure by the style
        )


def _plain(text: str) -> str:
    """Without the signs that fonts of CAD programs do not have."""
    for sign, instead in {"²": "2", "¼": " 1/4", "½": " 1/2", "¾": " 3/4"}.items():
        text = text.replace(sign, instead)
    return text


def _slope(a: Float, b: Float) -> float:
    """Degrees from -90 to 90 of a line in the world, whichever way it runs."""
    turn = math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))
    return round((turn + 90) % 180 - 90, 6)


def _polygons(area: Any) -> list[Any]:
    return [p for p in shapely.get_parts(area).tolist() if p.geom_type == "Polygon" and not p.is_empty]
