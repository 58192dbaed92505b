"""What README says to type in Python runs as it stands."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import floorplan_core as fc
from tests.box_world import room, stations, survey
from tests.factories import small_flat
from tests.readers.reader_clouds import write_ply, xyz_columns

README = Path(__file__).resolve().parents[1] / "README.md"


def python_parts(page: Path) -> list[str]:
    """The code to type on a page."""
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def test_the_example_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scans = survey(room(4.0, 5.0), stations(4.0, 5.0))
    write_ply(tmp_path / "survey.ply", "binary_little_endian", xyz_columns(scans.points))
    monkeypatch.chdir(tmp_path)
    pose = scans.poses[0]
    names = {
        "points": (scans.points - pose[:3, 3]) @ pose[:3, :3],  # as if one scan had seen it all
        "T_world_sensor": pose,
        "T_odom_sensor": pose,
    }
    for code in python_parts(README):
        exec(code, names)
    assert re.fullmatch(r"1 room (19|20)\.\d\d m2 \d+% predicted\n", capsys.readouterr().out)
    plan = names["plan"]
    assert isinstance(plan, fc.FloorPlan) and len(plan.regions) == 1
    np.testing.assert_allclose(names["T_map_sensor"], pose, atol=0.02)  # it did not drift
    assert (names["states"] == 1).sum() * plan.grid.cell**2 == pytest.approx(20.0, abs=1.5)
    assert (tmp_path / "plan.geojson").exists() and names["features"][0]["properties"]["kind"] == "region"


def test_the_run_from_a_script_runs() -> None:
    scans = survey(room(4.0, 5.0), stations(4.0, 5.0))
    own = [(scans.points[scans.scan_id == row], T) for row, T in enumerate(scans.poses)]
    names: dict[str, object] = {
        "scans": [(float(k), (p - T[:3, 3]) @ T[:3, :3], T) for k, (p, T) in enumerate(own)],
        "time_for_a_plan": lambda stamp: True,
    }
    (code,) = python_parts(README.parent / "docs" / "robots.md")
    exec(code, names)
    plan = names["plan"]
    assert isinstance(plan, fc.FloorPlan) and plan.regions[0].area == pytest.approx(20.0, abs=0.02)
    config = fc.Config(input={"min_range": 0.4})  # type: ignore[arg-type]  # as that page says
    assert config.input.min_range == 0.4


def test_surveys_are_opened_with_all_readers(tmp_path: Path) -> None:
    laspy = pytest.importorskip("laspy")
    cloud = survey(room(4.0, 5.0), stations(4.0, 5.0)).points
    data = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
    data.header.scales = np.full(3, 1e-4)
    data.x, data.y, data.z = cloud.T
    data.write(str(tmp_path / "room.laz"))
    assert fc.open_survey(tmp_path / "room.laz").point_count == len(cloud)


def test_a_warm_planner_takes_scans_without_waiting_for_kernels() -> None:
    """In a process of its own: kernels of other tests are loaded here already."""
    code = (
        "import floorplan_core as fc, numpy as np\n"
        "from tests.box_world import LINTEL, stations, survey, two_rooms\n"
        "from floorplan_core.kernel_times import kernel_seconds, time_kernels\n"
        "fc.warm_up()\n"
        "time_kernels()\n"
        "places = [*stations(4, 5), *stations(4, 5, 4.1)]\n"
        "scans = survey(two_rooms((2.0, 2.9, LINTEL)), places, rays=(160, 50))\n"
        "for planner in (fc.FloorPlanner(), fc.CorrectingPlanner()):\n"
        "    for row, pose in enumerate(scans.poses):\n"
        "        mine = scans.points[scans.scan_id == row]\n"
        "        planner.integrate((mine - pose[:3, 3]) @ pose[:3, :3], pose)\n"
        "print(kernel_seconds() == 0.0)\n"
    )
    root = Path(__file__).resolve().parents[1]
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=root, check=True)
    assert done.stdout == "True\n"


def test_a_plan_goes_to_files_and_comes_back(tmp_path: Path) -> None:
    plan = small_flat()
    fc.export(plan, tmp_path / "plan.geojson", str(tmp_path / "map.predicted.yaml"))
    assert json.loads((tmp_path / "plan.geojson").read_text()) == fc.plan_to_geojson(plan)
    states, raster = fc.occupancy_map(plan, predicted=True)
    grey = np.asarray(Image.open(tmp_path / "map.predicted.pgm"))[::-1]
    np.testing.assert_array_equal(grey, np.array([205, 254, 0])[states])
    assert raster.shape == states.shape
    with pytest.raises(fc.FloorPlanError, match=r"no exporter for 'plan\.xyz'"):
        fc.export(plan, tmp_path / "new.svg", tmp_path / "plan.xyz")
    assert not (tmp_path / "new.svg").exists()
    with pytest.raises(fc.FloorPlanError, match=r"holds no plan\.floorplan"):
        fc.load_plan(tmp_path)
