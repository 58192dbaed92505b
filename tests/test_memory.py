"""Memory that is short: plans made in less of it are the same, and none is begun that cannot be ended."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import floorplan_core as fc
from floorplan_core import memory
from floorplan_core.cli.main import run
from floorplan_core.errors import NoPlanError
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.geometry.columns import strips
from floorplan_core.geometry.ray_carving import MissMap
from floorplan_core.memory import free_memory, require_memory
from floorplan_core.stages import layout_planes, voxel_columns

SURVEY = Path(__file__).parents[1] / "resources" / "sample_survey"


def _meminfo(folder: Path, megabytes: float) -> Path:
    path = folder / "meminfo"
    path.write_text(f"MemTotal: 16000000 kB\nMemFree: 1 kB\nMemAvailable: {megabytes * 1e6 / 1024:.0f} kB\n")
    return path


def _group(folder: Path, limit: str, used: int, cached: int) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "memory.max").write_text(f"{limit}\n")
    (folder / "memory.current").write_text(f"{used}\n")
    (folder / "memory.stat").write_text(f"anon 1\nactive_file {cached}\ninactive_file 0\n")


def test_a_plan_made_on_disk_is_the_same_plan():
    survey = fc.open_survey(SURVEY)
    usual, small = fc.Config(), fc.Config().with_values({"voxels.memory": "4"})
    inside = fc.process(survey, usual)
    planner = fc.FloorPlanner(small, source=survey.name, local_frame=survey.local_frame)
    for chunk in survey.chunks():
        planner.integrate_chunk(chunk, survey.trajectory)
    outside = planner.plan()
    assert planner.map.surfels.on_disk
    assert geojson_text(inside) == geojson_text(outside)


def test_what_is_free_is_what_the_groups_leave(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "_MEMINFO", _meminfo(tmp_path, 8000))
    monkeypatch.setattr(memory, "_TREE", tmp_path / "cgroup")
    (tmp_path / "self").write_text("0::/box/job\n")
    monkeypatch.setattr(memory, "_GROUPS", tmp_path / "self")
    assert free_memory() == pytest.approx(8e9, rel=1e-6)
    _group(tmp_path / "cgroup/box/job", "max", 5, 0)
    assert free_memory() == pytest.approx(8e9, rel=1e-6)
    _group(tmp_path / "cgroup/box", "2000000000", 1_500_000_000, 400_000_000)
    assert free_memory() == 900e6  # of 2 GB 1.5 are used, of which 0.4 can be dropped
    _group(tmp_path / "cgroup/box/job", "1000000000", 700_000_000, 0)
    assert free_memory() == 300e6


def test_groups_of_the_first_version(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "_MEMINFO", _meminfo(tmp_path, 8000))
    monkeypatch.setattr(memory, "_TREE", tmp_path)
    monkeypatch.setattr(memory, "_GROUPS", tmp_path / "none")
    (tmp_path / "memory").mkdir()
    (tmp_path / "memory/memory.limit_in_bytes").write_text("3000000000\n")
    (tmp_path / "memory/memory.usage_in_bytes").write_text("2900000000\n")
    (tmp_path / "memory/memory.stat").write_text("total_active_file 50000000\ntotal_inactive_file 0\n")
    assert free_memory() == 150e6


def test_a_system_that_does_not_say_is_trusted(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "_MEMINFO", tmp_path / "none")
    assert free_memory() is None
    require_memory(1e15, "Anything")


def test_too_little_memory_is_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "_MEMINFO", _meminfo(tmp_path, 100))
    require_memory(30e6, "A small plan")
    with pytest.raises(NoPlanError, match=r"A plan takes about 50 MB more .*100 MB are free.*voxels\.size"):
        require_memory(50e6, "A plan")


def test_a_plan_for_which_there_is_no_memory_is_not_begun(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(memory, "_MEMINFO", _meminfo(tmp_path, 66))
    assert run(["plan", str(SURVEY), "--out", str(tmp_path / "plan")]) == 4
    said = capsys.readouterr().err
    assert "more memory, and 66 MB are free" in " ".join(said.split())
    assert not (tmp_path / "plan").exists()


def test_ray_counts_that_outgrow_their_room_are_the_same_on_disk():
    rng = np.random.default_rng(2)
    points, scan = rng.uniform(-20, 20, (4000, 3)) * [1, 1, 0.05], np.zeros(4000, dtype=np.int32)
    inside, outside = MissMap(0.1), MissMap(0.1, room=2e6)
    found = []
    for misses in (inside, outside):
        for part in np.array_split(np.arange(4000), 5):
            misses.carve(points[part], scan[part], np.zeros((1, 3)), (0.05, 30.0))
        misses.pack()
        found.append(
            misses.column_bits(np.eye(3), np.array([-20.0, -20.0]), 0.1, (400, 400), -1.0, 20, (1, 4))
        )
    assert isinstance(inside._pool.base, type(None))
    assert outside._pool.base is not None  # a file, mapped
    assert inside.blocks > 500
    assert np.array_equal(found[0], found[1])


@pytest.mark.parametrize("viewpoints", [True, False])
def test_a_plan_made_strip_by_strip_is_the_same_plan(monkeypatch, viewpoints):
    survey = fc.open_survey(SURVEY)
    survey = survey if viewpoints else replace(survey, trajectory=None)
    whole = fc.process(survey)
    monkeypatch.setattr(strips, "__defaults__", (5000,))
    monkeypatch.setattr(layout_planes, "_MANY_PROFILES", 0.0)
    monkeypatch.setattr(voxel_columns, "_TWICE", 0)
    parts = fc.process(survey)
    assert len(strips(*parts.grid.states.shape)) > 5
    assert geojson_text(whole) == geojson_text(parts)
    assert np.array_equal(whole.grid.states, parts.grid.states)
    assert np.array_equal(whole.wall_points.facing, parts.wall_points.facing)
    same = zip(whole.planes, parts.planes, strict=True)
    assert all(
        np.array_equal(a.profile.through, b.profile.through) for a, b in same if a.profile and b.profile
    )
