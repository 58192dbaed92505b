"""plan.dxf as a CAD program reads it (ezdxf's own reader and auditor)."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.document import Drawing

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters.dxf import LAYERS, DxfExporter, dxf_text
from floorplan_core.exporters.walls import poche, predicted_floor
from floorplan_core.model import FloorPlan
from tests.factories import DoorSpec, RoomSpec, l_corridor, make_plan, small_flat
from tests.hash_seeds import printed


def read(plan: FloorPlan, style: DrawingStyle = PLAIN) -> Drawing:
    document = ezdxf.read(io.StringIO(dxf_text(plan, style)))
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    return document


def rings(document: Drawing, layer: str) -> list[shapely.Polygon]:
    found = document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]')
    return [shapely.Polygon([(x, y) for x, y, *_ in line.get_points()]) for line in found]


def layers(document: Drawing, kind: str) -> set[str]:
    return {entity.dxf.layer for entity in document.modelspace().query(kind)}


def test_it_is_in_metres_and_its_layers_have_the_names_of_the_trade() -> None:
    document = read(l_corridor())
    assert document.header["$INSUNITS"] == 6
    dashed = {name: document.layers.get(name).dxf.linetype == "DASHED" for name, _, _ in LAYERS}
    assert dashed == {name: name.endswith("-PRED") for name, _, _ in LAYERS}
    assert {e.dxf.layer for e in document.modelspace()} <= set(dashed)


def test_rooms_lie_where_they_lie_in_the_world() -> None:
    plan = make_plan([RoomSpec((0, 0, 4, 3))], yaw_deg=30.0)
    (room,) = rings(read(plan), "A-AREA")
    corners = plan.to_world(np.array([[0, 0], [4, 0], [4, 3], [0, 3]]))
    assert room.symmetric_difference(shapely.Polygon(corners)).area < 1e-3


def test_it_opens_with_the_plan_in_view() -> None:
    """In land-survey coordinates; a drawing that says nothing opens at the origin, which is empty there."""
    plan = small_flat()
    shift = np.array([691_234.0, 5_334_567.0, 0.0])
    plan = replace(plan, local_frame=replace(plan.local_frame, shift=shift))
    document = read(plan)
    low, high = np.array(document.header["$EXTMIN"]), np.array(document.header["$EXTMAX"])
    x0, y0, x1, y1 = shapely.total_bounds(
        [shapely.Polygon(plan.to_world(r.polygon.exterior.coords)) for r in plan.regions]
    )
    assert low[:2] == pytest.approx((x0, y0), abs=1.0) and high[:2] == pytest.approx((x1, y1), abs=1.0)
    view = document.viewports.get("*Active")[0].dxf
    assert tuple(view.center)[:2] == pytest.approx(((x0 + x1) / 2, (y0 + y1) / 2), abs=0.01)
    assert y1 - y0 < view.height < 3 * (x1 - x0)


def test_what_is_predicted_has_layers_of_its_own() -> None:
    plan = l_corridor()
    document = read(plan)
    walls = poche(plan)
    for layer, area in (("A-WALL", walls.observed), ("A-WALL-PRED", walls.guessed)):
        drawn = shapely.union_all([shapely.Polygon()])
        for ring in rings(document, layer):  # shells and holes
            drawn = drawn.symmetric_difference(ring)
        moved = shapely.transform(area, plan.to_world)
        assert moved.area > 0
        assert drawn.symmetric_difference(moved).area < 1e-3
    hatches = [h for h in document.modelspace().query("HATCH") if h.dxf.layer == "A-AREA-PRED"]
    assert len(hatches) == len(shapely.get_parts(predicted_floor(plan)))
    seen = replace(plan, grid=replace(plan.grid, states=plan.grid.states * 0 + 1))
    assert "A-AREA-PRED" not in layers(read(seen), "HATCH")


def _quarter(arc: ezdxf.entities.Arc) -> float:
    return (arc.dxf.end_angle - arc.dxf.start_angle) % 360


@pytest.mark.parametrize("yaw", [0.0, 30.0, 135.0])
def test_doors_swing_by_a_quarter(yaw: float) -> None:
    plan = small_flat(yaw_deg=yaw)
    arcs = list(read(plan).modelspace().query("ARC"))
    assert len(arcs) == 2
    for arc in arcs:
        assert _quarter(arc) == pytest.approx(90, abs=1e-3)
        assert arc.dxf.radius == pytest.approx(0.9, abs=1e-4)


def test_an_opening_is_drawn_by_its_faces() -> None:
    rooms = [RoomSpec((0, 0, 4, 3)), RoomSpec((4.2, 0, 8, 3))]
    plan = make_plan(rooms, [DoorSpec(0, 4.1, 0.5, 2.5, "opening", (0, 1))])
    document = read(plan)
    lines = document.modelspace().query('LINE[layer=="A-DOOR"]')
    assert [line.dxf.start.distance(line.dxf.end) for line in lines] == pytest.approx([2.0, 2.0])
    assert not document.modelspace().query("ARC")


def _measured(document: Drawing) -> Sequence[float]:
    return sorted(round(d.get_measurement(), 3) for d in document.modelspace().query("DIMENSION"))


@pytest.mark.parametrize("yaw", [0.0, 30.0])
def test_dimensions_measure_the_rooms(yaw: float) -> None:
    document = read(make_plan([RoomSpec((0, 0, 4, 3))], yaw_deg=yaw))
    assert layers(document, "DIMENSION") == {"A-ANNO-DIMS"}
    assert _measured(document) == pytest.approx([3, 3, 3, 4, 4, 4], abs=2e-3)


def test_a_length_to_a_wall_that_nobody_saw_is_only_about_right() -> None:
    plan = make_plan([RoomSpec((0, 0, 4, 3), seen=0.5, guessed=frozenset({"west"}))])
    texts = {(round(d.get_measurement()), d.dxf.text) for d in read(plan).modelspace().query("DIMENSION")}
    assert texts == {(4, "≈<>"), (3, "<>")}


def test_names_and_areas_are_written() -> None:
    texts = {t.dxf.text for t in read(small_flat()).modelspace().query('TEXT[layer=="A-AREA-IDEN"]')}
    assert {"Living & dining", "14.28 m2", "room, 100 % seen"} <= texts


def _written(document: Drawing, dimension: Any) -> str:
    """What a dimension's block shows where a program does not measure for itself."""
    (text,) = document.blocks[dimension.dxf.geometry].query("MTEXT")
    return str(text.text)


def test_an_imperial_drawing_keeps_its_place_and_says_feet_and_inches() -> None:
    metric, imperial = read(l_corridor()), read(l_corridor(), DrawingStyle("imperial"))
    assert imperial.units == ezdxf.units.M
    assert [r.wkt for r in rings(imperial, "A-AREA")] == [r.wkt for r in rings(metric, "A-AREA")]
    style = imperial.dimstyles.get("FLOORCAST").dxf
    assert (style.dimlunit, style.dimlfac) == (4, pytest.approx(39.3700787))
    for dimension in imperial.query("DIMENSION"):
        assert dimension.dxf.text.endswith("<>"), "CAD programs measure anew"
        assert "' " in _written(imperial, dimension)
    assert any(t.dxf.text.endswith(" sq ft") for t in imperial.query("TEXT"))


def test_a_german_drawing_keeps_its_layers_and_says_it_in_german() -> None:
    german = read(l_corridor(), DrawingStyle(language="de"))
    assert {layer.dxf.name for layer in german.layers} == {
        layer.dxf.name for layer in read(l_corridor()).layers
    }
    texts = [t.dxf.text for t in german.query("TEXT")]
    assert any(t.startswith("Raum ") for t in texts) and any("Nettofläche" in t for t in texts)
    assert all("," in _written(german, d) for d in german.query("DIMENSION"))


def test_same_plan_same_bytes(tmp_path: Path) -> None:
    for name in ("a.dxf", "b.dxf"):
        DxfExporter().write(l_corridor(), tmp_path / name)
    assert (tmp_path / "a.dxf").read_bytes() == (tmp_path / "b.dxf").read_bytes()
    assert not ezdxf.options.write_fixed_meta_data_for_testing


def test_same_bytes_whatever_order_sets_have() -> None:
    code = "from tests.factories import small_flat; from floorplan_core.exporters.dxf import dxf_text\n"
    code += "from zlib import crc32; print(crc32(dxf_text(small_flat()).encode()))"
    assert len(printed(code)) == 1


def test_a_plan_without_rooms_is_a_title() -> None:
    document = read(replace(small_flat(), regions=(), doors=()))
    assert {e.dxf.layer for e in document.modelspace()} == {"A-ANNO-TTLB"}
