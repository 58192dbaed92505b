"""What all dialogs share: a window above the main one that never stops the work."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QPushButton, QVBoxLayout, QWidget

from floorcast_app.panels.base import GRID


class Dialog(QDialog):
    """Not modal; closed and deleted by Esc or its buttons."""

    def __init__(self, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.body = QVBoxLayout(self)
        self.body.setContentsMargins(3 * GRID, 3 * GRID, 3 * GRID, 2 * GRID)
        self.body.setSpacing(GRID + 4)
        self.buttons = QDialogButtonBox()
        self.buttons.rejected.connect(self.reject)

    def add_button(self, text: str, primary: bool = False) -> QPushButton:
        """A button at the lower right."""
        button = QPushButton(text)
        role = QDialogButtonBox.ButtonRole.AcceptRole if primary else QDialogButtonBox.ButtonRole.ActionRole
        button.setAutoDefault(primary)
        button.setProperty("primary", primary)
        self.buttons.addButton(button, role)
        return button

    def add_close(self, text: str) -> None:
        """The button that closes, and the row of all buttons."""
        self.buttons.addButton(text, QDialogButtonBox.ButtonRole.RejectRole).setAutoDefault(False)
        self.body.addWidget(self.buttons)

    def open_over(self, parent: QWidget) -> None:
        """Show it in the middle of ``parent``, which stays usable."""
        self.adjustSize()
        if self.body.hasHeightForWidth():  # words that break need more than Qt asks for
            self.resize(self.width(), max(self.height(), self.body.totalHeightForWidth(self.width())))
        middle = parent.frameGeometry().center()
        self.move(middle.x() - self.width() // 2, max(0, middle.y() - self.height() // 2))
        self.show()
        self.raise_()
        self.activateWindow()
