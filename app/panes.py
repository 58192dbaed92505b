"""Which panes there are: one table. The window makes docks of it, the script takes pictures of it."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


@dataclass(frozen=True)
class Pane:
    """One dockable pane."""

    id: str  # "floor_plan", as scripts name it
    title: str  # sentence case, English; translated when shown
    home: str  # "left", "centre", "right", "tables" or "bottom"
    widget: str  # "module:Class" below floorcast_app; the class takes the workbench

    def make(self, workbench: Workbench) -> QWidget:
        """The widget."""
        module, _, name = self.widget.partition(":")
        made: QWidget = getattr(import_module(f"floorcast_app.{module}"), name)(workbench)
        return made


PANES = (
    Pane("layers", "Layers", "left", "panels.layers_panel:LayersPanel"),
    Pane("space", "3D", "centre", "viewports.space_view:SpaceView"),
    Pane("planes", "Layout planes", "centre", "viewports.planes_view:PlanesView"),
    Pane("free_space", "Free space", "centre", "viewports.free_space_view:FreeSpaceView"),
    Pane("floor_plan", "Floor plan", "centre", "viewports.floor_plan_view:FloorPlanView"),
    Pane("properties", "Selection", "right", "panels.properties_panel:PropertiesPanel"),
    Pane("evidence", "Door evidence", "right", "viewports.evidence_view:EvidenceView"),
    Pane("settings", "Settings", "right", "panels.settings_panel:SettingsPanel"),
    Pane("region_list", "Regions", "tables", "panels.items_panel:RegionList"),
    Pane("door_list", "Doors", "tables", "panels.items_panel:DoorList"),
    Pane("plane_list", "Planes", "tables", "panels.items_panel:PlaneList"),
    Pane("ground_truth", "Ground truth", "tables", "panels.ground_truth_panel:GroundTruthPanel"),
    Pane("warnings", "Warnings", "tables", "panels.warnings_panel:WarningsPanel"),
    Pane("history", "History", "tables", "panels.history_panel:HistoryPanel"),
    Pane("timeline", "Timeline", "bottom", "panels.timeline_panel:TimelinePanel"),
)

FORMER = {"items": "region_list"}  # names that scripts may still use
