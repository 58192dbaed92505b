"""Synthetic surveys with their truth: parametric buildings, sensors, an exploring walk, realistic errors.

>>> from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset, simulate
>>> spec = SurveySpec(BuildingSpec(style="l", rooms=12), sensor_preset("lidar"), seed=7, drift=0.02)
>>> simulate(spec, Path("survey"))  # doctest: +SKIP
"""

from floorplan_core.simulation.architect import make_building
from floorplan_core.simulation.building import Building, DoorOpening, Furniture, Space, WindowOpening
from floorplan_core.simulation.files import SurveyPaths
from floorplan_core.simulation.layout import BuildingLayout, building_layout, layout_only
from floorplan_core.simulation.spec import (
    FURNITURE,
    SENSORS,
    STYLES,
    BuildingSpec,
    SensorSpec,
    SurveySpec,
    sensor_preset,
)
from floorplan_core.simulation.survey import SimulatedSurvey, simulate, simulate_survey

__all__ = [
    "FURNITURE",
    "SENSORS",
    "STYLES",
    "Building",
    "BuildingLayout",
    "BuildingSpec",
    "DoorOpening",
    "Furniture",
    "SensorSpec",
    "SimulatedSurvey",
    "Space",
    "SurveyPaths",
    "SurveySpec",
    "WindowOpening",
    "building_layout",
    "layout_only",
    "make_building",
    "sensor_preset",
    "simulate",
    "simulate_survey",
]
