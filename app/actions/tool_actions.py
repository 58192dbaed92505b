"""The tool menu: what a click in a plan pane does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.actions.registry import Action, with_plan

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


def _tool(name: str, text: str, tip: str, shortcut: str, icon: str) -> Action:
    """An action that takes a tool in hand."""

    def take(workbench: Workbench) -> None:
        workbench.set_tool(name)

    return Action(
        f"tool.{name}", text, take, tip, shortcut, icon, with_plan, lambda workbench: workbench.tool == name
    )


ACTIONS: tuple[Action, ...] = (
    _tool("select", "Select", "Click to select, drag what is selected.", "V", "mouse-pointer-2"),
    _tool(
        "measure",
        "Measure",
        "Two clicks measure a distance, from wall to wall where both are walls; A measures an area.",
        "M",
        "ruler",
    ),
    _tool(
        "plane",
        "Plane",
        "Drag a selected plane or type its offset; two clicks add one.",
        "P",
        "square-split-horizontal",
    ),
    _tool(
        "door",
        "Door",
        "Two clicks on a wall add a door; drag the ends of the selected one.",
        "D",
        "door-open",
    ),
    _tool("wall", "Wall", "Two clicks draw a wall with two faces.", "W", "brick-wall"),
    _tool("split", "Split", "Two clicks across a region cut it in two.", "S", "scissors"),
    _tool("merge", "Merge", "Click two regions that are one.", "G", "merge"),
)
