"""Regions, doors, planes: a list each, sorted, filtered, with eyes, locks, pins and the shared selection."""

from __future__ import annotations

from PySide6.QtCore import QItemSelection, QItemSelectionModel, QModelIndex, QPoint, QSize, Qt
from PySide6.QtGui import QImage, QMouseEvent, QShowEvent
from PySide6.QtWidgets import QAbstractItemView, QDockWidget, QHeaderView, QMainWindow, QTableView, QWidget

from floorcast_app import theme
from floorcast_app.panels.base import GRID, Panel, column, listener_of, retitle
from floorcast_app.panels.by_hand import is_locked
from floorcast_app.panels.filter_field import FilterField
from floorcast_app.panels.item_columns import things
from floorcast_app.panels.item_menu import item_menu
from floorcast_app.panels.item_model import EYE, ITEM_ROLE, LOCK, LOCKABLE, OWN, ItemModel
from floorcast_app.selection import Item
from floorcast_app.translation import tr
from floorcast_app.view_state import Look
from floorcast_app.workbench import Workbench

TITLES = {"region": "Regions", "door": "Doors", "plane": "Planes"}
ROW_HEIGHT = 28  # px
HEADER_HEIGHT = 32  # px: the filter stands in it
ARROW_WIDTH = 16  # px of the arrow of the sorted column
PIN_WIDTH = 22  # px of the pin of a corrected thing
MARK_WIDTH = 30  # px of the columns with an eye and a lock
LOCK_ACTIONS = {"plane": "correct.keep_plane", "door": "correct.accept_door"}


class ItemTable(QTableView):
    """The list of one kind."""

    def __init__(self, workbench: Workbench, kind: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.kind, self._workbench = kind, workbench
        self.rows = ItemModel(workbench, kind, self)
        self.setModel(self.rows)
        self.rows.modelReset.connect(self.follow)
        self._dress()
        self.sortByColumn(OWN, Qt.SortOrder.AscendingOrder)
        self.clicked.connect(self._clicked)
        self.doubleClicked.connect(lambda i: workbench.selection.zoom_asked.emit(i.data(ITEM_ROLE)))
        self.customContextMenuRequested.connect(self._menu)
        self._following = False
        self.leads = False  # the selection changes because of this list
        self.stale = True  # the plan is another one than the rows'
        self.selectionModel().selectionChanged.connect(self._picked)

    def freshen(self) -> None:
        """Take over the present plan, where that was not done yet."""
        if self.stale:
            self.stale = False
            self.rows.reload()
            self._fit_columns()
            self.follow()

    def _fit_columns(self) -> None:
        """As wide as what stands in them; Qt's own way asks every cell ten times."""
        metrics, heading = self.fontMetrics(), self.horizontalHeader().fontMetrics()
        for at, column_ in enumerate(self.rows.columns):
            texts = self.rows.texts(column_)
            widest = max((metrics.horizontalAdvance(t) for t in texts), default=0)
            title = heading.horizontalAdvance(tr(column_.title)) + ARROW_WIDTH
            pin = PIN_WIDTH if at == 0 else 0
            self.setColumnWidth(OWN + at, max(widest + pin, title) + 3 * GRID)

    def follow(self) -> None:
        """Show the workbench's selection."""
        model = self.selectionModel()
        flags = QItemSelectionModel.SelectionFlag
        self._following = True
        places = [self._index_of(item) for item in self._workbench.selection.items]
        rows = QItemSelection()
        for at in (place for place in places if place.isValid()):
            rows.select(at, at)
        model.select(rows, flags.ClearAndSelect | flags.Rows)
        if (last := next((at for at in reversed(places) if at.isValid()), None)) is not None:
            model.setCurrentIndex(last, flags.NoUpdate)
            self.scrollTo(last)
        self._following = False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._workbench.selection.hover(self.indexAt(event.position().toPoint()).data(ITEM_ROLE))
        super().mouseMoveEvent(event)

    def leaveEvent(self, event: object) -> None:
        self._workbench.selection.hover(None)
        super().leaveEvent(event)  # type: ignore[arg-type]

    # ---- inside -----------------------------------------------------------------------------------------

    def _dress(self) -> None:
        self.setSortingEnabled(True)
        self.setAlternatingRowColors(True)
        self.setShowGrid(False)
        self.setMouseTracking(True)
        self.setWordWrap(False)
        self.setIconSize(QSize(16, 16))
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(ROW_HEIGHT)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setFixedHeight(HEADER_HEIGHT)
        header.setMinimumSectionSize(MARK_WIDTH)
        header.setStretchLastSection(not self.rows.columns[-1].number)
        for mark in (EYE, LOCK):
            header.setSectionResizeMode(mark, QHeaderView.ResizeMode.Fixed)
            header.resizeSection(mark, MARK_WIDTH)
        self.setColumnHidden(LOCK, self.kind not in LOCKABLE)

    def _index_of(self, item: Item) -> QModelIndex:
        at = self.rows.row_of(item)
        return self.rows.index(at, OWN) if at >= 0 else QModelIndex()

    def _picked(self) -> None:
        """Rows were selected by mouse or keys: the whole application follows."""
        if self._following:
            return
        chosen = [i.data(ITEM_ROLE) for i in self.selectionModel().selectedRows(OWN)]
        current = self.currentIndex().data(ITEM_ROLE)
        chosen.sort(key=lambda item: item == current)  # the one clicked last leads
        self._following = self.leads = True
        self._workbench.selection.select_all(chosen)
        self._following = self.leads = False

    def _clicked(self, index: QModelIndex) -> None:
        item = index.data(ITEM_ROLE)
        if index.column() == EYE:
            view = self._workbench.view
            view.set(hidden=view.look.hidden ^ {(item.kind, item.id)})
        elif index.column() == LOCK and self.kind in LOCKABLE:
            self._lock(item)

    def _lock(self, item: Item) -> None:
        locked = is_locked(self._workbench.find(item))
        action = "correct.release" if locked else LOCK_ACTIONS[item.kind]
        self._workbench.try_run(action, **({"item": item} if locked else {item.kind: item.id}))

    def _menu(self, at: QPoint) -> None:
        item = self.indexAt(at).data(ITEM_ROLE)
        if item is not None:
            if item not in self._workbench.selection.items:
                self._workbench.selection.select(item)
            item_menu(self._workbench, item, self).popup(self.viewport().mapToGlobal(at))


class ListPanel(Panel):
    """One list; its dock's title says how long it is."""

    kind = ""  # of the things listed

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.table = ItemTable(workbench, self.kind)
        column(self, 0, 0).addWidget(self.table)
        self.search = FilterField(self.table.horizontalHeader(), self)
        self.search.textChanged.connect(self._filter)
        self.listen(workbench.plan_changed)
        self.listen(workbench.selection.changed, then=self._follow)
        self.listen(workbench.view.changed, then=self._look_changed)
        theme.changed.connect(listener_of(self, self.refresh_soon, theme.changed))
        self.refresh()

    def refresh(self) -> None:
        count = len(things(self.workbench.plan, self.kind))
        title = tr(TITLES[self.kind])
        retitle(self, f"{title} ({count})" if count else title)
        self.table.stale = True
        self.seen(not self.visibleRegion().isEmpty())

    def seen(self, visible: bool) -> None:
        """It is in front now, or not: only then it is filled, as a hospital has hundreds of planes."""
        if visible:
            self.table.freshen()
            self.search.settle()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.refresh_soon()

    def picture(self, width: int, height: int) -> QImage:
        """The list as a picture, ratio 1, of the present plan also where it lies behind others."""
        self.table.freshen()
        return super().picture(width, height)

    # ---- inside -----------------------------------------------------------------------------------------

    def _follow(self) -> None:
        if self.table.leads:
            return  # it came from here
        item = self.workbench.selection.item
        if item is not None and item.kind == self.kind:
            self._come_forward()
        self.table.follow()

    def _come_forward(self) -> None:
        """Take the place of another list that is in front; never that of warnings or checks."""
        dock = self.parentWidget()
        window = dock.parentWidget() if dock is not None else None
        if isinstance(dock, QDockWidget) and isinstance(window, QMainWindow):
            others = [d for d in window.tabifiedDockWidgets(dock) if isinstance(d.widget(), ListPanel)]
            if any(not d.visibleRegion().isEmpty() for d in others):
                dock.raise_()

    def _filter(self, text: str) -> None:
        self.table.rows.set_filter(text)

    def _look_changed(self, before: Look, after: Look) -> None:
        if before.units != after.units:
            self.refresh_soon()
        elif before.hidden != after.hidden:
            self.table.rows.repaint_marks()


class RegionList(ListPanel):
    """The regions."""

    kind = "region"


class DoorList(ListPanel):
    """The doors and openings."""

    kind = "door"


class PlaneList(ListPanel):
    """The layout planes, those of wings too."""

    kind = "plane"
