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
    "open_survey": "floorplan_core.surveys",
    "process": "floorplan_core.pipeline",
}
__all__ = [
    "Config",
    "CorrectingPlanner",
    "FloorPlan",
    "FloorPlanError",
    "FloorPlanner",
    "__version__",
    "open_survey",
    "process",
]

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.drift.online import CorrectingPlanner
    from floorplan_core.errors import FloorPlanError
    from floorplan_core.model import FloorPlan
    from floorplan_core.pipeline import FloorPlanner, process
    from floorplan_core.surveys import open_survey


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'floorplan_core' has no attribute {name!r}")
