"""Models of closed solids with several storeys, as tall as wide: up is told, and each storey is planned."""

from __future__ import annotations

from pathlib import Path

import pytest

from floorplan_core.pipeline import process_storeys
from tests.box_world import Box
from tests.plugins.plugin_files import opened

UP, HIGH, T = 3.0, 2.7, 0.3  # m from floor to floor, floor to ceiling, thickness of the outer walls


def middle(storey: int) -> float:
    """Where the partition of a storey stands."""
    return 5.0 + 0.8 * storey


def storey(k: int) -> list[Box]:
    """Two rooms over a slab, joined by a doorway of 0.9 m; 10 x 8 m inside."""
    z, top, m = k * UP, k * UP + HIGH, middle(k)
    return [
        (-T, -T, z - T, 10 + T, 8 + T, z),
        (-T, -T, z, 0, 8 + T, top),
        (10, -T, z, 10 + T, 8 + T, top),
        (0, -T, z, 10, 0, top),
        (0, 8, z, 10, 8 + T, top),
        (m, 0, z, m + 0.12, 3.0, top),
        (m, 3.0, z + 2.1, m + 0.12, 3.9, top),
        (m, 3.9, z, m + 0.12, 8, top),
    ]


@pytest.mark.parametrize(("storeys", "suffix"), [(2, "stl"), (3, "obj"), (3, "glb")])
def test_every_storey_of_a_model_of_solids_has_its_plan(storeys, suffix, tmp_path: Path):
    import trimesh

    boxes = [b for k in range(storeys) for b in storey(k)]
    roof = (-T, -T, storeys * UP - T, 10 + T, 8 + T, storeys * UP)
    model = trimesh.util.concatenate([trimesh.creation.box(bounds=(b[:3], b[3:])) for b in (*boxes, roof)])
    path = tmp_path / f"model.{suffix}"
    model.export(path)
    survey = opened(path, up="auto")
    assert (survey.local_frame.up, survey.local_frame.unit) == ("z", "m")
    plans = process_storeys(survey)
    assert len(plans) == storeys
    for k, plan in enumerate(plans):
        wanted = sorted([middle(k) * 8, (10 - 0.12 - middle(k)) * 8])
        assert sorted(r.area for r in plan.regions) == pytest.approx(wanted, abs=0.2)
        assert [r.height for r in plan.regions] == pytest.approx([HIGH, HIGH], abs=0.03)
        (door,) = plan.doors
        assert door.width == pytest.approx(0.9, abs=0.05)
