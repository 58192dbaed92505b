"""The region classifier that ships: rooms and corridors as in the paper."""

from floorplan_core.api import RegionClassifier, hookimpl


@hookimpl
def floorcast_classifiers() -> list[RegionClassifier]:
    from floorplan_core.stages.labels import PaperClassifier

    return [PaperClassifier()]
