"""Geometry without domain words: grids, sums, rays, polygons."""

from floorplan_core.kernel_cache import use_kernel_cache

use_kernel_cache()
