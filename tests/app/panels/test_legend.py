"""The legend has the signs of what the plan has, and no others."""

from __future__ import annotations

from dataclasses import replace

from floorcast_app.panels.legend import entries
from tests.factories import l_corridor, small_flat


def test_a_shut_door_is_there_only_where_one_is() -> None:
    plan = small_flat()
    assert "shut" not in dict(entries(plan))
    shut = replace(plan, doors=tuple(replace(d, shut=True) for d in plan.doors))
    assert "shut" in dict(entries(shut)) and "door" not in dict(entries(shut))


def test_labels_and_guesses_of_the_plan() -> None:
    plan = l_corridor()
    signs = dict(entries(plan))
    assert {"room", "corridor", "wall", "door"} <= set(signs)
    hall = replace(plan, regions=(replace(plan.regions[0], label="hall"), *plan.regions[1:]))
    assert ("other", "hall") in list(entries(hall))
    seen = replace(
        plan,
        regions=tuple(replace(r, free_cells=r.total_cells, sides=()) for r in plan.regions),
    )
    assert {"guessed", "predicted"}.isdisjoint(dict(entries(seen)))
