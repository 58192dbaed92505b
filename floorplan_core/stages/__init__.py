"""The stages of the paper, one module each."""

from floorplan_core.kernel_cache import use_kernel_cache

use_kernel_cache()
