"""plan.ifc as other programs read it (ifcopenshell and its validation)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.util.element as util
import ifcopenshell.validate
import numpy as np
import pytest
import shapely

from floorplan_core.evaluation.compare import evaluate
from floorplan_core.exporters.geojson import GeoJsonExporter
from floorplan_core.exporters.ifc import IfcExporter, global_id, ifc_text
from floorplan_core.exporters.step_file import Ref, Typed, Word, step_value
from floorplan_core.exporters.wall_pieces import straight_pieces, wall_pieces
from floorplan_core.exporters.walls import poche
from floorplan_core.model import FloorPlan
from tests.factories import DoorSpec, RoomSpec, l_corridor, make_plan, small_flat
from tests.hash_seeds import printed

FAR = (4_480_000.0, 5_330_000.0)


def read(plan: FloorPlan, rules: bool = False) -> Any:
    """The model, held against the schema, and where asked against its ``rules``, which takes seconds."""
    model = ifcopenshell.file.from_string(ifc_text(plan))
    log = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(model, log, express_rules=rules)
    assert [statement["message"] for statement in log.statements] == []
    return model


def said(element: Any) -> dict[str, Any]:
    return dict(util.get_psets(element)["Floorcast"])


def test_the_model_keeps_to_the_rules_of_the_standard() -> None:
    plan = l_corridor()
    model = read(replace(plan, local_frame=replace(plan.local_frame, crs="EPSG:25832")), rules=True)
    assert len(model.by_type("IfcSpace")) == len(plan.regions)
    assert model.by_type("IfcDoor")


@pytest.mark.parametrize("placed", [{}, {"yaw_deg": 30.0}, {"yaw_deg": 30.0, "shift": (*FAR, 500.0)}])
def test_the_model_says_what_the_plan_says(placed: dict[str, Any], tmp_path: Path) -> None:
    plan = small_flat(**placed)
    IfcExporter().write(plan, tmp_path / "plan.ifc")
    GeoJsonExporter().write(plan, tmp_path / "plan.geojson")
    found = evaluate(tmp_path / "plan.geojson", tmp_path / "plan.ifc")
    assert found.rooms is not None and found.doors is not None
    assert found.rooms.mean_iou == pytest.approx(1.0, abs=1e-4)
    assert found.doors.required > 0
    assert found.doors.precision == found.doors.recall == 1.0
    assert found.doors.max_width_error_m == pytest.approx(0.0, abs=1e-3)
    assert found.yaw_error_deg == pytest.approx(0.0, abs=1e-3)


def test_what_is_predicted_is_told_by_layer_and_by_property() -> None:
    plan = make_plan([RoomSpec((0, 0, 4, 3), seen=0.5, guessed=frozenset({"west"}))])
    model = read(plan)
    layers = {
        layer.Name: len(layer.AssignedItems) for layer in model.by_type("IfcPresentationLayerAssignment")
    }
    walls = {said(wall)["Predicted"] for wall in model.by_type("IfcWall")}
    assert layers["A-WALL-PRED"] >= 1
    assert layers["A-WALL"] >= 3
    assert walls == {True, False}
    (space,) = model.by_type("IfcSpace")
    assert said(space)["PredictedShare"] == pytest.approx(plan.regions[0].speculated_fraction, abs=1e-4)
    assert said(space)["SpeculatedSides"] == 1


def test_a_door_stands_in_an_opening_of_its_wall() -> None:
    rooms = [RoomSpec((0, 0, 4, 3)), RoomSpec((4.15, 0, 8, 3))]
    model = read(make_plan(rooms, [DoorSpec(0, 4.075, 1.0, 1.9, joins=(0, 1))]))
    (door,) = model.by_type("IfcDoor")
    (fills,) = door.FillsVoids
    (voids,) = fills.RelatingOpeningElement.VoidsElements
    assert voids.RelatingBuildingElement.is_a("IfcWall")
    assert door.OverallWidth == pytest.approx(0.9)
    assert said(door)["HeightSeen"]


def test_an_opening_has_no_leaf() -> None:
    rooms = [RoomSpec((0, 0, 4, 3)), RoomSpec((4.15, 0, 8, 3))]
    model = read(make_plan(rooms, [DoorSpec(0, 4.075, 0.5, 2.5, kind="opening", joins=(0, 1))]))
    assert not model.by_type("IfcDoor")
    assert len(model.by_type("IfcRelVoidsElement")) == 1


def test_far_coordinates_are_those_of_the_site() -> None:
    model = read(small_flat(shift=(*FAR, 500.0)))
    (site,) = model.by_type("IfcSite")
    at = site.ObjectPlacement.RelativePlacement.Location.Coordinates
    assert np.hypot(at[0] - FAR[0], at[1] - FAR[1]) < 50
    assert max(abs(v) for point in model.by_type("IfcCartesianPoint") for v in point.Coordinates[:2]
               if point.Coordinates != at) < 50  # fmt: skip


def test_a_coordinate_system_of_the_input_is_kept() -> None:
    plan = small_flat(shift=(*FAR, 500.0))
    model = read(replace(plan, local_frame=replace(plan.local_frame, crs="EPSG:25832")))
    (conversion,) = model.by_type("IfcMapConversion")
    assert conversion.TargetCRS.Name == "EPSG:25832"
    assert np.hypot(conversion.Eastings - FAR[0], conversion.Northings - FAR[1]) < 50


def test_walls_are_cut_into_straight_pieces() -> None:
    tee = shapely.union(shapely.box(0, 0, 10, 0.2), shapely.box(4, 0.2, 4.1, 6))
    across, up = sorted(straight_pieces(tee), key=lambda piece: piece.bounds)
    assert across.equals(shapely.box(0, 0, 10, 0.2))
    assert up.equals(shapely.box(4, 0.2, 4.1, 6))


def test_pieces_cover_the_walls_and_fill_their_openings() -> None:
    walls = poche(l_corridor())
    pieces = wall_pieces(walls)
    whole = shapely.union_all([walls.observed, walls.guessed, *(o.polygon for o in walls.openings)])
    assert shapely.union_all([p.polygon for p in pieces]).symmetric_difference(whole).area < 1e-6
    assert sum(p.polygon.area for p in pieces) == pytest.approx(whole.area, abs=1e-6)
    assert sorted(k for p in pieces for k in p.openings) == list(range(len(walls.openings)))


def test_a_wall_at_an_angle_stays_whole() -> None:
    slanted = shapely.Polygon([(0, 0), (3, 3), (2.9, 3.1), (-0.1, 0.1)])
    assert straight_pieces(slanted) == [slanted]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "$"),
        (True, ".T."),
        (2.0, "2."),
        (-0.0, "0."),
        (1e-6, "0.000001"),
        (3, "3"),
        (Word("AREA"), ".AREA."),
        (Word(""), "*"),
        (Typed("IfcLabel", "a'b"), "IFCLABEL('a''b')"),
        ((Ref(1), Ref(2)), "(#1,#2)"),
        ("Büro", r"'B\X2\00FC\X0\ro'"),
        ("a\\b", r"'a\\b'"),
    ],
)
def test_values_of_a_step_file(value: Any, text: str) -> None:
    assert step_value(value) == text


def test_a_value_without_a_form_is_refused() -> None:
    with pytest.raises(TypeError, match="object has no form"):
        step_value(object())


def test_identifiers_depend_on_names_only() -> None:
    assert global_id("a", "b") == global_id("a", "b") != global_id("ab")
    assert len(global_id("x")) == 22
    assert global_id("x")[0] in "0123"


def test_same_bytes_whatever_order_sets_have() -> None:
    code = "from tests.factories import small_flat; from floorplan_core.exporters.ifc import ifc_text\n"
    code += "from zlib import crc32; print(crc32(ifc_text(small_flat()).encode()))"
    assert len(printed(code)) == 1


def test_a_plan_without_rooms_is_an_empty_storey() -> None:
    model = read(replace(small_flat(), regions=(), doors=()))
    assert len(model.by_type("IfcBuildingStorey")) == 1
    assert not model.by_type("IfcElement")
