"""Random actions in a row: the document stays consistent; undoing all gives the first state.

For more of them: ``FLOORCAST_ACTIONS=500 FLOORCAST_SEEDS=1,2,3 pytest tests/app/test_random_actions.py``.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from floorcast_app.workbench import Workbench
from floorplan_core.errors import UsageError
from floorplan_core.model.corrections import MovePlane, PlaneAt
from tests.app.pump import make_workbench, settle
from tests.app.random_actions import play
from tests.app.surveys import write_campus, write_storeys, write_wing
from tests.plan_invariants import assert_valid

SEEDS = [int(seed) for seed in os.environ.get("FLOORCAST_SEEDS", "20240607").split(",")]
WORLDS: dict[str, Callable[[Path], Path]] = {
    "wing": write_wing,
    "storeys": write_storeys,
    "campus": write_campus,
}


def _count(usual: int) -> int:
    return int(os.environ.get("FLOORCAST_ACTIONS", usual))


@pytest.mark.parametrize("seed", SEEDS)
def test_random_actions(sample_workbench: Workbench, seed: int) -> None:
    play(sample_workbench, seed, _count(500))


@pytest.fixture(scope="module", params=list(WORLDS))
def elsewhere(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Workbench:
    """A workbench with a survey that is more than one building of right angles."""
    bench = make_workbench()
    bench.open_survey(WORLDS[request.param](tmp_path_factory.mktemp(request.param)))
    settle(bench)
    assert bench.plan is not None, bench.ui.told
    return bench


@pytest.mark.parametrize("seed", SEEDS)
def test_random_actions_elsewhere(elsewhere: Workbench, seed: int) -> None:
    assert len(elsewhere.storeys) == 2 or len(elsewhere.plan.wings) == 1
    play(elsewhere, seed, _count(60))


@pytest.mark.parametrize("position", [-1, 999])
def test_history_has_ends(sample_workbench: Workbench, position: int) -> None:
    with pytest.raises(UsageError, match="no step"):
        sample_workbench.run("edit.history", position=position)


def test_a_wall_moved_far_into_rooms_leaves_them_whole(sample_workbench: Workbench) -> None:
    """Both sides of a wall that ends in the open go to where it was put, and left a slit of no width."""
    at, to = (6.611180, 2.865333), (7.570131, 0.658936)
    wall = MovePlane(PlaneAt(at, (-0.398603, 0.917124)), to)
    before = sample_workbench.plan.regions
    sample_workbench.change("Move a wall", corrections=(wall,))
    settle(sample_workbench)
    assert_valid(sample_workbench.plan)
    assert len(sample_workbench.plan.regions) > len(before)
    sample_workbench.run("edit.undo")
    settle(sample_workbench)
