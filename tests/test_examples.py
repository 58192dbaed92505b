"""The scripts in docs/examples run as they stand."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import shapely

import floorplan_core as fc
from tests.factories import DoorSpec, RoomSpec, make_plan

SCRIPT = Path(__file__).resolve().parents[1] / "docs" / "examples" / "plan_a_path.py"
START = (1.0, 1.0)


@pytest.fixture(scope="module")
def example() -> ModuleType:
    module = ModuleType("plan_a_path")
    sys.modules["plan_a_path"] = module  # its dataclass looks there
    exec(compile(SCRIPT.read_text(encoding="utf-8"), SCRIPT, "exec"), module.__dict__)
    return module


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A seen room, a room behind a door of which nothing was seen, and one with a door too narrow."""
    rooms = [
        RoomSpec((0.0, 0.0, 4.0, 4.0), name="1"),
        RoomSpec((4.15, 0.0, 8.0, 4.0), name="2", seen=0.05),
        RoomSpec((0.0, 4.15, 4.0, 8.0), name="3"),
    ]
    doors = [DoorSpec(0, 4.075, 1.5, 2.5, joins=(0, 1)), DoorSpec(1, 4.075, 1.0, 1.2, joins=(0, 2))]
    plan = make_plan(rooms, doors, yaw_deg=0.0)
    out = tmp_path_factory.mktemp("plan")
    fc.export(plan, *(out / name for name in ("plan.geojson", "map.yaml", "map.predicted.yaml")))
    return out


def test_a_way_leads_through_a_door_into_a_predicted_room(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "path.geojson"
    command = [sys.executable, SCRIPT, folder, "--from", "1", "1", "--to", "2", "--out", out]
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=True)
    (feature,) = json.loads(out.read_text())["features"]
    line, about = shapely.LineString(feature["geometry"]["coordinates"]), feature["properties"]
    assert f"{about['length_m']} m" in done.stdout
    assert np.hypot(*np.subtract(line.coords[0], START)) < 0.1
    features = json.loads((folder / "plan.geojson").read_text())["features"]
    shapes = {f["id"]: (f["properties"], shapely.geometry.shape(f["geometry"])) for f in features}
    (room,) = (shape for p, shape in shapes.values() if p.get("name") == "2")
    assert room.contains(shapely.Point(line.coords[-1]))
    (door,) = (s for p, s in shapes.values() if p["kind"] == "door" and p["width_m"] > 0.5)
    assert line.crosses(door) and line.length == pytest.approx(about["length_m"], abs=0.02)
    assert 1.0 < about["predicted_m"] < about["length_m"] - 2.0
    assert room.distance(shapely.Point(about["first_predicted"])) < 0.3


def test_what_does_not_lead_anywhere_is_said(example: ModuleType, folder: Path) -> None:
    with pytest.raises(SystemExit, match=r"region 3 for a robot of 0\.2 m; its doors \(m\): \[0\.2\]"):
        example.plan_path(folder, START, "3")
    with pytest.raises(SystemExit, match="no region '9'; the regions are 1, 2, 3"):
        example.plan_path(folder, START, "9")
    with pytest.raises(SystemExit, match="smaller --radius"):
        example.plan_path(folder, START, "2", radius=3.0)


def test_the_maps_lie_where_the_rooms_lie(example: ModuleType, folder: Path) -> None:
    seen, predicted = (example.load_map(folder / f"map{kind}.yaml") for kind in ("", ".predicted"))
    for place, of_seen in ((START, example.FREE), ((7.0, 1.0), example.UNKNOWN)):
        assert seen.cells[seen.cell(place)] == of_seen
        assert predicted.cells[predicted.cell(place)] == example.FREE
        np.testing.assert_allclose(predicted.world(np.array([predicted.cell(place)]))[0], place, atol=0.051)


@pytest.mark.parametrize(("weight", "through"), [(0.0, True), (5.0, False)])
def test_doubt_is_worth_a_detour(example: ModuleType, weight: float, through: bool) -> None:
    seen = np.full((9, 21), example.FREE)
    seen[:6, 10] = example.UNKNOWN  # straight on is predicted, around is not
    seen[0], seen[:, 0] = example.OCCUPIED, example.OCCUPIED
    free = np.where(seen == example.OCCUPIED, example.OCCUPIED, example.FREE)
    maps = [example.Map(cells, 0.1, np.zeros(2)) for cells in (seen, free)]
    cost = example.costs(*maps, [], 0.1, weight)
    path = example.find_path(cost, (3, 2), (3, 18))
    assert (max(y for y, _ in path) < 6) is through
    assert path[0] == (3, 2) and path[-1] == (3, 18)
