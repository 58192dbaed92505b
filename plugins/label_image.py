"""The exporter of label images that ships: one number for each region (``--labels-png``)."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.label_image import LabelImageExporter, PredictedLabelImageExporter

    return [LabelImageExporter(), PredictedLabelImageExporter()]
