"""Exporters that ship: the paper's figures (a), (b) and (c) as PNG pictures."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.png import OccupancyPngExporter, PlanesPngExporter, PlanPngExporter

    return [PlanPngExporter(), PlanesPngExporter(), OccupancyPngExporter()]
