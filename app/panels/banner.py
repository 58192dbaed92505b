"""A line at the top of the window that asks something without stopping anybody."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QMainWindow, QPushButton, QToolButton, QWidget

from floorcast_app import icons
from floorcast_app.panels.base import GRID, clear, row
from floorcast_app.translation import tr


class Banner(QFrame):
    """Lies over the panes, just below the toolbar of its window."""

    def __init__(self, window: QMainWindow) -> None:
        super().__init__(window)
        self.setProperty("role", "banner")
        self.mark, self.text = QLabel(), QLabel()
        self.text.setWordWrap(True)
        self._answers = QHBoxLayout()
        self._answers.setSpacing(GRID)
        self.close_button = QToolButton()
        icons.set_icon(self.close_button, "x", "muted")
        self.close_button.setToolTip(tr("Dismiss"))
        self.close_button.clicked.connect(self.hide)
        line = row(self.mark, self.text, gap=GRID + 4)
        line.setStretch(1, 1)
        line.addLayout(self._answers)
        line.addWidget(self.close_button)
        line.setContentsMargins(2 * GRID, 6, GRID, 6)
        self.setLayout(line)
        window.installEventFilter(self)
        self.hide()

    def ask(self, icon: str, text: str, *answers: QWidget) -> None:
        """Show ``text`` with widgets that answer it at its right."""
        self.mark.setPixmap(icons.pixmap(icon, 20))
        self.text.setText(text)
        clear(self._answers)
        for answer in answers:
            self._answers.addWidget(answer)
        self.show()
        self.place()
        self.raise_()

    def place(self) -> None:
        """Below the toolbar, as wide as the window."""
        window = self.parentWidget()
        assert isinstance(window, QMainWindow)
        bars = [b for b in window.findChildren(QWidget) if b.inherits("QToolBar") and b.parent() is window]
        top = max((b.geometry().bottom() + 1 for b in bars if b.isVisible()), default=0)
        width = window.width()
        self.setGeometry(0, top, width, max(self.sizeHint().height(), self.heightForWidth(width)))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self.place()
        return super().eventFilter(watched, event)


def answer(text: str, do: Callable[[], object], primary: bool = False) -> QPushButton:
    """A button that answers a banner."""
    button = QPushButton(text)
    button.setProperty("primary", primary)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.clicked.connect(lambda: do())
    return button
