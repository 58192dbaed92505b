"""What all panels share: their ground, refreshing once for many events, pictures of themselves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from weakref import WeakSet

import shiboken6
from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtGui import QColor, QImage, QPainter
from PySide6.QtWidgets import QDockWidget, QFrame, QHBoxLayout, QLabel, QScrollArea, QVBoxLayout, QWidget

from floorcast_app import theme
from floorcast_app.events import Event
from floorcast_app.view_state import turned_only
from floorcast_app.workbench import Workbench

GRID = 8  # px: all distances are multiples of it
TURN = 12  # ms between two panels that refresh after the same event: what each asks of Qt is done in between


class Panel(QWidget):
    """A pane of controls: listens to the workbench and refreshes itself once, however many events came."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workbench = workbench
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self.refresh)
        _panels.add(self)

    def refresh(self) -> None:
        """Show what holds now."""

    def refresh_soon(self, *told: object) -> None:
        """Refresh when the present burst of events is over, and the panels that were told before have."""
        if not self._soon.isActive() and not turned_only(*told):
            self._soon.start(TURN * len(_waiting()))

    def listen(self, *events: Event, then: Callable[..., None] | None = None) -> None:
        """Call ``then`` (by default :meth:`refresh_soon`) at each event, as long as the widget lives."""
        call = then or self.refresh_soon
        for event in events:
            event.connect(listener_of(self, call, event))

    def picture(self, width: int, height: int) -> QImage:
        """The panel as a picture, ratio 1."""
        return picture_of(self, width, height)


_panels: WeakSet[Panel] = WeakSet()


def _waiting() -> list[Panel]:
    """The panels that will refresh soon."""
    return [panel for panel in _panels if shiboken6.isValid(panel) and panel._soon.isActive()]


def catch_up() -> None:
    """Refresh all panels that would have done so soon: for a script, and for pictures."""
    for panel in _waiting():
        panel._soon.stop()
        panel.refresh()


def listener_of(widget: QWidget, call: Callable[..., None], event: Event) -> Callable[..., None]:
    """``call`` as a listener that takes itself off when Qt has deleted the widget."""

    def listener(*values: Any) -> None:
        if shiboken6.isValid(widget):
            call(*values)
        else:
            event.disconnect(listener)

    return listener


def picture_of(widget: QWidget, width: int, height: int) -> QImage:
    """Any widget as a picture of ``width`` x ``height`` pixels, ratio 1."""
    size = widget.size()
    widget.resize(width, height)
    widget.ensurePolished()
    image = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor(theme.colours().panel))
    painter = QPainter(image)
    widget.render(painter, QPoint(0, 0))
    painter.end()
    widget.resize(size)
    return image


def label(text: str, role: str = "", wrap: bool = False) -> QLabel:
    """A label in one of the style sheet's roles."""
    made = QLabel(text)
    if role:
        made.setProperty("role", role)
    made.setWordWrap(wrap)
    return made


def set_role(widget: QWidget, role: str) -> None:
    """Another role for a widget that is already shown."""
    if widget.property("role") != role:
        widget.setProperty("role", role)
        widget.style().unpolish(widget)
        widget.style().polish(widget)


def retitle(panel: QWidget, title: str) -> None:
    """Another title for the dock that a panel stands in, if it does."""
    dock = panel.parentWidget()
    if isinstance(dock, QDockWidget) and dock.windowTitle() != title:
        dock.setWindowTitle(title)


def rule() -> QFrame:
    """A hairline."""
    made = QFrame()
    made.setProperty("role", "rule")
    return made


def column(parent: QWidget | None = None, margin: int = 2 * GRID, gap: int = GRID) -> QVBoxLayout:
    """Things below each other."""
    made = QVBoxLayout(parent) if parent is not None else QVBoxLayout()
    made.setContentsMargins(margin, margin, margin, margin)
    made.setSpacing(gap)
    return made


def row(*widgets: QWidget, gap: int = GRID) -> QHBoxLayout:
    """Things beside each other."""
    made = QHBoxLayout()
    made.setContentsMargins(0, 0, 0, 0)
    made.setSpacing(gap)
    for widget in widgets:
        made.addWidget(widget)
    return made


def scrolling(inner: QWidget) -> QScrollArea:
    """``inner`` in an area that scrolls up and down."""
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setFrameShape(QFrame.Shape.NoFrame)
    inner.setProperty("role", "panel")
    inner.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
    area.setWidget(inner)
    return area


def clear(layout: Any) -> None:
    """Take everything out of a layout."""
    while layout.count():
        item = layout.takeAt(0)
        widget = item.widget()
        if widget is not None:
            widget.hide()
            widget.deleteLater()
        elif item.layout() is not None:
            clear(item.layout())
