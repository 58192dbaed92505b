"""Where things of the plan lie, and how they are brought into view: in all panes at once. No Qt."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.layers.item_shapes import item_shape
from floorcast_app.layers.source import source_of
from floorcast_app.selection import Item
from floorcast_app.viewports.plan_camera import framed

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench
    from floorplan_core.model import FloorPlan

Point = tuple[float, float]

AROUND_ITEM = 1.8  # how much more than a thing is shown when it is zoomed to
SMALLEST_SPAN = 2.0  # metres: small things are not zoomed to more closely


def bring_into_view(workbench: Workbench, item: Item) -> None:
    """Centre the shared camera on a thing; nothing happens where the plan has it not."""
    bounds = item_bounds(workbench, item)
    if bounds is not None:
        fields = framed(bounds, AROUND_ITEM)
        workbench.view.set(**{**fields, "span": max(float(fields["span"]), SMALLEST_SPAN)})  # type: ignore[arg-type]


def item_bounds(workbench: Workbench, item: Item) -> tuple[float, float, float, float] | None:
    """x0, y0, x1, y1 of a thing, metres, manhattan frame."""
    if item.kind == "check":
        ends = check_ends(workbench, item.id)
        xs, ys = zip(*ends, strict=True) if ends else ((), ())
        return (min(xs), min(ys), max(xs), max(ys)) if ends else None
    plan = workbench.plan
    return item_shape(source_of(plan), item).bounds if plan is not None else None


def check_ends(workbench: Workbench, id: str) -> tuple[Point, Point] | None:
    """The ends of a measurement in plan coordinates."""
    check = workbench.find(Item("check", id))
    if check is None or workbench.plan is None:
        return None
    return workbench.to_plan(check.start), workbench.to_plan(check.end)


def change_plan(workbench: Workbench, plan: FloorPlan | None) -> None:
    """Another plan of the same survey, seen from the same place: origins move while a run grows."""
    view, centre = workbench.view, None
    if workbench.plan is not None and plan is not None:
        centre, fitted = workbench.to_local(view.look.centre), view.is_fitted
    workbench.plan = plan
    if centre is not None:
        view.set(centre=workbench.to_plan(centre))
        if fitted:
            view.fitted = view.look.centre, view.look.span
