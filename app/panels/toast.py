"""One sentence above the window, gone after a while; an error stays until it is clicked away."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QToolButton, QWidget

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID, listener_of
from floorcast_app.translation import tr, tr_text

SECONDS = {"info": 4.0, "warning": 8.0, "error": 0.0}  # 0: stays
ICONS = {"info": "info", "warning": "triangle-alert", "error": "circle-alert"}
WIDEST = 640  # px: a longer line is hard to read


class Toast(QFrame):
    """Lies over the lower edge of its parent."""

    wears_its_own = True  # its style sheet is not the theme's

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.kind = "info"
        self.setObjectName("toast")
        self._icon, self._text, self._close = QLabel(), QLabel(), QToolButton()
        self._text.setWordWrap(True)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._close.clicked.connect(self.hide)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(2 * GRID, GRID, GRID, GRID)
        layout.setSpacing(GRID + 4)
        layout.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignVCenter)
        layout.addWidget(self._text, 1)
        layout.addWidget(self._close, 0, Qt.AlignmentFlag.AlignVCenter)
        self._gone = QTimer(self)
        self._gone.setSingleShot(True)
        self._gone.timeout.connect(self.hide)
        parent.installEventFilter(self)
        theme.changed.connect(listener_of(self, lambda *_: self._dress(), theme.changed))
        self.hide()

    @property
    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def tell(self, text: str, kind: str = "info") -> None:
        """Say ``text``; ``kind``: "info", "warning" or "error"."""
        self.kind = kind if kind in SECONDS else "info"
        self._text.setText(tr_text(text))
        self._close.setToolTip(tr("Dismiss"))
        self._dress()
        self._place()
        self.show()
        self.raise_()
        self._gone.stop()
        if SECONDS[self.kind]:
            self._gone.start(round(SECONDS[self.kind] * 1000))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.hide()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        return super().eventFilter(watched, event)

    def _dress(self) -> None:
        holds = theme.colours()
        other = theme.colours("dark" if theme.name() == "light" else "light")  # a toast is dark on light
        mark = {"info": holds.tip_text, "warning": other.warning, "error": other.error}[self.kind]
        self.setStyleSheet(
            f"#toast {{ background: {holds.tip}; border-radius: 8px; }} "
            f"#toast QLabel {{ color: {holds.tip_text}; }} "
            f"#toast QToolButton:hover {{ background: {holds.muted}; }}"
        )
        self._icon.setPixmap(icons.pixmap(ICONS[self.kind], 20, mark))
        self._close.setIcon(icons.icon("x", holds.tip_text))

    def _place(self) -> None:
        parent = self.parentWidget()
        width = min(WIDEST, parent.width() - 4 * GRID)
        text_width = self._text.fontMetrics().horizontalAdvance(self._text.text()) + 14 * GRID
        self.setFixedWidth(max(160, min(width, text_width)))
        self.setFixedHeight(self.layout().heightForWidth(self.width()))
        self.move((parent.width() - self.width()) // 2, parent.height() - self.height() - 6 * GRID)
