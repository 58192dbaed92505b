"""Icons by name from resources/icons (Lucide), tinted with the theme's text colour."""

from __future__ import annotations

import weakref
from functools import lru_cache
from typing import Any

from PySide6.QtCore import QByteArray, QRectF, QSize, Qt
from PySide6.QtGui import QGuiApplication, QIcon, QPainter, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QPushButton, QToolButton

from floorcast_app import theme

SIZES = (16, 20, 24, 32, 48)  # pixels: what menus, buttons and big buttons ask for, also at twice the density
BUTTON, GAP = 16, 6  # pixels: icon of a button with words, and what it keeps from them

_targets: weakref.WeakKeyDictionary[Any, tuple[str, str]] = weakref.WeakKeyDictionary()


def exists(name: str) -> bool:
    """True where resources/icons has the icon."""
    return bool(name) and bool(_svg(name))


def icon(name: str, colour: str = "") -> QIcon:
    """The icon in the theme's text colour, or in ``colour`` ("#rrggbb"); an empty one where there is none."""
    return _icon(name, colour or theme.colours().text, theme.colours().faint)


def pixmap(name: str, size: int, colour: str = "") -> QPixmap:
    """The icon as a picture of ``size`` x ``size`` pixels, as fine as the finest screen."""
    ratio = finest_ratio()
    made = QPixmap(_drawn(name, round(size * ratio), colour or theme.colours().text))
    made.setDevicePixelRatio(ratio)
    return made


def set_icon(target: Any, name: str, colour_role: str = "text") -> None:
    """``target.setIcon`` now, and again whenever the theme changes. ``colour_role``: a field of Colours."""
    _targets[target] = (name, colour_role)
    if _beside_text(target):
        target.setIconSize(QSize(BUTTON + GAP, BUTTON))
    target.setIcon(_for(target, name, colour_role))


def _for(target: Any, name: str, colour_role: str) -> QIcon:
    gap = GAP if _beside_text(target) else 0
    return _icon(name, getattr(theme.colours(), colour_role), theme.colours().faint, gap)


def _beside_text(target: Any) -> bool:
    """True for buttons with words: styled ones leave no distance between icon and text of their own."""
    if isinstance(target, QToolButton):
        return target.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon
    return isinstance(target, QPushButton) and bool(target.text())


@lru_cache(maxsize=512)
def _icon(name: str, colour: str, faint: str, gap: int = 0) -> QIcon:
    made = QIcon()
    if not exists(name):
        return made
    for size in SIZES:
        for inked, mode in ((colour, QIcon.Mode.Normal), (faint, QIcon.Mode.Disabled)):
            made.addPixmap(_padded(_drawn(name, size, inked), gap * size // BUTTON), mode)
    return made


def finest_ratio() -> float:
    """Device pixels for a pixel, on the screen that has most of them."""
    app = QGuiApplication.instance()
    return app.devicePixelRatio() if isinstance(app, QGuiApplication) else 1.0


@lru_cache(maxsize=512)
def _svg(name: str) -> str:
    """The text of the icon; "" where there is none."""
    path = theme.resource("icons", f"{name}.svg")
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def _padded(picture: QPixmap, gap: int) -> QPixmap:
    """``picture`` with ``gap`` empty pixels at its right."""
    if not gap:
        return picture
    wide = QPixmap(picture.width() + gap, picture.height())
    wide.fill(Qt.GlobalColor.transparent)
    painter = QPainter(wide)
    painter.drawPixmap(0, 0, picture)
    painter.end()
    return wide


@lru_cache(maxsize=1024)
def _drawn(name: str, size: int, colour: str) -> QPixmap:
    picture = QPixmap(size, size)
    picture.fill(Qt.GlobalColor.transparent)
    if exists(name):
        svg = _svg(name).replace("currentColor", colour).replace('stroke-width="2"', 'stroke-width="1.75"')
        painter = QPainter(picture)
        QSvgRenderer(QByteArray(svg.encode())).render(painter, QRectF(0, 0, size, size))
        painter.end()
    return picture


def _retint(_name: str) -> None:
    for target, (name, role) in list(_targets.items()):
        try:
            target.setIcon(_for(target, name, role))
        except RuntimeError:  # Qt has deleted the widget; Python has not yet
            _targets.pop(target, None)


theme.changed.connect(_retint)
