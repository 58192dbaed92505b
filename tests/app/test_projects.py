"""Projects through the workbench: saved, opened again, and with a survey that moved."""

from __future__ import annotations

import shutil

import pytest

from floorcast_app.state import Check
from floorplan_core.exporters.geojson import geojson_text
from tests.app.pump import SAMPLE, make_workbench, settle


@pytest.fixture
def site(tmp_path):
    """A folder with the bundled survey in it, and a project of an edited plan; what the plan was."""
    survey = tmp_path / "site" / "survey"
    shutil.copytree(SAMPLE, survey)
    bench = make_workbench()
    bench.open_survey(survey)
    settle(bench)
    room = bench.plan.regions[0]
    x0, y0, x1, y1 = room.polygon.bounds
    bench.run("correct.rename", region=room.id, name="Lobby")
    bench.run("correct.add_wall", start=(x0, (y0 + y1) / 2), end=(x1, (y0 + y1) / 2))
    settle(bench)
    bench.change("Add check", checks=(Check("c1", (0.0, 0.0), (1.0, 0.5), 1.118, "sill"),))
    bench.view.set(span=7.5)
    assert bench.document.dirty
    bench.save_project(tmp_path / "site" / "house.floorcast")
    assert not bench.document.dirty
    return tmp_path / "site", geojson_text(bench.plan), bench.state


def test_a_project_opens_as_it_was_saved(site):
    """Plan, corrections, checks and view; nothing to save, nothing to undo."""
    folder, plan, state = site
    bench = make_workbench()
    bench.open_project(folder / "house.floorcast")
    settle(bench)
    assert geojson_text(bench.plan) == plan
    assert bench.state.corrections == state.corrections
    assert bench.state.checks == state.checks
    assert bench.view.look.span == 7.5
    assert not bench.document.dirty
    assert not bench.document.undo_text
    assert bench.ui.told == []


def test_a_survey_that_moved_is_found_again(site, tmp_path):
    """Project and survey apart: it says so; once the survey is found the plan is the one that was saved."""
    folder, plan, state = site
    lost = shutil.move(folder / "survey", tmp_path / "archive")
    bench = make_workbench()
    bench.open_project(folder / "house.floorcast")
    settle(bench)
    assert any("not where it was" in text for _, text in bench.ui.told)
    assert bench.plan is None
    assert bench.state.corrections == state.corrections
    bench.run("file.relocate", path=lost)
    settle(bench)
    names = [r.name for r in bench.plan.regions]
    assert "Lobby" in names
    assert geojson_text(bench.plan).replace('"archive"', '"survey"') == plan


def test_a_survey_that_moved_is_told_once(site, tmp_path):
    """Where a banner asks for it, no toast says the same."""
    folder, _, _ = site
    (folder / "survey").rename(tmp_path / "elsewhere")
    bench, asked = make_workbench(), []
    bench.input_missing.connect(asked.append)
    bench.open_project(folder / "house.floorcast")
    assert asked == [folder / "survey"]
    assert not any("not where it was" in text for _, text in bench.ui.told)
    bench.cancel()
