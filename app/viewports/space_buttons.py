"""Buttons in the corner of the 3D pane: views from a corner, from above, from the front, from the side."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QToolButton, QWidget

from floorcast_app import theme
from floorcast_app.rendering.camera import FRONT, SIDE, TOP
from floorcast_app.translation import tr
from floorcast_app.view_state import Look
from floorcast_app.workbench import Workbench

START = (Look().azimuth, Look().elevation)


class ViewButtons(QFrame):
    """A row of small buttons that turn the shared camera."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("viewButtons")
        self.setCursor(Qt.CursorShape.ArrowCursor)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(2, 2, 2, 2)
        layout.setSpacing(0)
        for text, key, (azimuth, elevation) in (
            (tr("Corner"), "", START),
            (tr("Top"), "7", TOP),
            (tr("Front"), "1", FRONT),
            (tr("Side"), "3", SIDE),
        ):
            button = QToolButton(self)
            button.setText(text)
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            tip = (
                tr("Look from there, key {key}").format(key=key)
                if key
                else tr("Look from a corner, from above")
            )
            button.setToolTip(tip)
            button.clicked.connect(
                lambda _=False, a=azimuth, e=elevation: workbench.view.set(azimuth=a, elevation=e)
            )
            layout.addWidget(button)
        self.wear(workbench.view.look.theme)

    def wear(self, name: str) -> None:
        """The colours of a theme, on a plate like that of the legend."""
        holds = theme.colours(name)
        self.setStyleSheet(
            f"#viewButtons {{ background: {holds.panel}; border: 1px solid {holds.line};"
            f" border-radius: 6px; }}"
            f"#viewButtons QToolButton {{ color: {holds.muted}; font-size: 11px; padding: 2px 7px; }}"
            f"#viewButtons QToolButton:hover {{ color: {holds.text}; }}"
        )
        self.adjustSize()
