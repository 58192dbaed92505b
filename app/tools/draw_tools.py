"""Tools of two clicks: a plane, a wall, a door, a split. A typed number sets the length of the line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app import format
from floorcast_app.layers.snap_index import Snap
from floorcast_app.tools.gestures import SNAP, At, Mark, Point, Tool, Typed, distance, straight, towards

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

FAR = 1000.0  # metres: no region is longer
SHORTEST = 0.05  # metres: two clicks nearer than this are one


class TwoPointTool(Tool):
    """First click begins, second click ends; between them the line follows the pointer."""

    cursor = "cross"
    lights: tuple[str, ...] = ()
    role = "wall"

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._first: Point | None = None
        self._here: Snap | None = None  # where the next click would go
        self._typed = Typed()

    # ---- what differs between the tools -----------------------------------------------------------------

    def aim(self, first: Point, at: At) -> Snap:
        """Where the second click would go: along the axes of this part, towards what it snaps to."""
        snap, source = self.snap(at), self.source
        turn = source.turn_at(*first) if source is not None else 0.0
        return Snap(snap.kind, *straight(first, snap.xy, turn), snap.along)

    def start(self, at: At) -> Snap | None:
        """Where the first click would go; None where it cannot begin."""
        return self.snap(at)

    def finish(self, start: Point, end: Point) -> None:
        """The line is drawn."""

    # ---- what they share --------------------------------------------------------------------------------

    @property
    def busy(self) -> bool:
        return self._first is not None

    def snap(self, at: At) -> Snap:
        """The nearest corner, jamb or wall; with Shift the point itself."""
        source = self.source
        if source is None or at.shift:
            return Snap("", at.x, at.y)
        return source.snaps.at(at.x, at.y, at.reach(SNAP))

    def move(self, at: At) -> None:
        if self._first is None:
            self._here = self.start(at)
            return
        aimed = self.aim(self._first, at)
        length = self._typed.metres
        if length is not None:
            aimed = Snap("", *towards(self._first, aimed.xy, length))
        self._here = aimed

    def release(self, at: At, moved: bool) -> None:
        if moved:
            return
        self.move(at)
        if self._here is None:
            self.workbench.ui.tell(self.nowhere, "info")
        elif self._first is None:
            self._first = self._here.xy
        else:
            self._end()

    nowhere = ""  # what is told where a first click cannot begin

    def key(self, key: str) -> bool:
        if self._first is None:
            return False
        if key == "Enter":
            self._end()
            return True
        if not self._typed.take(key):
            return False
        if self._typed.metres is not None and self._here is not None:
            self._here = Snap("", *towards(self._first, self._here.xy, self._typed.metres))
        return True

    def cancel(self) -> bool:
        was = self.busy
        self._first, self._typed = None, Typed()
        return was

    def marks(self) -> tuple[Mark, ...]:
        if self._here is None:
            return ()
        at = Mark("snap" if self._here.kind else "dot", (self._here.xy,), self.role)
        if self._first is None:
            return (at,) if self._here.kind else ()
        ends = (self._first, self._here.xy)
        return *self.line(*ends), at, Mark("text", (self._here.xy,), text=self.label(*ends))

    def line(self, start: Point, end: Point) -> tuple[Mark, ...]:
        """What is drawn between the clicks."""
        return (Mark("line", (start, end), self.role),)

    def label(self, start: Point, end: Point) -> str:
        """What is written beside the pointer."""
        shown = format.length(distance(start, end), self.workbench.view.look.units)
        return f"{self._typed.text}▏ → {shown}" if self._typed.text else shown

    def _end(self) -> None:
        first, here = self._first, self._here
        if first is None or here is None or distance(first, here.xy) < SHORTEST:
            return
        self.cancel()
        self._here = None
        self.finish(first, here.xy)


class WallTool(TwoPointTool):
    """A wall with two faces."""

    name = "wall"
    hint = "Click where the wall begins and where it ends. Type a length to be exact."

    def finish(self, start: Point, end: Point) -> None:
        self.workbench.try_run("correct.add_wall", start=start, end=end)


class SplitTool(TwoPointTool):
    """Cuts a region in two."""

    name = "split"
    lights = ("region",)
    role = "selection"
    hint = "Click on two sides of a region: it is cut along the line."

    def finish(self, start: Point, end: Point) -> None:
        self.workbench.try_run("correct.split", start=start, end=end)

    def line(self, start: Point, end: Point) -> tuple[Mark, ...]:
        return (Mark("dashes", self._across(start, end), self.role),)

    def _across(self, start: Point, end: Point) -> tuple[Point, Point]:
        """The whole of the cut, from side to side of the region that the line is in."""
        import shapely

        away, middle = distance(start, end), ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        source = self.source
        if source is None or away < SHORTEST:
            return start, end
        far = tuple(FAR / away * (e - s) for s, e in zip(start, end, strict=True))
        line = shapely.LineString([(middle[0] + k * far[0], middle[1] + k * far[1]) for k in (-1, 1)])
        chords = [c for r in source.drawn.regions for c in shapely.get_parts(r.polygon.intersection(line))]
        here = shapely.Point(middle)
        chord = next((c for c in chords if c.length > 0 and c.distance(here) < SHORTEST), None)
        if chord is None:
            return start, end
        (ax, ay), (bx, by) = shapely.get_coordinates(chord)[[0, -1]].tolist()
        return (ax, ay), (bx, by)
