"""The look: every colour is one, text can be read on its ground, fonts and icons are there."""

from __future__ import annotations

from dataclasses import asdict

import pytest
from PySide6.QtGui import QColor, QFontInfo
from PySide6.QtWidgets import QApplication, QToolButton

from floorcast_app import icons, theme
from floorcast_app.actions import all_actions


def _luminance(colour: str) -> float:
    parts = [v / 255 for v in QColor(colour).getRgb()[:3]]
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def _contrast(a: str, b: str) -> float:
    high, low = sorted((_luminance(a), _luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("name", theme.THEMES)
def test_text_is_readable_on_every_ground(name: str) -> None:
    holds = theme.colours(name)
    assert all(QColor(c).isValid() and len(c) == 7 for c in asdict(holds).values())
    for ground in (
        holds.window,
        holds.panel,
        holds.canvas,
        holds.raised,
        holds.stripe,
        holds.room,
        holds.corridor,
    ):
        assert _contrast(holds.text, ground) >= 4.5, ground  # WCAG AA
    for text in (holds.muted, holds.accent, holds.warning, holds.error):
        assert _contrast(text, holds.panel) >= 4.5, text
    assert _contrast(holds.on_accent, holds.accent) >= 4.5


@pytest.mark.parametrize("name", theme.THEMES)
def test_planes_differ_in_more_than_hue_or_are_told_apart_by_the_colour_blind(name: str) -> None:
    """Red and green as a person without M cones sees them (Viénot 1999) stay far apart."""
    holds = theme.colours(name)

    def deutan(colour: str) -> tuple[float, float]:
        r, g, b = ((v / 255) ** 2.2 for v in QColor(colour).getRgb()[:3])
        return 0.29275 * r + 0.70725 * g, -0.02234 * r + 0.02234 * g + b

    (y1, b1), (y2, b2) = deutan(holds.plane_ns), deutan(holds.plane_ew)
    assert abs(y1 - y2) + abs(b1 - b2) > 0.1


def test_the_style_sheet_is_complete_and_the_font_is_the_bundled_one(qapp: QApplication) -> None:
    for name in theme.THEMES:
        theme.apply_theme(qapp, name)
        assert "$" not in qapp.styleSheet()
        assert theme.name() == name
        assert qapp.palette().window().color() == QColor(theme.colours().window)
    theme.apply_theme(qapp, "light")
    assert QFontInfo(theme.font()).family() == theme.FONT_FAMILY
    assert QFontInfo(theme.font(13, 700)).bold()


def test_figures_have_equal_width(qapp: QApplication) -> None:
    from PySide6.QtGui import QFontMetricsF

    metrics = QFontMetricsF(theme.font(20, figures=True))
    assert len({metrics.horizontalAdvance(figure) for figure in "0123456789"}) == 1


def test_every_action_has_the_icon_that_it_names() -> None:
    missing = [(a.id, a.icon) for a in all_actions() if a.icon and not icons.exists(a.icon)]
    assert missing == []


def test_icons_are_tinted_and_follow_the_theme(qapp: QApplication) -> None:
    def darkest(button: QToolButton) -> int:
        image = button.icon().pixmap(24, 24).toImage()
        pixels = [image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height())]
        return min(p.lightness() for p in pixels if p.alpha() > 200)

    theme.apply_theme(qapp, "light")
    button = QToolButton()
    icons.set_icon(button, "ruler")
    light = darkest(button)
    theme.apply_theme(qapp, "dark")
    assert light < 60 < 180 < darkest(button)
    theme.apply_theme(qapp, "light")
    assert icons.icon("no-such-icon").isNull()


def test_icons_are_as_fine_as_the_screen(qapp: QApplication, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a screen with two device pixels for each pixel they are drawn anew, not enlarged."""
    monkeypatch.setattr(icons, "finest_ratio", lambda: 2.0)
    mark = icons.pixmap("info", 20)
    assert (mark.width(), mark.devicePixelRatio()) == (40, 2.0)
    assert mark.deviceIndependentSize().width() == 20.0
    enlarged = icons._drawn("info", 20, theme.colours().text).scaled(40, 40)
    assert mark.toImage() != enlarged.toImage()
