"""The room-segmentation benchmark: scoring by itself, and the maps beside the checkout."""

from __future__ import annotations

import statistics

import numpy as np
import pytest

from benchmarks import maps


def test_iou_of_regions_and_rooms() -> None:
    regions = np.array([[1, 1, 1, 2], [1, 1, 1, 0]], dtype=np.int32)
    truth = np.array([[1, 1, 2, 2], [1, 1, 2, 2]], dtype=np.int32)
    np.testing.assert_allclose(maps.iou_table(regions, truth), [[4 / 6, 2 / 8], [0, 1 / 4]])


@pytest.mark.shared_data
@pytest.mark.skipif(not maps.FOLDER.is_dir(), reason="the maps are not beside the checkout (../shared/data)")
@pytest.mark.parametrize(("variant", "target"), [("plain", 0.90), ("furnished", 0.75)])
def test_rooms_of_the_benchmark_maps(variant: str, target: float) -> None:
    names = sorted(
        p.name.removesuffix("_gt_segmentation.png") for p in maps.FOLDER.glob("*_gt_segmentation.png")
    )
    scores = [maps.measure(name, variant) for name in names]
    assert len(scores) == 8
    assert statistics.fmean(s.f1 for s in scores) > target
    assert min(s.f1 for s in scores) > 0.75
