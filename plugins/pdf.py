"""The drawing to print that ships."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.pdf import PdfExporter

    return [PdfExporter()]
