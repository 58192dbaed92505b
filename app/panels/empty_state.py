"""What a window without a survey says: drop a file, open one, try the bundled one, or take a recent one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import (
    QColor,
    QDragEnterEvent,
    QDragLeaveEvent,
    QDropEvent,
    QIcon,
    QPainter,
    QPainterPath,
    QPixmap,
)
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QMainWindow, QPushButton, QToolButton, QWidget

from floorcast_app import icons, theme
from floorcast_app.dialogs.thumbnails import thumbnail
from floorcast_app.panels.base import GRID, clear, column, label, listener_of, row
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench
from floorplan_core.project_file import SUFFIX

if TYPE_CHECKING:
    from floorcast_app.recent import RecentFiles

DROP_SIZE = (560, 240)  # px
CARD = QSize(168, 104)  # px of a thumbnail
MARK = 32  # px of an icon by itself
CARDS_A_ROW = 3
MOST_CARDS = 6
TWO_ROWS = 760  # px of height from which two rows of cards stand below the drop zone


class EmptyState(QWidget):
    """Covers the window's panes until there is a survey."""

    def __init__(self, workbench: Workbench, recent: RecentFiles, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workbench, self._recent = workbench, recent
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "empty")
        self.drop = DropZone(workbench)
        self._cards = QGridLayout()
        self._cards.setSpacing(2 * GRID)
        self._heading = label(tr("Recent"), "section")
        inner = QWidget()
        inner.setFixedWidth(DROP_SIZE[0])
        layout = column(inner, 0, 2 * GRID)
        layout.addWidget(label("Floorcast", "title"))
        layout.addWidget(label(tr("From what was measured to the plan that explains it."), "muted"))
        layout.addSpacing(GRID)
        layout.addWidget(self.drop)
        layout.addSpacing(GRID)
        layout.addWidget(self._heading)
        layout.addLayout(self._cards)
        outer = column(self, 3 * GRID, 0)
        outer.addStretch(1)
        outer.addWidget(inner, 0, Qt.AlignmentFlag.AlignHCenter)
        outer.addStretch(1)
        self.refresh()

    def cover(self, window: QMainWindow) -> None:
        """Lie over everything between the toolbar and the status bar of ``window``."""
        top = max((bar.geometry().bottom() + 1 for bar in _bars(window)), default=0)
        bottom = window.statusBar().height() if window.statusBar().isVisible() else 0
        tall = self.height() >= TWO_ROWS
        self.setGeometry(0, top, window.width(), max(0, window.height() - top - bottom))
        if tall != (self.height() >= TWO_ROWS):
            self.refresh()

    def showEvent(self, event: object) -> None:
        self.refresh()
        super().showEvent(event)  # type: ignore[arg-type]

    def refresh(self) -> None:
        """Look anew at the recent files."""
        clear(self._cards)
        paths = self._recent.paths()[: MOST_CARDS if self.height() >= TWO_ROWS else CARDS_A_ROW]
        self._heading.setVisible(bool(paths))
        for i, path in enumerate(paths):
            self._cards.addWidget(self._card(path), i // CARDS_A_ROW, i % CARDS_A_ROW)
        self._cards.setColumnStretch(CARDS_A_ROW, 1)

    def _card(self, path: Path) -> QToolButton:
        card = QToolButton()
        card.setObjectName("recent")
        card.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextUnderIcon)
        card.setIconSize(CARD)
        card.setIcon(_card_picture(path))
        shown = card.fontMetrics().elidedText(_name(path), Qt.TextElideMode.ElideMiddle, CARD.width())
        card.setText(shown)
        card.setMinimumHeight(card.sizeHint().height())  # its name is never cut off
        card.setToolTip(str(path))
        card.clicked.connect(lambda: self._workbench.try_run("file.open", path=path))
        return card


class DropZone(QFrame):
    """Files are dropped here, or opened by its buttons."""

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self._workbench = workbench
        self.setAcceptDrops(True)
        self.setProperty("role", "drop")
        self.setMinimumHeight(DROP_SIZE[1])
        self._mark = QLabel()
        self._mark.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.open = QPushButton(tr("Open…"))
        self.open.setProperty("primary", True)
        self.open.clicked.connect(lambda: workbench.try_run("file.open"))
        self.folder = QPushButton(tr("Open folder…"))
        self.folder.clicked.connect(lambda: workbench.try_run("file.open_folder"))
        self.sample = QPushButton(tr("Try the bundled survey"))
        self.sample.clicked.connect(lambda: workbench.try_run("file.open_sample"))
        layout = column(self, 3 * GRID, GRID)
        layout.addStretch(1)
        layout.addWidget(self._mark)
        layout.addWidget(_centred(label(tr("Drop a survey or a project here"), "heading")))
        formats = tr("Point clouds, meshes, runs of a robot and occupancy maps")
        layout.addWidget(_centred(label(formats, "small", wrap=True)))
        layout.addSpacing(GRID)
        buttons = row(self.open, self.folder, self.sample)
        buttons.insertStretch(0)
        buttons.addStretch()
        layout.addLayout(buttons)
        layout.addStretch(1)
        self._tint()
        theme.changed.connect(listener_of(self, lambda *_: self._tint(), theme.changed))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if event.mimeData().hasUrls():
            event.acceptProposedAction()
            self._activate(True)

    def dragLeaveEvent(self, event: QDragLeaveEvent) -> None:
        self._activate(False)

    def dropEvent(self, event: QDropEvent) -> None:
        self._activate(False)
        for url in event.mimeData().urls()[:1]:
            self._workbench.try_run("file.open", path=url.toLocalFile())

    def _activate(self, active: bool) -> None:
        self.setProperty("active", active)
        self.style().unpolish(self)
        self.style().polish(self)

    def _tint(self) -> None:
        self._mark.setPixmap(icons.pixmap("upload", MARK, theme.colours().accent))


def _name(path: Path) -> str:
    """Many surveys are called points.ply: their folder tells them apart."""
    return path.name if path.suffix.lower() == SUFFIX or path.is_dir() else f"{path.parent.name}/{path.name}"


def _card_picture(path: Path) -> QIcon:
    ratio = icons.finest_ratio()
    picture = QPixmap(CARD * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    frame = QPainterPath()
    frame.addRoundedRect(0, 0, CARD.width(), CARD.height(), 6, 6)
    painter.fillPath(frame, QColor(theme.colours().raised))
    painter.setClipPath(frame)
    mark = "folder" if path.is_dir() else "box"
    shown = thumbnail(path, CARD, ratio) or icons.pixmap(mark, MARK, theme.colours().muted)
    size = shown.deviceIndependentSize()
    painter.drawPixmap(
        round((CARD.width() - size.width()) / 2), round((CARD.height() - size.height()) / 2), shown
    )
    painter.end()
    return QIcon(picture)


def _bars(window: QMainWindow) -> list[QWidget]:
    from PySide6.QtWidgets import QToolBar

    bars: list[QWidget] = [bar for bar in window.findChildren(QToolBar) if bar.isVisibleTo(window)]
    return [*bars, window.menuBar()] if window.menuBar() is not None else bars


def _centred(widget: QLabel) -> QLabel:
    widget.setAlignment(Qt.AlignmentFlag.AlignCenter)
    return widget
