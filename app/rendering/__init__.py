"""The picture of the 3D pane in software: numba kernels, cameras, colours and picking. No Qt.

The same code on every platform and without a display; no OpenGL is needed. Coordinates are those of the
*scene*: x and y of the manhattan frame, z above the floor, metres.
"""

from floorplan_core.kernel_cache import use_kernel_cache

use_kernel_cache()  # before the first kernel is defined
