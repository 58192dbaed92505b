"""The tool in hand, one for all panes: a gesture may begin in one pane and end in another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.events import Event
from floorcast_app.tools.draw_tools import SplitTool, WallTool
from floorcast_app.tools.gestures import At, Mark, Tool
from floorcast_app.tools.grip_tools import DoorTool, PlaneTool
from floorcast_app.tools.measure_tool import MeasureTool
from floorcast_app.tools.merge_tool import MergeTool
from floorcast_app.tools.select_tool import SelectTool

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

TOOLS: dict[str, type[Tool]] = {
    tool.name: tool for tool in (SelectTool, MeasureTool, PlaneTool, DoorTool, WallTool, SplitTool, MergeTool)
}


class ToolBox:
    """Hands what the panes see to the tool, and tells the panes when there is something new to draw."""

    def __init__(self, workbench: Workbench) -> None:
        self.changed = Event()  # () marks, hint or cursor
        self._workbench = workbench
        self.tool: Tool = SelectTool(workbench)
        workbench.tool_changed.connect(self._take)
        workbench.plan_changed.connect(lambda _: self.cancel())

    def press(self, at: At) -> None:
        """The left button went down."""
        self.tool.press(at)
        self.changed.emit()

    def drag(self, at: At) -> None:
        """The pointer moved with the left button down."""
        self.tool.drag(at)
        self.changed.emit()

    def release(self, at: At, moved: bool) -> None:
        """The left button went up."""
        self.tool.release(at, moved)
        self.changed.emit()

    def move(self, at: At) -> None:
        """The pointer moved."""
        before = self.tool.marks()
        self.tool.move(at)
        if self.tool.marks() != before:
            self.changed.emit()

    def double(self, at: At) -> bool:
        """A double click; True where the tool took it."""
        took = self.tool.double(at)
        self.changed.emit()
        return took

    def key(self, key: str) -> bool:
        """A character, "Enter" or "Backspace"; True where the tool took it."""
        took = self.tool.key(key)
        if took:
            self.changed.emit()
        return took

    def cancel(self) -> bool:
        """Give up the gesture; False where there was none."""
        was = self.tool.cancel()
        if was:
            self.changed.emit()
        return was

    @property
    def busy(self) -> bool:
        """True in the middle of a gesture."""
        return self.tool.busy

    def marks(self) -> tuple[Mark, ...]:
        """What to draw over the panes."""
        return self.tool.marks()

    def _take(self, name: str) -> None:
        self.tool.cancel()
        self.tool = TOOLS.get(name, SelectTool)(self._workbench)
        self.changed.emit()
