"""Lengths of measurements hide neither names nor each other; one that is lit up always shows its length."""

from __future__ import annotations

from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from floorcast_app import theme
from floorcast_app.view_state import Look
from floorcast_app.viewports.plan_camera import Camera
from floorcast_app.viewports.plan_frame import Frame
from floorcast_app.viewports.plan_overlay import paint_check

Ends = tuple[tuple[float, float], tuple[float, float]]


def painted(
    ends: tuple[tuple[float, float], tuple[float, float]], *taken: QRectF, always: bool
) -> QRectF | None:
    look = Look(span=20.0)
    image = QImage(400, 300, QImage.Format.Format_ARGB32_Premultiplied)
    painter = QPainter(image)
    try:
        frame = Frame(Camera.of(look, 400, 300), theme.colours(), look)
        return paint_check(painter, frame, ends, 3.0, theme.colours().accent, taken, always)
    finally:
        painter.end()


def test_a_length_moves_along_its_line_away_from_a_name(qtbot: object) -> None:
    ends = ((-10.0, 0.0), (10.0, 0.0))
    middle = painted(ends, always=False)
    assert middle is not None
    moved = painted(ends, middle, always=False)
    assert moved is not None
    assert not moved.intersects(middle)


def test_a_length_without_a_place_is_left_out_unless_it_is_lit_up(qtbot: object) -> None:
    ends, everything = ((-1.0, 0.0), (1.0, 0.0)), QRectF(0, 0, 400, 300)
    assert painted(ends, everything, always=False) is None
    assert painted(ends, everything, always=True) is not None


def test_a_short_line_has_its_length_above_or_below(qtbot: object) -> None:
    ends = ((-1.0, 0.0), (1.0, 0.0))
    above = painted(ends, always=False)
    assert above is not None
    assert above.center().y() < 150
    below = painted(ends, above, always=False)
    assert below is not None
    assert below.center().y() > 150
