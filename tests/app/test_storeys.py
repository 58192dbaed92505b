"""Several storeys: each is planned when it is shown, and keeps its own corrections, also in the project."""

from __future__ import annotations

from pathlib import Path

import pytest

from floorcast_app.state import Check, DocumentState, StoreyEdits
from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from floorplan_core.model.corrections import NameRegion
from tests.app.pump import make_workbench, settle
from tests.app.surveys import write_storeys


@pytest.fixture(scope="module")
def stack(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a survey of two storeys."""
    return write_storeys(tmp_path_factory.mktemp("stack"))


@pytest.fixture
def bench(stack) -> Workbench:
    made = make_workbench()
    made.open_survey(stack)
    settle(made)
    assert made.plan is not None, made.ui.told
    return made


def test_a_storey_is_planned_when_it_is_shown(bench):
    assert [s.number for s in bench.storeys] == [0, 1]
    assert bench.plan.regions[0].area == pytest.approx(20, abs=0.2)
    bench.run("plan.storey_up")
    settle(bench)
    assert (bench.state.storey, bench.plan.storey) == (1, 1)
    assert bench.plan.regions[0].area == pytest.approx(18, abs=0.2)
    with pytest.raises(UsageError, match="not possible now"):
        bench.run("plan.storey_up")
    with pytest.raises(UsageError, match=r"storey 2; the survey has storeys 0 to 1"):
        bench.run("plan.storey", number=2)
    bench.document.undo()
    settle(bench)
    assert bench.plan.storey == 0


def test_corrections_stay_with_their_storey(bench, tmp_path):
    bench.run("correct.rename", region=bench.plan.regions[0].id, name="Shop")
    settle(bench)
    bench.run("plan.storey", number=1)
    settle(bench)
    assert bench.state.corrections == ()
    assert bench.plan.regions[0].name != "Shop"
    bench.run("correct.rename", region=bench.plan.regions[0].id, name="Flat")
    settle(bench)
    bench.save_project(tmp_path / "house.floorcast")
    again = make_workbench()
    again.open_project(tmp_path / "house.floorcast")
    settle(again)
    assert again.state.on_storey(0).corrections == bench.state.on_storey(0).corrections != ()
    assert again.state.elsewhere == bench.state.elsewhere
    assert again.plan.regions[0].name == "Flat"
    again.run("plan.storey_down")
    settle(again)
    assert again.plan.regions[0].name == "Shop"


def test_storeys_that_say_nothing_are_not_kept():
    state = DocumentState(corrections=(NameRegion((0, 0), "a"),), checks=(Check("c1", (0, 0), (1, 0)),))
    up = state.on_storey(1)
    assert (up.storey, up.corrections, up.checks) == (1, (), ())
    assert up.elsewhere == (StoreyEdits(0, state.corrections, state.checks),)
    assert up.on_storey(2).elsewhere == up.elsewhere
    assert up.on_storey(2).on_storey(0) == state


def test_the_chooser_is_there_where_it_is_needed(qtbot, bench, sample_workbench):
    from PySide6.QtCore import Qt

    from floorcast_app.panels.storey_chooser import StoreyChooser

    chooser = StoreyChooser(bench)
    qtbot.addWidget(chooser)
    assert chooser.wanted
    assert [chooser.itemData(k) for k in range(chooser.count())] == [1, 0]
    assert chooser.currentData() == 0
    chooser.show()
    qtbot.keyClick(chooser, Qt.Key.Key_Up)
    settle(bench)
    assert bench.plan.storey == 1
    alone = StoreyChooser(sample_workbench)
    qtbot.addWidget(alone)
    assert not alone.wanted


def test_the_storey_that_is_shown_is_replayed(bench, qtbot):
    from floorcast_app.panels.timeline_panel import TimelinePanel

    panel = TimelinePanel(bench)
    qtbot.addWidget(panel)
    every = bench.session.reconstruction.trajectory.stamps[-1] / 4
    bench.run("plan.storey", number=1)
    settle(bench)
    whole = bench.plan
    bench.run("plan.replay", every=every)
    settle(bench)
    upper = bench.timeline
    assert upper[0].plan is None, "the run begins on the storey below"
    assert upper[-1].plan is not None and upper[-1].plan.storey == 1
    assert upper[-1].plan.regions[0].area == pytest.approx(18, abs=0.5)
    panel.refresh()
    panel.show_moment(len(upper) - 1)
    assert bench.plan is upper[-1].plan
    bench.run("plan.storey", number=0)
    assert bench.timeline == [], "that storey was not replayed"
    panel.refresh()
    assert panel.at == -1
    settle(bench)
    bench.run("plan.replay", every=every)
    settle(bench)
    lower = bench.timeline
    assert lower[0].plan.regions[0].area == pytest.approx(20, abs=0.5)
    assert {s.plan.storey for s in lower} == {0}
    bench.run("plan.storey", number=1)
    settle(bench)
    assert bench.timeline is upper and bench.plan.regions[0].area == whole.regions[0].area
    bench.close_survey()
    assert bench.timeline == []


def test_a_replay_stops_where_another_storey_is_asked_for(bench):
    bench.run("plan.replay", every=bench.session.reconstruction.trajectory.stamps[-1] / 4)
    bench.run("plan.storey", number=1)
    settle(bench)
    assert (bench.plan.storey, bench.timeline) == (1, [])
