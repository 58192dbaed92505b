"""Exporters that ship: GeoJSON and the SVG drawing."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.geojson import GeoJsonExporter
    from floorplan_core.exporters.svg import SvgExporter

    return [GeoJsonExporter(), SvgExporter()]
