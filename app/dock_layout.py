"""How the docks stand in each workspace, until the user moves them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import pairwise

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer
from PySide6.QtWidgets import QDockWidget, QMainWindow, QTabBar, QWidget

H, V = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
HIDDEN = {  # panes that a workspace does without
    "inspect": ("timeline",),
    "plan": ("space", "planes", "free_space", "evidence", "timeline", "layers"),
    "run": ("planes", "free_space", "evidence", "settings", "layers"),
}

LISTS = ("region_list", "door_list", "plane_list", "ground_truth", "warnings", "history")  # one row of tabs
SIDES = ("layers", "properties")  # panes whose width is for words, not for the plan
SETTLED = 40  # ms after which Qt has laid out a window of another size
TALL = (  # panes above each other
    "space", "free_space", "planes", "floor_plan", *LISTS, "timeline",
)  # fmt: skip
TABLES = {"inspect": 0.25, "plan": 0.25, "run": 0.2}  # of the window's height, for the tables at the bottom
LINE = {"inspect": 0.1, "plan": 0.1, "run": 0.25}  # for the timeline, where it is shown


def tab_bars(window: QMainWindow) -> list[QTabBar]:
    """The tab bars of the docks, those that Qt keeps for later included."""
    return window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], workspace: str) -> None:
    """Put every dock where the workspace has it."""
    for dock in docks.values():
        dock.setFloating(False)
        window.removeDockWidget(dock)
    left = Qt.DockWidgetArea.LeftDockWidgetArea
    bottom = Qt.DockWidgetArea.BottomDockWidgetArea
    window.addDockWidget(left, docks["layers"])
    window.splitDockWidget(docks["layers"], docks["space"], H)
    window.splitDockWidget(docks["space"], docks["planes"], H)
    window.splitDockWidget(docks["planes"], docks["properties"], H)
    window.splitDockWidget(docks["space"], docks["free_space"], V)
    window.splitDockWidget(docks["planes"], docks["floor_plan"], V)
    window.splitDockWidget(docks["properties"], docks["evidence"], V)
    window.splitDockWidget(docks["evidence"], docks["settings"], V)
    window.tabifyDockWidget(docks["evidence"], docks["settings"])
    docks["evidence"].raise_()
    first = docks[LISTS[0]]
    window.addDockWidget(bottom, first)
    window.splitDockWidget(first, docks["timeline"], V)  # before there are tabs: it would become one
    for before, id in pairwise(LISTS):
        window.tabifyDockWidget(docks[before], docks[id])
    first.raise_()
    for id, dock in docks.items():
        dock.setVisible(id not in HIDDEN[workspace])
    _resize(window, docks, workspace)


def _resize(window: QMainWindow, docks: Mapping[str, QDockWidget], workspace: str) -> None:
    width, height = max(window.width(), 900), max(window.height(), 600)
    left, right = min(max(224, round(0.14 * width)), 280), min(max(264, round(0.19 * width)), 380)
    shown = [k for k in ("layers", "space", "planes", "properties") if k not in HIDDEN[workspace]]
    if "planes" not in shown:
        shown.insert(-1, "floor_plan")  # it stands below the layout planes, in their column
    sizes = {"layers": left, "properties": right}
    rest = width - sum(sizes.get(k, 0) for k in shown)
    middle = rest // sum(k not in sizes for k in shown)
    window.resizeDocks([docks[k] for k in shown], [sizes.get(k, middle) for k in shown], H)
    tables, line = round(TABLES[workspace] * height), round(LINE[workspace] * height)
    if "timeline" in HIDDEN[workspace]:
        line = 0
    else:
        window.resizeDocks([docks["timeline"]], [line], V)
    window.resizeDocks([docks["floor_plan"], docks[LISTS[0]]], [height - tables - line, tables], V)
    half = (height - tables - line) // 2
    for above, below in (("space", "free_space"), ("planes", "floor_plan"), ("properties", "evidence")):
        if not {above, below} & set(HIDDEN[workspace]):
            window.resizeDocks([docks[above], docks[below]], [half, half], V)


class Proportions(QObject):
    """A larger window gives its room to the panes: the sides keep their width, heights their share.

    Qt by itself gives all of it to the bottom.
    """

    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        super().__init__(window)
        self._window, self._docks = window, docks
        self._sizes: dict[str, QSize] = {}  # of the docks shown, when nothing moved any more
        self._whole = QSize()  # of the window then
        self._bars = 0  # px of its height that are no dock's: bars, tabs and titles, which do not grow
        self._follows = QTimer(self, singleShot=True, interval=SETTLED)
        self._follows.timeout.connect(self._follow)
        self._rests = QTimer(self, singleShot=True, interval=0)
        self._rests.timeout.connect(self._remember)
        for dock in docks.values():
            dock.installEventFilter(self)
            dock.visibilityChanged.connect(lambda _: self._rests.start())  # another tab is in front

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """A border was moved, by the user or by us."""
        if event.type() in (QEvent.Type.Resize, QEvent.Type.Hide, QEvent.Type.Show):
            self._rests.start()
        return False

    def window_resized(self) -> None:
        """To be told of the window's new size."""
        if self._sizes and self._window.size() != self._whole:
            self._follows.start()

    def put_back(self) -> None:
        """Give the docks the sizes they had, when Qt has laid out what is in them now."""
        self._follows.start()
        QTimer.singleShot(0, self, self._follows.start)  # that may take longer than it has to settle

    def start_anew(self) -> None:
        """The docks are about to stand otherwise: what they had has no say any more."""
        self._follows.stop()
        self._sizes = {}
        self._rests.start()

    @property
    def busy(self) -> bool:
        """True while the docks are about to follow a new size."""
        return self._follows.isActive() or self._rests.isActive()

    def kept(self) -> str:
        """The sizes as text, to be given to :meth:`recall` with the arrangement that they belong to."""
        sizes = {id: [size.width(), size.height()] for id, size in self._sizes.items()}
        window = [self._whole.width(), self._whole.height()]
        return json.dumps({"window": window, "bars": self._bars, "docks": sizes})

    def recall(self, kept: str) -> None:
        """Give an arrangement that was kept in a window of another size its proportions back."""
        try:
            read = json.loads(kept)
            whole, bars = QSize(*map(int, read["window"])), int(read["bars"])
            sizes = {id: QSize(*map(int, size)) for id, size in read["docks"].items() if id in self._docks}
        except (ValueError, TypeError, KeyError, AttributeError):
            return  # somebody else wrote the settings
        if sizes and whole != self._window.size():
            self._sizes, self._whole, self._bars = sizes, whole, bars
            self._follows.start()

    def _remember(self) -> None:
        if self._window.isVisible() and not self._follows.isActive():
            shown = {id: dock for id, dock in self._docks.items() if not dock.visibleRegion().isEmpty()}
            self._sizes = {id: dock.size() for id, dock in shown.items() if not dock.isFloating()}
            self._whole = self._window.size()
            self._bars = self._whole.height() - _column(shown)

    def _follow(self) -> None:
        sizes = {id: size for id, size in self._sizes.items() if self._docks[id].isVisible()}
        tall = [id for id in TALL if id in sizes]  # tabs that lie behind have no say
        taller = (self._window.height() - self._bars) / max(self._whole.height() - self._bars, 1)
        heights = [round(sizes[id].height() * taller) for id in tall]
        self._window.resizeDocks([self._docks[id] for id in tall], heights, V)
        sides = [id for id in SIDES if id in sizes]
        self._window.resizeDocks([self._docks[id] for id in sides], [sizes[id].width() for id in sides], H)
        self._rests.start()


def _column(docks: Mapping[str, QDockWidget]) -> int:
    """Pixels of height of the docks above each other, where the first of :data:`TALL` stands."""
    standing = {id: dock.geometry() for id, dock in docks.items() if not dock.isFloating()}
    first = next((id for id in TALL if id in standing), None)
    if first is None:
        return 0
    x = standing[first].center().x()
    return sum(box.height() for box in standing.values() if box.left() <= x <= box.right())


class TitleBars:
    """A dock among tabs needs no title above them: its tab says it already."""

    def __init__(self, window: QMainWindow, docks: Mapping[str, QDockWidget]) -> None:
        self._window, self._docks = window, docks
        self._soon = QTimer(window, singleShot=True, interval=0)
        self._soon.timeout.connect(self.refresh)
        for dock in docks.values():
            dock.topLevelChanged.connect(lambda _: self._soon.start())
            dock.dockLocationChanged.connect(lambda _: self._soon.start())
            dock.visibilityChanged.connect(lambda _: self._soon.start())

    def refresh(self) -> None:
        """Show the title bars of docks that stand alone, hide those among tabs."""
        for dock in self._docks.values():
            tabbed = not dock.isFloating() and bool(self._window.tabifiedDockWidgets(dock))
            if tabbed and dock.titleBarWidget() is None:
                dock.setTitleBarWidget(QWidget(dock))
            elif not tabbed and (bar := dock.titleBarWidget()) is not None:
                dock.setTitleBarWidget(None)  # type: ignore[arg-type]
                bar.deleteLater()
