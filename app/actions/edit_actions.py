"""The edit menu: history, selection, and deleting what is selected."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from floorcast_app.actions.naming import about, across_door, door_at, plane_at
from floorcast_app.actions.registry import Action
from floorcast_app.selection import Item
from floorplan_core.errors import UsageError
from floorplan_core.model import LayoutPlane
from floorplan_core.model.corrections import AddWall, Correction, HidePlane, RejectDoor

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

DELETABLE = ("plane", "door", "check")


def undo(workbench: Workbench) -> None:
    """Take the last step back."""
    workbench.document.undo()


def redo(workbench: Workbench) -> None:
    """Do again what was taken back."""
    workbench.document.redo()


def history(workbench: Workbench, position: int | None = None) -> None:
    """Go to a step of the history, or show it."""
    if position is None:
        workbench.ui.show("history")
        return
    steps = len(workbench.document.history)
    if not 0 <= position < steps:
        raise UsageError(f"There is no step {position}: the history has the steps 0 to {steps - 1}.")
    workbench.document.go_to(position)


def select(workbench: Workbench, kind: str, ids: str | Sequence[str]) -> None:
    """Select things by kind and id."""
    wanted = [Item(kind, i) for i in ([ids] if isinstance(ids, str) else ids)]
    missing = [i.id for i in wanted if not workbench.exists(i)]
    if missing:
        raise UsageError(f"There is no {kind} {missing[0]!r}.")
    workbench.selection.select_all(wanted)


def clear_selection(workbench: Workbench) -> None:
    """Select nothing."""
    workbench.selection.select(None)


def delete(workbench: Workbench) -> None:
    """Switch selected walls off, reject selected doors, remove selected checks: one step."""
    items = [i for i in workbench.selection.items if i.kind in DELETABLE and workbench.exists(i)]
    if not items:
        raise UsageError("Select a wall, a door or a check first; regions are merged, not deleted.")
    said: list[Correction] = []
    dropped: set[int] = set()
    for item in items:
        if item.kind == "door":
            door = workbench.find(item)
            said.append(RejectDoor(door_at(workbench, door), across_door(workbench, door)))
        elif item.kind == "plane":
            drop, more = _delete_plane(workbench, item)
            dropped |= drop
            said += more
    checks = {i.id for i in items if i.kind == "check"}
    state = workbench.state
    kept = tuple(c for k, c in enumerate(state.corrections) if k not in dropped)
    text = f"Delete {items[0].id}" if len(items) == 1 else f"Delete {len(items)} things"
    workbench.change(
        text, corrections=(*kept, *said), checks=tuple(c for c in state.checks if c.id not in checks)
    )


def _delete_plane(workbench: Workbench, item: Item) -> tuple[frozenset[int], list[Correction]]:
    """A wall drawn by hand was never there; one that the machine sees is switched off."""
    plane: LayoutPlane = workbench.find(item)
    if plane.by_hand == "hidden":
        return frozenset(), []
    spoken = about(workbench, item)
    if any(isinstance(workbench.state.corrections[k], AddWall) for k in spoken):
        return spoken, []
    return frozenset(), [HidePlane(plane_at(workbench, plane))]


def preferences(workbench: Workbench, name: str | None = None, value: str | int | None = None) -> None:
    """Show the preferences, or set one of them by name."""
    if name is None:
        workbench.ui.show("preferences")
    else:
        workbench.preferences.set(name, value)


def _deletable(workbench: Workbench) -> bool:
    return any(i.kind in DELETABLE for i in workbench.selection.items)


ACTIONS: tuple[Action, ...] = (
    Action(
        "edit.undo",
        "Undo",
        undo,
        "Take the last step back; there is no limit.",
        "Ctrl+Z",
        "undo-2",
        lambda w: bool(w.document.undo_text),
    ),
    Action(
        "edit.redo",
        "Redo",
        redo,
        "Do again what was taken back.",
        "Ctrl+Shift+Z",
        "redo-2",
        lambda w: bool(w.document.redo_text),
    ),
    Action(
        "edit.history",
        "History…",
        history,
        "All steps so far; click one to go back to it.",
        "",
        "history",
    ),
    Action(
        "edit.delete",
        "Delete",
        delete,
        "Switch the selected wall off, reject the selected door, remove the selected check.",
        "Del",
        "trash-2",
        _deletable,
    ),
    Action(
        "edit.clear_selection",
        "Select nothing",
        clear_selection,
        "Clear the selection (Esc does it, too).",
        "Ctrl+Shift+A",
        "square-dashed",
        lambda w: bool(w.selection.items),
    ),
    Action(
        "edit.preferences",
        "Preferences…",
        preferences,
        "Language, theme, units, autosave, recent files and memory.",
        "Ctrl+,",
        "settings",
    ),
    Action("edit.select", "Select by name", select, "For scripts: select things by kind and id."),
)
