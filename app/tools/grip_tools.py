"""Tools that take hold of what is selected and draw where nothing is: planes and doors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.layers.snap_index import Snap
from floorcast_app.tools.draw_tools import TwoPointTool
from floorcast_app.tools.gestures import SNAP, At, Mark, Point, on_line
from floorcast_app.tools.select_tool import SelectTool

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


class GripTool(SelectTool):
    """A click on a thing of its kind selects it, and it can be dragged; clicks elsewhere draw a new one."""

    cursor = "cross"
    kind = ""  # of the items that are selected rather than drawn over
    drawing: type[TwoPointTool] = TwoPointTool

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._drawing = self.drawing(workbench)

    @property
    def busy(self) -> bool:
        return super().busy or self._drawing.busy

    def press(self, at: At) -> None:
        if not self._drawing.busy:
            super().press(at)

    def move(self, at: At) -> None:
        self._drawing.move(at)

    def cursor_at(self, at: At) -> str:
        return self.cursor if self._drawing.busy else super().cursor_at(at)

    def click(self, at: At) -> None:
        if not self._drawing.busy and at.item is not None and at.item.kind == self.kind:
            self.workbench.selection.select(at.item, at.ctrl)
        else:
            self._drawing.release(at, False)

    def key(self, key: str) -> bool:
        return self._drawing.key(key) if self._drawing.busy else super().key(key)

    def cancel(self) -> bool:
        return self._drawing.cancel() or super().cancel()

    def release(self, at: At, moved: bool) -> None:
        if self._drawing.busy:
            self._drawing.release(at, moved)
        else:
            super().release(at, moved)

    def marks(self) -> tuple[Mark, ...]:
        return super().marks() if super().busy else (*super().marks(), *self._drawing.marks())


class PlaneLine(TwoPointTool):
    """The two clicks of a plane that bounds both its sides."""

    role = "selection"

    def finish(self, start: Point, end: Point) -> None:
        self.workbench.try_run("correct.add_wall", start=start, end=end, thickness=0.0)


class DoorLine(TwoPointTool):
    """The two clicks on a wall."""

    role = "door"
    nowhere = "Click on a wall: a door needs one."

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._along: Point = (1.0, 0.0)  # of the wall

    def start(self, at: At) -> Snap | None:
        source = self.source
        wall = source.snaps.wall(at.x, at.y, at.reach(SNAP)) if source is not None else None
        if wall is not None and wall.along is not None:
            self._along = wall.along
        return wall

    def aim(self, first: Point, at: At) -> Snap:
        snap = self.snap(at)
        return Snap(snap.kind, *on_line(first, self._along, snap.xy), self._along)

    def finish(self, start: Point, end: Point) -> None:
        self.workbench.try_run("correct.add_door", start=start, end=end)


class PlaneTool(GripTool):
    """Move planes, add planes."""

    name = "plane"
    kind = "plane"
    lights = ("plane",)
    drawing = PlaneLine
    hint = "Drag the selected plane, or type its offset (@0.05 moves it by that). Two clicks add a plane."


class DoorTool(GripTool):
    """Resize doors, add doors."""

    name = "door"
    kind = "door"
    lights = ("door",)
    drawing = DoorLine
    hint = "Click both jambs on a wall, or type the width. Drag the ends of the selected door."
