"""A plan in files: written with the exporters of all plugins, and the lossless one read again."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from floorplan_core.drawing_style import DrawingStyle
    from floorplan_core.model import FloorPlan

PLAN_FILE = "plan.floorplan"


def export(
    plan: FloorPlan, *files: Path | str, format: str | None = None, style: DrawingStyle | None = None
) -> None:
    """Write ``plan`` to each of ``files``; the format follows from the suffix, or is the one named.

    Files appear whole or not at all. Raises :class:`UsageError` where no exporter fits any of them, before
    the first is written, and :class:`OutputError` where a file cannot be.
    """
    from floorplan_core.drawing_style import in_style
    from floorplan_core.files import output_file
    from floorplan_core.plugins import default_registry

    paths = [Path(file) for file in files]
    exporters = [default_registry().exporter(path, format) for path in paths]
    for path, exporter in zip(paths, exporters, strict=True):
        with output_file(path) as temporary:
            (exporter if style is None else in_style(exporter, style)).write(plan, temporary)


def load_plan(path: Path | str) -> FloorPlan:
    """The plan saved in ``path``, a file or a folder that holds one. Raises :class:`InputError`."""
    from floorplan_core import intermediates
    from floorplan_core.errors import InputError
    from floorplan_core.model import FloorPlan

    path = Path(path)
    file = path / PLAN_FILE if path.is_dir() else path
    if path.is_dir() and not file.exists():
        raise InputError(
            f"The folder {path} holds no {PLAN_FILE}; 'floorcast plan INPUT --out {path}' makes one."
        )
    return intermediates.load(file, FloorPlan)
