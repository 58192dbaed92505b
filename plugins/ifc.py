"""The building model that ships."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.ifc import IfcExporter

    return [IfcExporter()]
