"""The plan as a label image: one number for each region, on the raster of the map that it was made from.

For a plan of a grid map the image has exactly the size of the map's; any other plan is drawn in the world's
axes at the resolution of its occupancy grid. Pixel values are the places of the regions in the plan from 1; 0
is no region. 8 bits up to 255 regions, 16 bits beyond.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image

from floorplan_core.model import FloorPlan, MapRaster

_EIGHT_BITS = 255


class LabelImageExporter:
    """Writes ``labels.png``."""

    name = "Label image"
    suffixes: tuple[str, ...] = (".labels.png",)
    description = "one grey value for each region, on the raster of the grid map"

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the label image of ``plan``; the picture's first row is the top of the map."""
        labels = region_labels(plan)[::-1]
        kind = np.uint8 if len(plan.regions) <= _EIGHT_BITS else np.uint16
        Image.fromarray(np.ascontiguousarray(labels.astype(kind))).save(path, format="PNG")


def region_labels(plan: FloorPlan) -> NDArray[np.int32]:
    """(ny, nx) place of the region that holds a cell's centre, from 1; 0: none. Row 0 is the lowest y."""
    from floorplan_core.geometry.raster import polygon_window  # kernels: not for finding the exporter

    raster = plan.raster or world_raster(plan)
    labels = np.zeros(raster.shape, dtype=np.int32)
    for number, region in enumerate(plan.regions, start=1):
        cells = shapely.transform(region.polygon, lambda xy: raster.from_world(plan.to_world(xy)))
        window, inside = polygon_window(cells, np.zeros(2), 1.0, raster.shape)
        labels[window][inside] = number
    return labels


def world_raster(plan: FloorPlan) -> MapRaster:
    """A raster in the world's axes around the plan's occupancy grid, with cells of the same size."""
    x0, y0, x1, y1 = plan.grid.extent
    corners = plan.to_world(np.array([[x0, y0], [x1, y0], [x0, y1], [x1, y1]]))
    low, high = corners.min(axis=0), corners.max(axis=0)
    nx, ny = (max(1, round(float(v))) for v in (high - low) / plan.grid.cell)
    return MapRaster((float(low[0]), float(low[1])), 0.0, plan.grid.cell, (ny, nx))
