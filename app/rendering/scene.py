"""What the 3D pane shows of a plan: translucent surfaces and lines, and whose they are. No Qt."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.colours import THEMES
from floorcast_app.rendering import ramps
from floorcast_app.rendering.cloud import facing_colours, storey_height
from floorcast_app.rendering.drawables import OPAQUE, Builder, Lines, Surfaces
from floorcast_app.rendering.floors import LIFT, NO_FLOORS, Floors, make_floors
from floorcast_app.rendering.shapes import (
    dashed,
    fan,
    frame,
    on_wall,
    quad,
    raised,
)
from floorcast_app.selection import Item
from floorcast_app.view_state import Look
from floorplan_core.model import Door, FloorPlan, LayoutPlane, Region
from floorplan_core.model.layout import turned

Float = NDArray[np.float64]

DOOR_HEIGHT = 2.05  # metres, where no lintel was seen
HATCH = 3  # pixels of a stripe: what was predicted

ALPHA = {"wall": 62, "bare_wall": 110, "door": 150, "floor": 165, "predicted": 110}  # of 256
SELECTED_TINT = 0.55  # share of the selection's colour in what is selected
HIGHLIGHT = {"wall": 140, "door": 210, "floor": 190}


@dataclass(frozen=True)
class Label:
    """A name at a place."""

    at: tuple[float, float, float]  # metres, scene frame
    text: str
    area: float  # m2: the larger goes first where two meet
    width: float  # metres across, about: what a corridor is wide twice over, a square once
    item: Item


@dataclass(frozen=True)
class Scene:
    """Everything but the points."""

    floors: Surfaces
    walls: Surfaces  # planes and doors
    lines: Lines
    marks: Lines  # outlines of what is selected: seen through everything
    labels: tuple[Label, ...] = ()
    items: tuple[Item, ...] = ()
    bounds: tuple[float, float, float, float] | None = None  # x0, y0, x1, y1 of everything, metres


def build_scene(
    plan: FloorPlan | None,
    look: Look,
    selected: Iterable[Item] = (),
    hovered: Item | None = None,
    path: Float | None = None,
    floors: Floors | None = None,
) -> Scene:
    """The scene of ``plan`` as ``look`` wants it.

    ``path`` (M, 3) is the trajectory, metres, scene frame; ``floors`` those of the plan, where known.
    """
    if floors is None:
        floors = NO_FLOORS if plan is None else make_floors(plan, look.section)
    view = _View(plan, look, frozenset(selected), hovered, floors)
    if plan is not None:
        if "regions" in look.layers:
            for region in plan.regions:
                view.region(region)
        if "free_space" in look.layers:
            view.predicted()
        if "planes" in look.layers:
            for plane in plan.all_planes:
                view.plane(plane)
        if "doors" in look.layers:
            for door in plan.doors:
                view.door(door)
    if look.section is not None:
        view.section(look.section)
    if path is not None and "trajectory" in look.layers:
        view.path(path)
    return view.scene()


class _View:
    """One pass over a plan: what is drawn and how, given look and selection."""

    def __init__(
        self,
        plan: FloorPlan | None,
        look: Look,
        selected: frozenset[Item],
        hovered: Item | None,
        floors: Floors,
    ) -> None:
        self._shapes, self._look, self._selected, self._hovered = floors, look, selected, hovered
        self._holds = THEMES[look.theme]
        self._facing = facing_colours(look.theme)
        self._floors, self._walls, self._lines, self._marks = (Builder() for _ in range(4))
        self._labels: list[Label] = []
        self._items: list[Item] = []
        ceiling = storey_height(plan) if plan is not None else DOOR_HEIGHT
        self._top = ceiling if look.ceiling_cut is None else max(min(ceiling, look.ceiling_cut), 0.05)

    def region(self, region: Region) -> None:
        item, shape = Item("region", region.id), self._shapes.regions.get(region.id)
        if shape is None or self._hidden(item):
            return
        owner, lit = self._own(item), self._lit(item)
        fill = self._holds.region(region.label)
        alpha = HIGHLIGHT["floor"] if lit else ALPHA["floor"]
        self._floors.surface(shape.triangles, self._tint(item, ramps.packed(fill)), alpha, owner)
        ink = ramps.shifted(fill, -0.25 if self._look.theme == "light" else 0.25)
        for side in region.sides:
            ends = self._in_section(np.array([side.start, side.end]))
            if ends is not None:
                ends = raised(ends, LIFT)[None]
                self._lines.line(dashed(ends) if side.speculated else ends, ink, 230)
        if lit:
            self._marks.line(shape.edges, lit, 235, 2)
        self._labels.append(
            Label(shape.spot, region.name, region.area, 4 * region.area / region.perimeter, item)
        )

    def predicted(self) -> None:
        grey = ramps.packed(self._holds.predicted)
        self._floors.surface(self._shapes.predicted, grey, ALPHA["predicted"], -1, HATCH)

    def section(self, box: tuple[float, float, float, float]) -> None:
        corners = np.array(box)[[[0, 1], [2, 1], [2, 3], [0, 3], [0, 1]]]
        low, high = raised(corners, 0.0), raised(corners, self._top)
        edges = [np.stack([ring[:-1], ring[1:]], axis=1) for ring in (low, high)]
        upright = np.stack([low[:-1], high[:-1]], axis=1)
        self._lines.line(np.concatenate([*edges, upright]), ramps.packed(self._holds.accent), 200)

    def plane(self, plane: LayoutPlane) -> None:
        item = Item("plane", plane.id)
        if self._hidden(item) or plane.facing not in self._look.facings:
            return
        owner, lit = self._own(item), self._lit(item)
        bare = "points" not in self._look.layers
        colour = self._tint(item, int(self._facing[plane.facing]))
        alpha = HIGHLIGHT["wall"] if lit else ALPHA["bare_wall" if bare else "wall"]
        guessed = plane.speculated or not len(plane.observed)
        for run in plane.walls if len(plane.walls) else plane.observed:
            ends = self._in_section(turned(on_wall(plane.facing.axis, plane.offset, run), plane.turn))
            if ends is None:
                continue
            self._walls.surface(quad(ends, 0.0, self._top), colour, alpha, owner, HATCH if guessed else 0)
            top = raised(ends, self._top)[None]
            self._lines.line(dashed(top) if guessed else top, colour, OPAQUE, 1)
            if lit:
                self._marks.line(frame(ends, 0.0, self._top), lit, 235, 2)

    def door(self, door: Door) -> None:
        item = Item("door", door.id)
        ends = self._in_section(door.line())
        if self._hidden(item) or ends is None:
            return
        owner, lit = self._own(item), self._lit(item)
        top = min(door.height or DOOR_HEIGHT, self._top)
        colour = self._tint(item, ramps.packed(self._holds.door))
        half = np.zeros(2)
        half[door.axis] = max(door.thickness, 0.04) / 2
        half = door.in_plan(half[None])[0]
        alpha = HIGHLIGHT["door"] if lit else ALPHA["door"]
        self._walls.surface(
            quad(ends, 0.0, top), colour, alpha, owner, HATCH if door.kind == "opening" else 0
        )
        edge = ramps.shifted(self._holds.door, -0.15)
        self._lines.line(frame(ends, 0.0, top), edge, OPAQUE, 1)
        threshold = np.array([ends[0] - half, ends[1] - half, ends[1] + half, ends[0] + half])
        self._floors.surface(fan(raised(threshold, 2 * LIFT)), colour, OPAQUE, owner)
        if lit:
            self._marks.line(frame(ends, 0.0, top), lit, 245, 2)

    def path(self, path: Float) -> None:
        colour = ramps.packed(self._holds.accent)
        section = self._look.section
        ends = np.stack([path[:-1], path[1:]], axis=1) if len(path) > 1 else np.zeros((0, 2, 3))
        if section is not None and len(ends):
            x, y = ends[:, :, 0], ends[:, :, 1]
            inside = (x >= section[0]) & (x <= section[2]) & (y >= section[1]) & (y <= section[3])
            ends = ends[inside.all(axis=1)]
        self._lines.line(ends, colour, 235)

    def scene(self) -> Scene:
        floors, walls = self._floors.made_surfaces(), self._walls.made_surfaces()
        flat = np.concatenate([floors.corners.reshape(-1, 3), walls.corners.reshape(-1, 3)])
        bounds = None
        if len(flat):
            low, high = flat[:, :2].min(axis=0), flat[:, :2].max(axis=0)
            bounds = (float(low[0]), float(low[1]), float(high[0]), float(high[1]))
        return Scene(
            floors,
            walls,
            self._lines.made_lines(),
            self._marks.made_lines(),
            tuple(self._labels),
            tuple(self._items),
            bounds,
        )

    def _own(self, item: Item) -> int:
        self._items.append(item)
        return len(self._items) - 1

    def _hidden(self, item: Item) -> bool:
        return (item.kind, item.id) in self._look.hidden

    def _lit(self, item: Item) -> int:
        """The outline's colour of a selected or hovered item; 0 for the others."""
        if item in self._selected:
            return ramps.packed(self._holds.selection)
        return ramps.packed(self._holds.hover) if item == self._hovered else 0

    def _tint(self, item: Item, plain: int) -> int:
        """The fill of an item: what is selected leans to the colour of the selection."""
        if item not in self._selected:
            return plain
        return ramps.mixed(plain, ramps.packed(self._holds.selection), SELECTED_TINT)

    def _in_section(self, ends: Float) -> Float | None:
        """(2, 2) the part of an axis-aligned line inside the section box; None where there is none."""
        if self._look.section is None:
            return ends
        box = np.array(self._look.section).reshape(2, 2)
        cut = np.clip(ends, box[0], box[1])
        across = ends[0] == ends[1]
        if (across & (cut[0] != ends[0])).any() or (cut[0] == cut[1]).all():
            return None
        return cut
