"""The View menu: layers, colours, units, theme, workspaces, cameras."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from floorcast_app.actions.registry import Action, with_plan
from floorcast_app.selection import Item
from floorcast_app.view_state import LAYERS, POINT_COLOURS, Look
from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

WORKSPACES = ("inspect", "plan", "run")
MARGIN = 1.4  # of the plan's extent, where the size of its pane is not known
WALL = 0.3  # metres that walls stand out beyond the regions
SMALLEST = 120.0  # pixels: in a smaller pane nothing can be fitted


def fit(workbench: Workbench) -> None:
    """Bring the whole plan into view."""
    assert workbench.plan is not None
    x0, y0, x1, y1 = workbench.plan.bounds
    span = _span(workbench.view.room, x1 - x0 + 2 * WALL, y1 - y0 + 2 * WALL)
    centre = (x0 + x1) / 2, (y0 + y1) / 2
    workbench.view.fitted = centre, span
    workbench.view.set(centre=centre, span=span)


def pictured(workbench: Workbench, look: Look, room: tuple[float, float], scale_bar: bool | None) -> Look:
    """``look`` for a picture of ``room`` pixels: a plan that fills its pane fills the picture, too."""
    look = look if scale_bar is None else replace(look, scale_bar=scale_bar)
    if workbench.plan is None or not workbench.view.is_fitted:
        return look
    x0, y0, x1, y1 = workbench.plan.bounds
    return replace(look, span=_span(room, x1 - x0 + 2 * WALL, y1 - y0 + 2 * WALL))


def _span(room: tuple[float, float] | None, width: float, height: float) -> float:
    """Metres across the shorter side of a pane of ``room`` pixels in which a plan and its dimensions fit."""
    from floorcast_app.layers.dimensions import writing_around

    if room is None or min(room) < SMALLEST:
        return MARGIN * max(height, width * 0.75)
    around = 2 * writing_around(min(room))
    return min(room) * max(width / (room[0] - around), height / (room[1] - around))


def zoom(workbench: Workbench, kind: str | None = None, id: str | None = None) -> None:
    """Bring one thing into view: the selected one, or that of ``kind`` and ``id``."""
    item = Item(kind, id) if kind and id else workbench.selection.item
    if item is None or workbench.find(item) is None:
        raise UsageError("Select something first; then it can be brought into view.")
    workbench.selection.zoom_asked.emit(item)


def toggle_layer(workbench: Workbench, layer: str) -> None:
    """Show or hide one layer."""
    if layer not in LAYERS:
        raise UsageError(f"There is no layer {layer!r}; the layers are: {', '.join(LAYERS)}.")
    workbench.view.set(layers=workbench.view.look.layers ^ {layer})


def colour_points(workbench: Workbench, by: str) -> None:
    """Colour the points."""
    if by not in POINT_COLOURS:
        raise UsageError(f"Points are not coloured by {by!r}; choose: {', '.join(POINT_COLOURS)}.")
    workbench.view.set(point_colour=by)


def set_look(workbench: Workbench, **values: Any) -> None:
    """Change fields of the look: camera, cut, section box."""
    try:
        workbench.view.set(**values)
    except TypeError as error:
        raise UsageError(f"The look has no such field ({error}).") from error


def show_pane(workbench: Workbench, pane: str) -> None:
    """Bring one pane to the front, by its id."""
    workbench.ui.show("pane", id=pane)


def toggle_units(workbench: Workbench) -> None:
    """Metres, or feet and inches."""
    workbench.view.set(units="ft-in" if workbench.view.look.units == "m" else "m")


def toggle_scale_bar(workbench: Workbench) -> None:
    """Show or hide the scale bar of the plan panes."""
    workbench.view.set(scale_bar=not workbench.view.look.scale_bar)


def toggle_theme(workbench: Workbench) -> None:
    """Light, or dark."""
    workbench.view.set(theme="dark" if workbench.view.look.theme == "light" else "light")


def _workspace(name: str, number: int) -> Action:
    return Action(
        f"view.{name}",
        {"inspect": "Inspect", "plan": "Plan", "run": "Run"}[name],
        lambda w: w.view.set(workspace=name),
        {
            "inspect": "Four panes side by side.",
            "plan": "The floor plan large.",
            "run": "The timeline large.",
        }[name],
        f"Ctrl+{number}",
        {"inspect": "layout-grid", "plan": "square", "run": "history"}[name],
        checked=lambda w: w.view.look.workspace == name,
    )


def _layer(layer: str) -> Action:
    text = layer.replace("_", " ").capitalize()
    return Action(
        f"view.layer_{layer}",
        text,
        lambda w: toggle_layer(w, layer),
        f"Show or hide: {text.lower()}.",
        checked=lambda w: layer in w.view.look.layers,
    )


def _colour(by: str) -> Action:
    text = {"rgb": "its own colour"}.get(by, by)
    return Action(
        f"view.colour_{by}",
        f"Points by {text}",
        lambda w: colour_points(w, by),
        f"Colour the points by {text}.",
        checked=lambda w: w.view.look.point_colour == by,
    )


ACTIONS: tuple[Action, ...] = (
    Action("view.fit", "Fit", fit, "Bring the whole plan into view.", "Home", "maximize", with_plan),
    Action(
        "view.zoom",
        "Zoom to selection",
        zoom,
        "Bring the selected thing into view.",
        "Z",
        "zoom-in",
        lambda w: w.selection.item is not None,
    ),
    Action("view.pane", "Show a pane…", show_pane, "Bring one pane to the front."),
    Action("view.look", "Set the view…", set_look, "Camera, ceiling cut and section box by numbers."),
    *(_layer(layer) for layer in LAYERS),
    *(_colour(by) for by in POINT_COLOURS),
    Action(
        "view.units",
        "Feet and inches",
        toggle_units,
        "Show lengths and areas in feet and inches.",
        checked=lambda w: w.view.look.units == "ft-in",
    ),
    Action(
        "view.scale_bar",
        "Scale bar",
        toggle_scale_bar,
        "Show or hide the scale bar of the plan panes.",
        checked=lambda w: w.view.look.scale_bar,
    ),
    Action(
        "view.theme",
        "Dark",
        toggle_theme,
        "Dark colours for dark rooms.",
        "",
        "moon",
        checked=lambda w: w.view.look.theme == "dark",
    ),
    *(_workspace(name, number) for number, name in enumerate(WORKSPACES, start=1)),
)
