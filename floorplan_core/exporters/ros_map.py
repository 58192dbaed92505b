"""map.yaml and map.pgm: the plan as an occupancy grid for a robot's navigation (map_server, Nav2).

White (254) is free, black (0) occupied, grey (205) unknown; the image's axes are the world's, since many
readers ignore a map's yaw. What was predicted is unknown in ``map.yaml``: a robot that trusts its map must
not drive where nobody looked. A name that ends in ``.predicted.yaml`` says that it may: predicted floor is
free, guessed walls are occupied, and what was seen stays as it was seen.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from floorplan_core.exporters.label_image import cells_in, world_raster
from floorplan_core.exporters.walls import poche
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED, FloorPlan, MapRaster

FREE_VALUE, OCCUPIED_VALUE, UNKNOWN_VALUE = 254, 0, 205
OCCUPIED_THRESHOLD, FREE_THRESHOLD = 0.65, 0.196  # of map_server: above 0.196 an unknown cell would be free
_VALUES = {FREE: FREE_VALUE, OCCUPIED: OCCUPIED_VALUE, UNOBSERVED: UNKNOWN_VALUE}


class RosMapExporter:
    """Writes ``map.yaml`` and, beside it, ``map.pgm``: what was seen."""

    name = "ROS map"
    suffixes: tuple[str, ...] = (".yaml",)
    description = "An occupancy grid for robots (YAML and PGM): what was seen; all else is unknown."
    predicted = False

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the two files; the image has the name of the YAML file."""
        states, raster = occupancy_map(plan, self.predicted)
        image = path.with_suffix(".pgm")
        values = np.full(states.shape, UNKNOWN_VALUE, dtype=np.uint8)
        for state, value in _VALUES.items():
            values[states == state] = value
        Image.fromarray(np.ascontiguousarray(values[::-1])).save(image, format="PPM")
        path.write_text(_header(raster, image.name), encoding="utf-8", newline="\n")


class PredictedRosMapExporter(RosMapExporter):
    """Writes ``map.predicted.yaml`` and ``map.predicted.pgm``: what was seen, and what is predicted."""

    name = "ROS map with predictions"
    suffixes = (".predicted.yaml",)
    description = "The same with predicted floor free and guessed walls occupied: for planning ahead."
    predicted = True


def occupancy_map(plan: FloorPlan, predicted: bool = False) -> tuple[NDArray[np.uint8], MapRaster]:
    """What ``map.yaml`` holds (``map.predicted.yaml`` where ``predicted``), as an array.

    :returns: (ny, nx) 0 unobserved, 1 free, 2 occupied, row 0 the lowest y; and where the cells lie.
    """
    raster = plan.raster or world_raster(plan)
    return occupancy(plan, raster, predicted), raster


def occupancy(plan: FloorPlan, raster: MapRaster, predicted: bool) -> NDArray[np.uint8]:
    """(ny, nx) UNOBSERVED, FREE or OCCUPIED of the raster's cells; row 0 is the lowest y.

    What was seen is taken from the plan's grid at each cell's centre.
    """
    states = _seen(plan, raster)
    if predicted:
        unseen = states == UNOBSERVED
        walls = poche(plan)
        floor = shapely.union_all([r.polygon for r in plan.regions] + [o.polygon for o in walls.openings])
        solid = shapely.union_all([walls.observed, walls.guessed])
        for area, state in ((floor, FREE), (solid, OCCUPIED)):
            states[unseen & cells_in(area, plan, raster)] = state
    return states


def _seen(plan: FloorPlan, raster: MapRaster) -> NDArray[np.uint8]:
    """Strip by strip: the places of all cells of a large site took 100 bytes a cell."""
    from floorplan_core.geometry.columns import strips  # kernels: not for finding the exporter

    states = np.full(raster.shape, UNOBSERVED, dtype=np.uint8)
    for first, last in strips(*raster.shape):
        _see(plan, raster, first, states[first:last])
    return states


def _see(plan: FloorPlan, raster: MapRaster, first: int, out: NDArray[np.uint8]) -> None:
    """Set the rows of the raster from ``first`` on, ``out``, to what the plan holds at their centres."""
    ny, nx = out.shape
    c, s = np.cos(raster.yaw), np.sin(raster.yaw)
    rows = np.arange(first, first + ny)
    x, y = np.meshgrid((np.arange(nx) + 0.5) * raster.cell, (rows + 0.5) * raster.cell)
    world = np.column_stack([c * x.ravel() - s * y.ravel(), s * x.ravel() + c * y.ravel()]) + raster.origin
    grid = plan.grid
    T = plan.manhattan_from_world
    local = world @ T[:2, :2].T + T[:2, 3]
    ix, iy = np.floor((local - grid.origin) / grid.cell).astype(np.int64).T
    inside = (ix >= 0) & (iy >= 0) & (ix < grid.states.shape[1]) & (iy < grid.states.shape[0])
    out.reshape(-1)[inside] = grid.states[iy[inside], ix[inside]]


def _header(raster: MapRaster, image: str) -> str:
    x, y = (round(v, 6) for v in raster.origin)
    return (
        f"image: {image}\nmode: trinary\nresolution: {round(raster.cell, 6)}\n"
        f"origin: [{x}, {y}, {round(raster.yaw, 9)}]\nnegate: 0\n"
        f"occupied_thresh: {OCCUPIED_THRESHOLD}\nfree_thresh: {FREE_THRESHOLD}\n"
    )
