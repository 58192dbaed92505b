"""Where no plan can be made the reason stays to be read: in the plan's pane and first among the warnings."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from pytestqt.qtbot import QtBot

from floorcast_app.panels.warnings_panel import WarningsPanel
from floorcast_app.viewports.floor_plan_view import FloorPlanView
from floorcast_app.workbench import Workbench
from tests.app.pump import settle


def test_a_reason_stays_until_something_else_is_opened(
    workbench: Workbench, qtbot: QtBot, tmp_path: Path
) -> None:
    pane, warnings = FloorPlanView(workbench), WarningsPanel(workbench)
    for widget in (pane, warnings):
        qtbot.addWidget(widget)
    empty = pane.picture(400, 300)
    ball = np.random.default_rng(1).normal(size=(4000, 3))
    np.savetxt(tmp_path / "ball.xyz", 4 * ball / np.linalg.norm(ball, axis=1)[:, None], fmt="%.4f")

    workbench.open_survey(tmp_path / "ball.xyz")
    settle(workbench)
    assert workbench.plan is None
    assert workbench.failure == workbench.ui.told[-1][1]  # type: ignore[attr-defined]
    qtbot.waitUntil(lambda: warnings.list.count() > 0 and warnings.list.item(0).text() == workbench.failure)
    assert pane.picture(400, 300) != empty

    workbench.close_survey()
    assert workbench.failure == ""
    assert pane.picture(400, 300) == empty
