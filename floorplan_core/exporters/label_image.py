"""The plan as a label image: one number for each region, on the raster of the map that it was made from.

For a plan of a grid map the image has exactly the size of the map's; any other plan is drawn in the world's
axes at the resolution of its occupancy grid. Pixel values are the places of the regions in the plan from 1; 0
is no region. 8 bits up to 255 regions, 16 bits beyond. A name that ends in ``labels.predicted.png`` has the
regions only where their floor is predicted, not seen.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

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
    predicted = False

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the label image of ``plan``; the picture's first row is the top of the map."""
        labels = region_labels(plan)
        if self.predicted:
            labels[~cells_in(plan.speculated(), plan, plan.raster or world_raster(plan))] = 0
        kind = np.uint8 if len(plan.regions) <= _EIGHT_BITS else np.uint16
        Image.fromarray(np.ascontiguousarray(labels[::-1].astype(kind))).save(path, format="PNG")


class PredictedLabelImageExporter(LabelImageExporter):
    """Writes ``labels.predicted.png``."""

    name = "Label image of predictions"
    suffixes = (".labels.predicted.png",)
    description = "the same where the floor is predicted, not seen; 0 elsewhere"
    predicted = True


def region_labels(plan: FloorPlan) -> NDArray[np.int32]:
    """(ny, nx) place of the region that holds a cell's centre, from 1; 0: none. Row 0 is the lowest y."""
    raster = plan.raster or world_raster(plan)
    labels = np.zeros(raster.shape, dtype=np.int32)
    for number, region in enumerate(plan.regions, start=1):
        window, inside = _window(region.polygon, plan, raster)
        labels[window][inside] = number
    return labels


def cells_in(area: Any, plan: FloorPlan, raster: MapRaster) -> NDArray[np.bool_]:
    """(ny, nx) cells whose centre lies in ``area`` (manhattan frame)."""
    mask = np.zeros(raster.shape, dtype=bool)
    for part in shapely.get_parts(area).tolist():
        window, inside = _window(part, plan, raster)
        mask[window] |= inside
    return mask


def _window(polygon: Any, plan: FloorPlan, raster: MapRaster) -> tuple[Any, NDArray[np.bool_]]:
    """The part of a raster around a polygon (manhattan frame), and which of its cells lie in it."""
    from floorplan_core.geometry.raster import polygon_window  # kernels: not for finding the exporter

    cells = shapely.transform(polygon, lambda xy: raster.from_world(plan.to_world(xy)))
    return polygon_window(cells, np.zeros(2), 1.0, raster.shape)


def world_raster(plan: FloorPlan) -> MapRaster:
    """A raster in the world's axes around the plan's occupancy grid, with cells of the same size."""
    x0, y0, x1, y1 = plan.grid.extent
    corners = plan.to_world(np.array([[x0, y0], [x1, y0], [x0, y1], [x1, y1]]))
    low, high = corners.min(axis=0), corners.max(axis=0)
    nx, ny = (max(1, round(float(v))) for v in (high - low) / plan.grid.cell)
    return MapRaster((float(low[0]), float(low[1])), 0.0, plan.grid.cell, (ny, nx))
