"""Everything that is slow once, done before a robot starts: kernels compiled and loaded, modules imported."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from floorplan_core.model import Reconstruction

Float = NDArray[np.float64]


def warm_up() -> None:
    """Plan the bundled survey online, scan by scan, so that no scan and no plan of a run waits for a kernel.

    The first call of an installed version compiles, which takes one to two minutes; every later one of a
    new process takes seconds.
    """
    from floorplan_core.drift.online import CorrectingPlanner
    from floorplan_core.exporters.geojson import plan_to_geojson
    from floorplan_core.exporters.ros_map import occupancy_map
    from floorplan_core.pipeline import FloorPlanner
    from floorplan_core.surveys import open_survey

    survey = open_survey(Path(str(files("floorcast_resources") / "sample_survey")))
    for planner in (FloorPlanner(), CorrectingPlanner()):
        for points, pose in _scans(survey):
            planner.integrate(points, pose)
        plan = planner.plan()
        occupancy_map(plan, predicted=True)
        plan_to_geojson(plan)


def _scans(survey: Reconstruction) -> Iterator[tuple[Float, Float]]:
    """(N, 3) points in the sensor's frame and the pose (4, 4) of each scan."""
    assert survey.trajectory is not None  # it lies beside the bundled points
    chunks = list(survey.chunks())
    points = np.concatenate([chunk.points for chunk in chunks]).astype(np.float64)
    scan_id = np.concatenate([chunk.scan_id for chunk in chunks if chunk.scan_id is not None])
    for row, pose in enumerate(survey.trajectory.T_world_sensor):
        mine = points[scan_id == row]
        yield (mine - pose[:3, 3]) @ pose[:3, :3], pose
