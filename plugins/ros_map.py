"""The exporters of occupancy grids for robots that ship."""

from floorplan_core.api import Exporter, hookimpl


@hookimpl
def floorcast_exporters() -> list[Exporter]:
    from floorplan_core.exporters.ros_map import PredictedRosMapExporter, RosMapExporter

    return [RosMapExporter(), PredictedRosMapExporter()]
