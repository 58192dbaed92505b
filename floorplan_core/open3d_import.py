"""Open3D, imported late and without the web plotting that it would bring along.

``import open3d`` takes seconds, and loads dash and plotly only to draw in notebooks. A stub in their place
halves the time, and lets the frozen program do without both. There Open3D's library lies packed and is
unpacked before the import (:mod:`floorplan_core.packed_libraries`).
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from floorplan_core.errors import UsageError

_PLOTS = "open3d.visualization.draw_plotly"
_LEARNING = "open3d.ml"
_NAMES = ("get_plotly_fig", "draw_plotly", "draw_plotly_server")


def load_open3d() -> Any:
    """The module ``open3d``.

    :raises UsageError: if it is not installed: a robot's computer may do without it.
    :raises OutputError: if, packed in the frozen program, its library finds no room on the disk.
    """
    if "open3d" not in sys.modules and _PLOTS not in sys.modules:
        sys.modules[_PLOTS] = _stub()
        if getattr(sys, "frozen", False):
            sys.modules[_LEARNING] = ModuleType(_LEARNING, "Left out of the frozen program.")
    try:
        import open3d
    except ImportError as error:
        raise UsageError(
            "Simulating needs Open3D, which is not installed or cannot be loaded; install it with: "
            "pip install open3d."
        ) from error
    return open3d


def _stub() -> ModuleType:
    stub = ModuleType(_PLOTS, "Left out: floorplan_core.open3d_import.")
    for name in _NAMES:
        setattr(stub, name, _left_out)
    return stub


def _left_out(*_: object, **__: object) -> None:
    raise NotImplementedError("plots in notebooks are left out (floorplan_core.open3d_import)")
