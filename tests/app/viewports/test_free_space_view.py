"""Figure (b) in the window: tones of the cells, and the slider for the height of the slice."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest

from floorcast_app import theme
from floorcast_app.viewports.free_space_view import FreeSpaceView
from floorplan_core.model import FREE, OCCUPIED
from tests.app.plan_panes import opened


@pytest.mark.parametrize(("state", "tone"), [(FREE, "free"), (OCCUPIED, "occupied")])
def test_cells_have_the_tone_of_their_state(qtbot, drawn, state, tone):
    """The middles of the cells of that state, off the outlines that are drawn over them."""
    pane = opened(qtbot, FreeSpaceView(drawn))
    drawn.view.set(span=10.0, layers=frozenset({"free_space"}))
    image, grid = pane.picture(900, 900), drawn.plan.grid
    x0, y0, x1, y1 = drawn.view.look.centre[0] - 3, drawn.view.look.centre[1] - 3, 0, 0
    x1, y1 = x0 + 6, y0 + 6
    iy, ix = np.nonzero(grid.states == state)
    xy = grid.origin + (np.stack([ix, iy], axis=1) + 0.5) * grid.cell
    xy = xy[(xy > (x0, y0)).all(axis=1) & (xy < (x1, y1)).all(axis=1)]
    outlines = shapely.union_all([r.polygon.boundary for r in drawn.plan.regions])
    xy = [p for p in xy if outlines.distance(shapely.Point(p)) > 0.03]
    pixels = [(450 + (x - x0 - 3) * 90, 450 - (y - y0 - 3) * 90) for x, y in xy]
    colours = [QColor(image.pixel(int(px), int(py))).name() for px, py in pixels]
    assert len(colours) > 20
    assert np.mean([c == getattr(theme.colours(), tone) for c in colours]) > 0.95


def test_the_slider_sets_the_height_once_it_rests(qtbot, drawn):
    pane = opened(qtbot, FreeSpaceView(drawn))
    slider = pane.height_slider.slider
    assert slider.value() == round(drawn.plan.grid.slice_height * 100)
    for value in (slider.value() - 20, slider.value() - 30):
        slider.setValue(value)
    assert drawn.state.config.occupancy.slice_height is None
    wanted = slider.value() / 100
    qtbot.waitUntil(lambda: drawn.state.config.occupancy.slice_height == wanted)
    assert len(drawn.document.history) == 2
    assert wanted < drawn.plan.grid.slice_height
    pane.height_slider.auto.click()
    assert drawn.state.config.occupancy.slice_height is None
    QTest.keyClick(slider, Qt.Key.Key_Up)
    qtbot.waitUntil(lambda: drawn.state.config.occupancy.slice_height == pytest.approx(wanted + 0.01))


def test_the_slider_gives_way_in_small_panes(qtbot, drawn):
    pane = opened(qtbot, FreeSpaceView(drawn), 400, 200)
    assert not pane.height_slider.isVisible()
    pane.resize(400, 500)
    assert pane.height_slider.isVisible()


def test_the_legend_stands_in_a_column_where_a_row_would_hide_the_plan(qtbot, drawn):
    """In a low, wide pane that the plan fills from top to bottom the rooms keep their tones."""
    pane = opened(qtbot, FreeSpaceView(drawn))
    x0, y0, x1, y1 = shapely.union_all([r.polygon for r in drawn.plan.regions]).bounds
    drawn.view.set(centre=((x0 + x1) / 2, (y0 + y1) / 2), span=y1 - y0, layers=frozenset({"free_space"}))
    tall = 240
    wide = round(tall * (x1 - x0) / (y1 - y0)) + 320  # 160 pixels beside the plan at either side
    with_legend = pane.picture(wide, tall, scale_bar=False)
    scale = tall / (y1 - y0)
    rooms = shapely.union_all([r.polygon for r in drawn.plan.regions])
    under = [
        QColor(with_legend.pixel(px, py)).name()
        for py in range(12, 32, 4)
        for px in range(12, wide - 70, 4)
        if rooms.contains(
            shapely.Point((x0 + x1) / 2 + (px - wide / 2) / scale, (y0 + y1) / 2 - (py - tall / 2) / scale)
        )
    ]
    assert len(under) > 20
    assert np.mean([name == theme.colours().free for name in under]) > 0.5
    assert QColor(with_legend.pixel(14, 14 + 60)).name() != theme.colours().unobserved
