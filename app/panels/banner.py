"""A line at the top of the window that asks something without stopping anybody or covering anything."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, Qt, QTimer, Signal
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QMainWindow,
    QPushButton,
    QSizePolicy,
    QToolBar,
    QToolButton,
    QWidget,
)

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID, clear, row
from floorcast_app.translation import tr

MARK = 20  # px


class Banner(QToolBar):
    """Stands below the toolbar of its window; the panes make room for it."""

    moved = Signal()  # it came, went, or has another height

    def __init__(self, window: QMainWindow, name: str) -> None:
        """``name``: by which the window remembers its bars."""
        super().__init__(window)
        self.setObjectName(name)
        self.setProperty("role", "banner")
        self.setMovable(False)
        self.toggleViewAction().setVisible(False)
        self._icon = ""
        self._wanted = False
        self._again: Callable[[], None] | None = None  # asks the same in the words of the present language
        self.mark, self.text = QLabel(), QLabel()
        self.text.setWordWrap(True)
        self._answers = QHBoxLayout()
        self._answers.setSpacing(GRID)
        self.close_button = QToolButton()
        icons.set_icon(self.close_button, "x", "muted")
        self.close_button.clicked.connect(self.hide)
        self._line = self._make_line()
        self.addWidget(self._line)
        layout = self.layout()
        assert layout is not None
        layout.setContentsMargins(0, 0, 0, 0)
        window.addToolBarBreak()
        window.addToolBar(self)
        self.hide()

    def say(self, question: Callable[[], None]) -> None:
        """Ask by a function that calls :meth:`ask`; once more where the language changes meanwhile."""
        self._again = question
        question()

    def ask(self, icon: str, text: str, *answers: QWidget) -> None:
        """Show ``text`` with widgets that answer it at its right."""
        self._icon = icon
        self._tint()
        self.close_button.setToolTip(tr("Dismiss"))
        self.text.setText(text)
        clear(self._answers)
        for answer in answers:
            self._answers.addWidget(answer)
        self._wanted = True
        self.show()
        self._fold()

    def hide(self) -> None:
        """Take it away, for good."""
        self._wanted = False
        super().hide()

    def put_right(self) -> None:
        """Be there or not as asked, whatever an arrangement that was kept says."""
        self.setVisible(self._wanted)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange and self._icon:
            self._tint()
        if event.type() == QEvent.Type.LanguageChange and self._wanted and self._again is not None:
            self._again()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fold()
        self.moved.emit()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        QTimer.singleShot(0, self, self.moved.emit)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        QTimer.singleShot(0, self, self.moved.emit)

    def _make_line(self) -> QFrame:
        made = QFrame()
        line = row(self.mark, self.text, gap=GRID + 4)
        line.setStretch(1, 1)
        line.addLayout(self._answers)
        line.addWidget(self.close_button)
        line.setContentsMargins(2 * GRID, 6, GRID, 6)
        made.setLayout(line)
        made.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        return made

    def _fold(self) -> None:
        """As tall as the words need at the present width: tool bars cannot ask for that themselves."""
        parent, layout = self.parentWidget(), self._line.layout()
        assert parent is not None and layout is not None
        height = layout.heightForWidth(parent.width()) + 1
        if self.minimumHeight() != height:
            self._line.setFixedHeight(height)
            self.setFixedHeight(height)

    def _tint(self) -> None:
        self.mark.setPixmap(icons.pixmap(self._icon, MARK, theme.colours().accent))


def answer(text: str, do: Callable[[], object], primary: bool = False) -> QPushButton:
    """A button that answers a banner."""
    button = QPushButton(text)
    button.setProperty("primary", primary)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.clicked.connect(lambda: do())
    return button
