"""plan.ifc: the plan as a building model (IFC4), in metres and in the coordinates of the input's world.

Spaces with their areas, walls with their openings and doors, on one storey. What is predicted is told apart
three times: by the layer ``A-WALL-PRED``, by a translucent grey, and by the property set ``Floorcast``, which
also says how much of a space was seen and how sure a door is. Heights that nobody saw are usual ones, and say
so. No date and no random identifiers: the same plan always gives the same bytes.
"""

from __future__ import annotations

import string
import uuid
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from floorplan_core.exporters import palette
from floorplan_core.exporters.step_file import DERIVED, Ref, StepFile, Typed, Word
from floorplan_core.exporters.svg_labels import display_name
from floorplan_core.exporters.wall_pieces import WallPiece, wall_pieces
from floorplan_core.exporters.walls import Opening, poche
from floorplan_core.model import FloorPlan, Region

USUAL_HEIGHT = 2.5  # m, of walls where no ceiling was seen
USUAL_DOOR = 2.0  # m, of doors whose lintel was not seen
LEAF, JAMB = 0.04, 0.02  # m, thickness of a door's leaf and of the lining beside it
FAR = 1e4  # m: models are moved to near the origin of their site when the world's lies farther away
NO_DATE = "2000-01-01T00:00:00"
DIGITS = string.digits + string.ascii_uppercase + string.ascii_lowercase + "_$"  # of IFC's base 64
NAMESPACE = uuid.UUID("8f5c7f0e-6f0a-5d55-9a43-2f1d6c9b7a10")  # ours, for identifiers made of names
TRANSLUCENT = 0.6
SPACE_LAYER, WALL_LAYER, GUESSED_LAYER, DOOR_LAYER = "A-AREA", "A-WALL", "A-WALL-PRED", "A-DOOR"


class IfcExporter:
    """Writes ``plan.ifc`` (IFC4, reference view)."""

    name = "IFC"
    suffixes: tuple[str, ...] = (".ifc",)
    description = "A building model: spaces, walls, doors; predicted walls on a layer of their own."

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the model of ``plan`` to ``path``."""
        path.write_text(ifc_text(plan), encoding="ascii", newline="\n")


def ifc_text(plan: FloorPlan) -> str:
    """The model of ``plan`` as the text of a STEP file."""
    from floorplan_core import __version__

    model = _Model(plan, StepFile("IFC4", "ReferenceView_V1.2", plan.source, f"Floorcast {__version__}"))
    spaces = [model.space(region) for region in plan.regions]
    walls = poche(plan)
    elements = [e for piece in wall_pieces(walls) for e in model.wall(piece, walls.openings)]
    model.finish(spaces, elements)
    return model.file.text(NO_DATE)


def global_id(*names: str) -> str:
    """IFC's 22 characters for an identifier that depends on names only."""
    number = uuid.uuid5(NAMESPACE, "\n".join(names)).int
    return "".join(DIGITS[number >> shift & 63] for shift in range(126, -1, -6))


class _Model:
    """A file with its project, and ways to add parts of a plan to it."""

    def __init__(self, plan: FloorPlan, file: StepFile) -> None:
        self.plan, self.file = plan, file
        frame = plan.frame
        self._height = frame.ceiling_z - frame.floor_z if frame.ceiling_z is not None else USUAL_HEIGHT
        self._origin = self._near_origin()
        self._up, self._level = (file.add("IfcDirection", v) for v in ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)))
        self._zero = self._placed((0.0, 0.0, 0.0))
        self._context = file.add(
            "IfcGeometricRepresentationContext", None, "Model", 3, 1e-6, self._zero, None
        )
        self._body = file.add(
            "IfcGeometricRepresentationSubContext",
            *("Body", "Model", DERIVED, DERIVED, DERIVED, DERIVED, self._context, None),
            *(Word("MODEL_VIEW"), None),
        )
        self._site_place = file.add("IfcLocalPlacement", None, self._site_origin())
        self._place = file.add("IfcLocalPlacement", self._site_place, self._zero)
        self._wall_style = self._style("Wall, observed", palette.WALL)
        self._guessed_style = self._style("Wall, speculated", palette.WALL, TRANSLUCENT)
        self._door_style = self._style("Door", palette.DOOR.accent)
        self._space_style = self._style("Space", palette.ROOM.accent, 0.8)
        self._layers: dict[str, list[Ref]] = {}

    def _near_origin(self) -> tuple[float, float, float]:
        """World metres of the site's origin: at the floor; if that is far, in whole metres near the plan."""
        x0, y0, x1, y1 = self.plan.bounds
        middle = np.array([[(x0 + x1) / 2, (y0 + y1) / 2]])
        x, y, z = (self.plan.frame.from_manhattan(middle) + self.plan.local_frame.shift)[0].tolist()
        far = max(abs(x), abs(y)) > FAR
        return float(round(x)) if far else 0.0, float(round(y)) if far else 0.0, round(z, 3)

    def _site_origin(self) -> Ref:
        """Where the site lies: in the coordinate system that the input names, if its unit is the metre."""
        crs = self.plan.local_frame.crs
        if not crs or self.plan.local_frame.unit != "m":
            return self._placed(self._origin)
        metre = self.file.add("IfcSIUnit", DERIVED, Word("LENGTHUNIT"), None, Word("METRE"))
        target = self.file.add(
            "IfcProjectedCRS", crs.split('"')[1] if '"' in crs else crs, *[None] * 5, metre
        )
        x, y, z = self._origin
        self.file.add("IfcMapConversion", self._context, target, x, y, z, 1.0, 0.0, 1.0)
        return self._zero

    def _placed(self, at: Sequence[float]) -> Ref:
        point = self.file.add("IfcCartesianPoint", tuple(at))
        return self.file.add("IfcAxis2Placement3D", point, self._up, self._level)

    def _id(self, *names: str) -> str:
        return global_id(self.plan.source, str(self.plan.storey), *names)

    def _style(self, name: str, colour: str, transparency: float = 0.0) -> Ref:
        rgb = (part / 255 for part in palette.rgb(colour))
        shade = self.file.add(
            "IfcSurfaceStyleRendering",
            *(self.file.add("IfcColourRgb", None, *rgb), transparency, *[None] * 6, Word("NOTDEFINED")),
        )
        return self.file.add("IfcSurfaceStyle", name, Word("BOTH"), (shade,))

    def _extruded(self, polygon: Any, height: float, style: Ref | None, layer: str, rise: float = 0.0) -> Ref:
        """The shape of a prism that stands on the floor, or ``rise`` above it."""
        at = self._placed((0.0, 0.0, rise)) if rise else self._zero
        curves = [self._curve(ring) for ring in (polygon.exterior, *polygon.interiors)]
        kind = "IfcArbitraryProfileDefWithVoids" if len(curves) > 1 else "IfcArbitraryClosedProfileDef"
        voids = (tuple(curves[1:]),) if len(curves) > 1 else ()
        profile = self.file.add(kind, Word("AREA"), None, curves[0], *voids)
        solid = self.file.add("IfcExtrudedAreaSolid", profile, at, self._up, height)
        if style is not None:
            self.file.add("IfcStyledItem", solid, (style,), None)
        shape = self.file.add("IfcShapeRepresentation", self._body, "Body", "SweptSolid", (solid,))
        if layer:
            self._layers.setdefault(layer, []).append(shape)
        return self.file.add("IfcProductDefinitionShape", None, None, (shape,))

    def _curve(self, ring: Any) -> Ref:
        """The ring on the site, to the micrometre."""
        world = self.plan.to_world(shapely.get_coordinates(ring)[:-1]) - self._origin[:2]
        points = [self.file.add("IfcCartesianPoint", tuple(xy)) for xy in (np.round(world, 6) + 0.0).tolist()]
        return self.file.add("IfcPolyline", (*points, points[0]))

    def space(self, region: Region) -> Ref:
        """A region as a space."""
        height = region.height if region.height is not None else self._height
        space = self.file.add(
            "IfcSpace",
            *(self._id("space", region.id), None, region.name, None, None, self._place),
            self._extruded(region.polygon, height, self._space_style, SPACE_LAYER, region.rise),
            *(display_name(region), Word("ELEMENT"), Word("INTERNAL"), None),
        )
        area = self.file.add("IfcQuantityArea", "NetFloorArea", None, None, round(region.area, 4), None)
        around = self.file.add(
            "IfcQuantityLength", "NetPerimeter", None, None, round(region.perimeter, 4), None
        )
        self._define(
            space,
            self.file.add(
                "IfcElementQuantity",
                *(
                    self._id("quantities", region.id),
                    None,
                    "Qto_SpaceBaseQuantities",
                    None,
                    None,
                    (area, around),
                ),
            ),
            region.id,
        )
        self._say(
            space,
            region.id,
            {
                "Label": Typed("IfcLabel", region.label),
                "PredictedShare": Typed("IfcReal", round(region.speculated_fraction, 4)),
                "SpeculatedSides": Typed("IfcInteger", sum(side.speculated for side in region.sides)),
                "Confidence": Typed("IfcReal", round(region.confidence, 4)),
                "HeightSeen": Typed("IfcBoolean", region.height is not None),
            },
        )
        return space

    def wall(self, piece: WallPiece, openings: Sequence[Opening]) -> list[Ref]:
        """A wall with its openings cut out of it, and the doors in them."""
        x, y = piece.polygon.representative_point().coords[0]
        name = f"{x:.3f} {y:.3f}"
        style, layer = (
            (self._wall_style, WALL_LAYER) if piece.observed else (self._guessed_style, GUESSED_LAYER)
        )
        wall = self.file.add(
            "IfcWall",
            *(self._id("wall", name), None, "Wall" if piece.observed else "Wall, speculated", None, None),
            *(
                self._place,
                self._extruded(piece.polygon, self._height, style, layer),
                None,
                Word("SOLIDWALL"),
            ),
        )
        seen = {"Predicted": Typed("IfcBoolean", not piece.observed)}
        seen["HeightSeen"] = Typed("IfcBoolean", self.plan.frame.ceiling_z is not None)
        self._say(wall, f"wall {name}", seen)
        doors = [self._opening(wall, openings[k]) for k in piece.openings]
        return [wall, *(door for door in doors if door is not None)]

    def _opening(self, wall: Ref, opening: Opening) -> Ref | None:
        """The opening cut out of its wall, and its door; None where there is no leaf."""
        door = opening.door
        usual = USUAL_DOOR if door.kind == "door" else self._height
        height = min(door.height if door.height is not None else usual, self._height)
        void = self.file.add(
            "IfcOpeningElement",
            *(self._id("opening", door.id), None, f"Opening {door.id}", None, None, self._place),
            *(self._extruded(opening.polygon, height, None, ""), None, Word("OPENING")),
        )
        self.file.add("IfcRelVoidsElement", self._id("voids", door.id), None, None, None, wall, void)
        if door.kind != "door":
            return None
        leaf = self.file.add(
            "IfcDoor",
            *(self._id("door", door.id), None, f"Door {door.id}", None, None, self._place),
            self._extruded(_door_body(opening), height, self._door_style, DOOR_LAYER),
            *(None, height, round(door.width, 4), Word("DOOR"), Word("NOTDEFINED"), None),
        )
        self.file.add("IfcRelFillsElement", self._id("fills", door.id), None, None, None, void, leaf)
        self._say(
            leaf,
            door.id,
            {
                "Confidence": Typed("IfcReal", round(door.confidence, 4)),
                "Evidence": Typed("IfcText", ", ".join(door.evidence)),
                "FoundShut": Typed("IfcBoolean", door.shut),
                "HeightSeen": Typed("IfcBoolean", door.height is not None),
            },
        )
        return leaf

    def _say(self, of: Ref, name: str, values: dict[str, Typed]) -> None:
        """The property set ``Floorcast`` of an element."""
        properties = [
            self.file.add("IfcPropertySingleValue", k, None, value, None) for k, value in values.items()
        ]
        ours = self.file.add("IfcPropertySet", self._id("set", name), None, "Floorcast", None, properties)
        self._define(of, ours, f"set {name}")

    def _define(self, of: Ref, by: Ref, name: str) -> None:
        self.file.add("IfcRelDefinesByProperties", self._id("defines", name), None, None, None, (of,), by)

    def finish(self, spaces: list[Ref], elements: list[Ref]) -> None:
        """The tree from the project to the storey, and what is in it."""
        add, source = self.file.add, self.plan.source
        units = [
            add("IfcSIUnit", DERIVED, Word(kind), None, Word(name))
            for kind, name in (
                *(("LENGTHUNIT", "METRE"), ("AREAUNIT", "SQUARE_METRE"), ("VOLUMEUNIT", "CUBIC_METRE")),
                ("PLANEANGLEUNIT", "RADIAN"),
            )
        ]
        project = add(
            "IfcProject",
            *(self._id("project"), None, source, None, None, None, None, (self._context,)),
            add("IfcUnitAssignment", units),
        )
        whole = (None, None, Word("ELEMENT"))
        site = add(
            "IfcSite", self._id("site"), None, "Site", None, None, self._site_place, *whole, *[None] * 5
        )
        building = add(
            "IfcBuilding",
            self._id("building"),
            None,
            source,
            None,
            None,
            self._place,
            *whole,
            None,
            None,
            None,
        )
        storey = add(
            "IfcBuildingStorey",
            *(self._id("storey"), None, f"Storey {self.plan.storey}", None, None, self._place, *whole),
            0.0,
        )
        tree = ((project, (site,)), (site, (building,)), (building, (storey,)), (storey, spaces))
        for i, (parent, children) in enumerate(tree):
            if children:
                add("IfcRelAggregates", self._id("tree", str(i)), None, None, None, parent, children)
        if elements:
            add(
                "IfcRelContainedInSpatialStructure",
                *(self._id("contained"), None, None, None, elements, storey),
            )
        for name, shapes in sorted(self._layers.items()):
            add("IfcPresentationLayerAssignment", name, None, shapes, None)


def _door_body(opening: Opening) -> Any:
    """A shut door: a leaf in the middle of the wall between two jambs as deep as the wall."""
    x0, y0, x1, y1 = opening.own
    door = opening.door
    if door.axis == 0:
        middle = (x0 + x1) / 2
        parts = [
            (middle - LEAF / 2, y0, middle + LEAF / 2, y1),
            (x0, y0, x1, y0 + JAMB),
            (x0, y1 - JAMB, x1, y1),
        ]
    else:
        middle = (y0 + y1) / 2
        parts = [
            (x0, middle - LEAF / 2, x1, middle + LEAF / 2),
            (x0, y0, x0 + JAMB, y1),
            (x1 - JAMB, y0, x1, y1),
        ]
    return shapely.transform(shapely.union_all([shapely.box(*part) for part in parts]), door.in_plan)
