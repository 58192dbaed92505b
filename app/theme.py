"""The look of the application: colours, style sheet, palette and font, in a light and a dark version."""

from __future__ import annotations

from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

from floorcast_app.colours import THEMES, Colours
from floorcast_app.events import Event

if TYPE_CHECKING:
    from PySide6.QtGui import QFont, QPalette
    from PySide6.QtWidgets import QApplication

FONT_FAMILY = "Inter"
FONT_PIXELS = 13


_name = "light"
changed = Event()  # (name) another theme holds


def name() -> str:
    """The present theme, "light" or "dark"."""
    return _name


def colours(theme: str | None = None) -> Colours:
    """The colours of ``theme``; of the present one where none is named."""
    return THEMES[theme or _name]


def resource(*parts: str) -> Path:
    """A file of the resources folder."""
    return Path(str(files("floorcast_resources").joinpath(*parts)))


def stylesheet(theme: str) -> str:
    """The style sheet with the colours of ``theme`` filled in."""
    template = Template(resource("style", "floorcast.qss").read_text(encoding="utf-8"))
    return template.substitute(asdict(colours(theme)), style=resource("style").as_posix())


def apply_theme(app: QApplication, theme: str) -> None:
    """Give the application the look ``theme`` and tell the listeners of :data:`changed`."""
    if not app.styleSheet():  # once: each of these makes every widget look anew
        app.setStyle("Fusion")
        app.setFont(font())
    begin(app, theme)
    app.setStyleSheet(stylesheet(_name))
    changed.emit(_name)


def begin(app: QApplication, theme: str) -> None:
    """The colours and the palette only: whoever calls brings the style sheet to the widgets and tells."""
    global _name
    _name = theme if theme in THEMES else "light"
    app.setPalette(_palette(colours()))


def font(pixels: int = FONT_PIXELS, weight: int = 400, figures: bool = False) -> QFont:
    """The bundled font.

    :param figures: of equal width, so that numbers stand under each other. Hyphens and spaces are as wide
        then: it is not for words.
    """
    from PySide6.QtGui import QFont

    _load_fonts()
    made = QFont(FONT_FAMILY)
    made.setPixelSize(pixels)
    made.setWeight(QFont.Weight(weight))
    if figures:
        made.setFeature(QFont.Tag("tnum"), 1)
    return made


def _load_fonts() -> None:
    from PySide6.QtGui import QFontDatabase

    if QFontDatabase.hasFamily(FONT_FAMILY):  # asked for every text that is drawn
        return
    for path in sorted(resource("fonts").glob("*.ttf")):
        QFontDatabase.addApplicationFont(str(path))


def _palette(holds: Colours) -> QPalette:
    """What is drawn without the style sheet follows the same colours."""
    from PySide6.QtGui import QColor, QPalette

    role = QPalette.ColorRole
    table = {
        role.Window: holds.window,
        role.WindowText: holds.text,
        role.Base: holds.panel,
        role.AlternateBase: holds.stripe,
        role.Text: holds.text,
        role.PlaceholderText: holds.faint,
        role.Button: holds.panel,
        role.ButtonText: holds.text,
        role.Highlight: holds.accent,
        role.HighlightedText: holds.on_accent,
        role.ToolTipBase: holds.tip,
        role.ToolTipText: holds.tip_text,
        role.Link: holds.accent,
        role.Mid: holds.line,
        role.Dark: holds.line_strong,
    }
    palette = QPalette()
    for part, colour in table.items():
        palette.setColor(part, QColor(colour))
    for part in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(QPalette.ColorGroup.Disabled, part, QColor(holds.faint))
    return palette
