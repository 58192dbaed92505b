"""What README says to type in Python runs as it stands."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import floorplan_core as fc
from tests.box_world import room, stations, survey
from tests.readers.reader_clouds import write_ply, xyz_columns

README = Path(__file__).resolve().parents[1] / "README.md"


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
    (code,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    exec(code, names)
    assert re.fullmatch(r"1 room (19|20)\.\d\d m2 \d+% predicted\n", capsys.readouterr().out)
    plan = names["plan"]
    assert isinstance(plan, fc.FloorPlan) and len(plan.regions) == 1
    np.testing.assert_allclose(names["T_map_sensor"], pose, atol=0.02)  # it did not drift


def test_surveys_are_opened_with_all_readers(tmp_path: Path) -> None:
    laspy = pytest.importorskip("laspy")
    cloud = survey(room(4.0, 5.0), stations(4.0, 5.0)).points
    data = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
    data.header.scales = np.full(3, 1e-4)
    data.x, data.y, data.z = cloud.T
    data.write(str(tmp_path / "room.laz"))
    assert fc.open_survey(tmp_path / "room.laz").point_count == len(cloud)
