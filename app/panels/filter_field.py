"""The filter of a list: it stands in the list's heading, and makes itself small where there is no room."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import QHeaderView, QLineEdit, QWidget

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID
from floorcast_app.translation import tr

WIDE, SMALL = 200, 32  # px, spelt out and as a glass only
HEIGHT = 26  # px: within the heading
LINE = 1  # px below the heading
ARROW = 24  # px beside the last title for the arrow of a sorted column


class FilterField(QLineEdit):
    """Wide where the columns leave room at the right, while it is typed in, and while it holds words."""

    def __init__(self, header: QHeaderView, parent: QWidget) -> None:
        self._plate = QWidget(parent)  # a title that is cut by the field ends cleanly
        self._plate.setProperty("role", "panel")
        self._plate.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        super().__init__(self._plate)
        self._header = header
        self.setProperty("role", "filter")
        self.setPlaceholderText(tr("Filter"))
        self.setToolTip(tr("Show only rows with all of these words (Ctrl+F)"))
        self.setClearButtonEnabled(True)
        self.setFixedHeight(HEIGHT)
        glass = icons.icon("search", theme.colours().faint)
        self.addAction(glass, QLineEdit.ActionPosition.LeadingPosition)
        find = QShortcut(QKeySequence.StandardKey.Find, parent)
        find.setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        find.activated.connect(lambda: self.setFocus(Qt.FocusReason.ShortcutFocusReason))
        self.textChanged.connect(lambda _: self.settle())
        header.installEventFilter(self)
        header.sectionResized.connect(lambda *_: self.settle())
        self.settle()

    def settle(self) -> None:
        """Take the place at the right end of the heading that there is."""
        header = self._header
        plate = self._plate
        spelt = self.hasFocus() or bool(self.text()) or self._room() >= WIDE
        self.setFixedWidth(min(WIDE, header.width() - 2 * GRID) if spelt else SMALL)
        plate.setFixedSize(self.width() + GRID, header.height() - LINE)
        corner = header.mapTo(plate.parentWidget(), QPoint(header.width() - plate.width(), 0))
        plate.move(corner)
        self.move(GRID // 2, (header.height() - HEIGHT) // 2)
        plate.raise_()

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.settle()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.settle()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and (self.text() or self.hasFocus()):
            self.clear()
            self.clearFocus()
            return
        super().keyPressEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The heading has another width, or stands elsewhere."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show):
            self.settle()
        return False

    def _room(self) -> int:
        """Pixels at the right of the last title."""
        header = self._header
        last = header.logicalIndex(header.count() - 1)
        if last < 0:
            return header.width()
        title = str(header.model().headerData(last, Qt.Orientation.Horizontal) or "")
        written = header.fontMetrics().horizontalAdvance(title) + 2 * GRID + ARROW
        return header.width() - header.sectionViewportPosition(last) - written
