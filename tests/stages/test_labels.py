"""The paper's classifier and the checks around anybody's."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.model import Region
from floorplan_core.plugins import RegionClassifier
from floorplan_core.stages.labels import PaperClassifier, label_regions

CONFIG = Config()


def region(polygon, name: str = "1") -> Region:
    return Region(f"r{name}", name, polygon, "", 100, 100, -1.0)


def label_of(polygon, config: Config = CONFIG) -> str:
    return label_regions([region(polygon)], PaperClassifier(), config)[0].label


def comb(teeth: int) -> shapely.Polygon:
    """A back of height 1 with teeth: many turns, so a large turning distance."""
    boxes = [shapely.box(0, 0, 2 * teeth, 1)] + [shapely.box(2 * k, 0, 2 * k + 1, 3) for k in range(teeth)]
    return shapely.union_all(boxes)


def test_the_paper_classifier_is_a_classifier():
    assert isinstance(PaperClassifier(), RegionClassifier)


def test_a_square_is_a_room_with_turning_distance_zero():
    (labelled,) = label_regions([region(shapely.box(3, 4, 8, 9))], PaperClassifier(), CONFIG)
    assert labelled.label == "room"
    assert labelled.turning_distance == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(("length", "label"), [(27.9, "room"), (28.0, "corridor"), (40.0, "corridor")])
def test_the_perimeter_must_stay_below_60_m(length, label):
    assert label_of(shapely.box(0, 0, length, 2)) == label


def test_a_large_turning_distance_is_a_corridor():
    winding = comb(4)
    assert winding.length < 60
    assert label_of(winding) == "corridor"


def test_the_thresholds_are_settings():
    loose = CONFIG.with_values({"labels.max_room_turning": "10", "labels.max_room_perimeter": "100"})
    assert label_of(comb(4), loose) == "room"
    assert label_of(shapely.box(0, 0, 40, 2), loose) == "room"


def test_holes_do_not_count():
    ring = shapely.box(0, 0, 10, 10).difference(shapely.box(4, 4, 6, 6))
    (labelled,) = label_regions([region(ring)], PaperClassifier(), CONFIG)
    assert labelled.turning_distance == pytest.approx(0, abs=1e-9)
    assert labelled.label == "room"


def test_the_classifier_sees_every_region_measured():
    seen = []

    class Nosy:
        name, description = "nosy", ""

        def classify(self, region, plan, config):
            seen.append([r.turning_distance for r in plan])
            return "hall"

    polygons = [shapely.box(0, 0, 1, 1), shapely.box(2, 0, 5, 1)]
    labelled = label_regions([region(p, str(k)) for k, p in enumerate(polygons)], Nosy(), CONFIG)
    assert [r.label for r in labelled] == ["hall", "hall"]
    assert np.min(seen) >= 0


@pytest.mark.parametrize("answer", [None, "", "  ", 3])
def test_a_classifier_that_gives_no_word_is_named(answer):
    class Broken:
        name, description = "broken", ""

        def classify(self, region, plan, config):
            return answer

    with pytest.raises(NoPlanError, match=r"'broken' gave region 1 the label"):
        label_regions([region(shapely.box(0, 0, 1, 1))], Broken(), CONFIG)


def test_no_regions():
    assert label_regions([], PaperClassifier(), CONFIG) == ()
