"""A heading that unfolds what is under it, made when it is unfolded for the first time."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from floorcast_app import icons
from floorcast_app.panels.base import column


class Fold(QWidget):
    """Folded at first."""

    def __init__(self, title: str, tip: str, make: Callable[[], QWidget]) -> None:
        super().__init__()
        self._title, self._make = title, make
        self._body: QWidget | None = None
        self.header = QToolButton()
        self.header.setProperty("role", "fold")
        self.header.setText(title)
        self.header.setToolTip(tip)
        self.header.setCheckable(True)
        self.header.setIconSize(QSize(16, 16))
        self.header.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.header.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.header.toggled.connect(self._toggled)
        icons.set_icon(self.header, "chevron-right", "muted")
        self._layout = column(self, 0, 0)
        self._layout.addWidget(self.header)

    def unfold(self) -> None:
        """Show what is under the heading."""
        self.header.setChecked(True)

    def set_count(self, count: int) -> None:
        """How many changed things are inside; none is not said."""
        self.header.setText(f"{self._title}  ·  {count}" if count else self._title)

    def _toggled(self, on: bool) -> None:
        if on and self._body is None:
            self._body = self._make()
            self._layout.addWidget(self._body)
        if self._body is not None:
            self._body.setVisible(on)
        icons.set_icon(self.header, "chevron-down" if on else "chevron-right", "muted")
