"""Which layers there are: one table that ties each model to how it is made, painted and switched."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from PySide6.QtGui import QPainter

from floorcast_app.layers.dimensions import dimensions_layer
from floorcast_app.layers.free_space import free_space_layer
from floorcast_app.layers.observed import points_layer, trajectory_layer
from floorcast_app.layers.planes import planes_layer
from floorcast_app.layers.regions import regions_layer
from floorcast_app.layers.source import PlanSource
from floorcast_app.layers.walls import doors_layer, walls_layer
from floorcast_app.viewports.plan_floor_views import (
    DimensionsView,
    DoorsView,
    NamesView,
    RegionsView,
    WallsView,
)
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_observed_views import FreeSpaceView, PlanesView, PointsView, TrajectoryView


class LayerView(Protocol):
    """Paints one layer; the painter's coordinates are pixels of the pane."""

    def paint(self, painter: QPainter, frame: Frame) -> None: ...


@dataclass(frozen=True)
class LayerKind:
    """One kind of layer."""

    model: Callable[[PlanSource], Any]  # makes the model: pure data
    view: Callable[[Any], LayerView]  # makes what paints it
    switch: str  # the layer of Look.layers that shows it; "" always


LAYER_KINDS: dict[str, LayerKind] = {
    "points": LayerKind(points_layer, PointsView, "points"),
    "trajectory": LayerKind(trajectory_layer, TrajectoryView, "trajectory"),
    "planes": LayerKind(planes_layer, PlanesView, "planes"),
    "free_space": LayerKind(free_space_layer, FreeSpaceView, "free_space"),
    "regions": LayerKind(regions_layer, RegionsView, "regions"),
    "walls": LayerKind(walls_layer, WallsView, "regions"),
    "doors": LayerKind(doors_layer, DoorsView, "doors"),
    "names": LayerKind(regions_layer, NamesView, "regions"),
    "dimensions": LayerKind(dimensions_layer, DimensionsView, "dimensions"),
}


def make_views(source: PlanSource, kinds: tuple[str, ...]) -> dict[str, LayerView]:
    """What paints these layers of a plan, in their order; kinds with one model share it."""
    models: dict[Callable[[PlanSource], Any], Any] = {}
    views: dict[str, LayerView] = {}
    for name in kinds:
        kind = LAYER_KINDS[name]
        if kind.model not in models:
            models[kind.model] = kind.model(source)
        views[name] = kind.view(models[kind.model])
    return views


def paint_layers(painter: QPainter, frame: Frame, views: dict[str, LayerView]) -> None:
    """The layers that the look shows, from the ground up."""
    for name, view in views.items():
        switch = LAYER_KINDS[name].switch
        if not switch or switch in frame.look.layers:
            painter.save()
            view.paint(painter, frame)
            painter.restore()
