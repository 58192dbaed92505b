"""Floorcast: predictive, semantic floor plans from incomplete indoor reconstructions.

The public face. Names are imported on first use, so that ``import floorplan_core`` stays cheap.

>>> import floorplan_core as fc
>>> plan = fc.process(fc.open_survey("survey.ply"))          # doctest: +SKIP
>>> planner = fc.FloorPlanner(); planner.integrate(points, T_world_sensor); planner.plan()  # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

_HOMES = {
    "Config": "floorplan_core.config",
    "CorrectingPlanner": "floorplan_core.drift.online",
    "FloorPlan": "floorplan_core.model",
    "FloorPlanner": "floorplan_core.pipeline",
    "FloorPlanError": "floorplan_core.errors",
    "export": "floorplan_core.plan_files",
    "load_plan": "floorplan_core.plan_files",
    "occupancy_map": "floorplan_core.exporters.ros_map",
    "open_survey": "floorplan_core.surveys",
    "plan_to_geojson": "floorplan_core.exporters.geojson",
    "process": "floorplan_core.pipeline",
    "process_storeys": "floorplan_core.pipeline",
    "warm_up": "floorplan_core.warm_up",
}
__all__ = [
    "Config",
    "CorrectingPlanner",
    "FloorPlan",
    "FloorPlanError",
    "FloorPlanner",
    "__version__",
    "export",
    "load_plan",
    "occupancy_map",
    "open_survey",
    "plan_to_geojson",
    "process",
    "process_storeys",
    "warm_up",
]

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.drift.online import CorrectingPlanner
    from floorplan_core.errors import FloorPlanError
    from floorplan_core.exporters.geojson import plan_to_geojson
    from floorplan_core.exporters.ros_map import occupancy_map
    from floorplan_core.model import FloorPlan
    from floorplan_core.pipeline import FloorPlanner, process, process_storeys
    from floorplan_core.plan_files import export, load_plan
    from floorplan_core.surveys import open_survey
    from floorplan_core.warm_up import warm_up


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'floorplan_core' has no attribute {name!r}")
