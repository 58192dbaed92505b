"""Rooms and corridors (section "Semantic Labeling").

Paper: a region is a **room** when the perimeter of its outer boundary is below 60 m and its turning distance
to the unit square below 1, else a **corridor**. Both comparisons are strict; holes do not count.
Any :class:`~floorplan_core.plugins.RegionClassifier` can take the place of the paper's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import Region
from floorplan_core.plugins import RegionClassifier

ROOM, CORRIDOR = "room", "corridor"


class PaperClassifier:
    """The paper's rule; the thresholds are ``labels.max_room_perimeter`` and ``.max_room_turning``."""

    name = "paper"
    description = "room: perimeter under 60 m and turning distance to the square under 1; else corridor"

    def classify(self, region: Region, plan: Sequence[Region], config: Config) -> str:
        """The label of ``region``; its ``turning_distance`` must be known."""
        short = region.perimeter < config.labels.max_room_perimeter
        compact = region.turning_distance < config.labels.max_room_turning
        return ROOM if short and compact else CORRIDOR


def label_regions(
    regions: Sequence[Region], classifier: RegionClassifier, config: Config
) -> tuple[Region, ...]:
    """The regions with ``turning_distance`` and ``label``; the classifier sees all turning distances.

    :raises NoPlanError: if the classifier returns anything but a word.
    """
    measured = tuple(replace(r, turning_distance=region_turning_distance(r)) for r in regions)
    return tuple(replace(r, label=_label(r, measured, classifier, config)) for r in measured)


def region_turning_distance(region: Region) -> float:
    """Turning distance between the region's outer boundary and the unit square."""
    from floorplan_core.geometry.turning import turning_distance  # kernels: not for finding the classifier

    return turning_distance(np.asarray(region.polygon.exterior.coords, dtype=np.float64)[:-1, :2])


def _label(region: Region, plan: Sequence[Region], classifier: RegionClassifier, config: Config) -> str:
    """One label, checked: a classifier may be anybody's code."""
    label = classifier.classify(region, plan, config)
    if not isinstance(label, str) or not label.strip():
        raise NoPlanError(
            f"Region classifier {classifier.name!r} gave region {region.name} the label {label!r}, which is "
            "not a word; choose another with labels.classifier."
        )
    return label
