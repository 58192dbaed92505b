"""The window: docks of panes, menus and a toolbar of actions, a status bar. What they do is elsewhere."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from PySide6.QtCore import QByteArray, QChildEvent, QPoint, QSettings, QSize, Qt, QTimer
from PySide6.QtGui import (
    QCloseEvent,
    QDragEnterEvent,
    QDropEvent,
    QGuiApplication,
    QImage,
    QKeyEvent,
    QPainter,
    QResizeEvent,
)
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QMenu, QTabWidget, QWidget

from floorcast_app.actions import MENUS
from floorcast_app.dialogs.thumbnails import plan_png
from floorcast_app.dock_layout import Proportions, TitleBars, arrange, tab_bars
from floorcast_app.dressing import Dresser
from floorcast_app.panels.assumptions_banner import AssumptionsBanner
from floorcast_app.panels.empty_state import EmptyState
from floorcast_app.panels.missing_banner import MissingBanner
from floorcast_app.panels.recovery_banner import RecoveryBanner
from floorcast_app.panels.status import StatusBar
from floorcast_app.panels.toast import Toast
from floorcast_app.panes import FORMER, PANES
from floorcast_app.qt_actions import QtActions
from floorcast_app.qt_interface import QtInterface
from floorcast_app.recent import RecentFiles
from floorcast_app.toolbar import MainToolbar
from floorcast_app.translation import tr
from floorcast_app.view_state import Look
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.workbench import Workbench
from floorplan_core.errors import OutputError, UsageError

MENU_TITLES = {
    "file": "File", "edit": "Edit", "view": "View", "plan": "Plan", "tool": "Tools",
    "correct": "Correct", "measure": "Measure", "help": "Help",
}  # fmt: skip
NOT_IN_MENUS = (  # they need arguments: for the palette's settings, for panes and for scripts
    "view.pane", "view.look", "edit.select", "edit.history", "plan.set", "plan.preset", "measure.set",
)  # fmt: skip
MENU_GROUPS = (  # actions that begin a group of their menu
    "file.save", "file.export", "file.save_recording", "file.close", "edit.delete", "edit.preferences",
    "view.layer_points",
    "view.units", "view.inspect", "plan.reset", "plan.storey", "plan.replay", "tool.measure", "tool.split",
    "correct.accept_door", "correct.relabel", "correct.release", "measure.export", "help.english",
    "help.about",
)  # fmt: skip
SUBMENUS = {"view.layer_": "Layers", "view.colour_": "Points by colour"}  # ids that begin so, and their menu
DOCKS = 3  # version of the arrangement: one that was kept of other docks or bars is not taken
LAST_WAIT = 5.0  # s that closing waits for a job that was told to stop


class MainWindow(QMainWindow):
    """One window, one document."""

    def __init__(self, workbench: Workbench, settings: QSettings, unattended: bool = False) -> None:
        super().__init__()
        self.workbench, self.unattended = workbench, unattended
        self._settings = settings
        self._fitted = True  # False: the next plan is brought into view
        workbench.preferences.attach(settings.value, settings.setValue)
        self.recent = RecentFiles(settings, lambda: workbench.preferences.number("recent"))
        self.actions_by_id = QtActions(workbench, self)
        self.dresser = Dresser(self, self.actions_by_id.retinting)
        self.setObjectName("floorcast")
        self.setDockNestingEnabled(True)
        self.setAcceptDrops(True)
        self.setTabPosition(Qt.DockWidgetArea.AllDockWidgetAreas, QTabWidget.TabPosition.North)
        self.setDockOptions(self.dockOptions() | QMainWindow.DockOption.GroupedDragging)
        self.docks = {pane.id: self._dock(pane.id, pane.title, pane.make(workbench)) for pane in PANES}
        self._titles = TitleBars(self, self.docks)
        self._proportions = Proportions(self, self.docks)
        self._fill_menus()
        self.addToolBar(MainToolbar(workbench, self.actions_by_id, self))
        self.status = StatusBar(workbench, self)
        self.setStatusBar(self.status)
        self.toast = Toast(self)
        self.banner = None if unattended else AssumptionsBanner(workbench, self)
        self.empty = EmptyState(workbench, self.recent, self)
        self.missing = None if unattended else MissingBanner(workbench, self)
        self.recovery = None if unattended else RecoveryBanner(workbench, self)
        for banner in (self.banner, self.missing, self.recovery):
            if banner is not None:
                banner.moved.connect(lambda: self.empty.cover(self))
        workbench.ui = QtInterface(self)
        workbench.thumbnail = lambda: plan_png(self)
        workbench.view.changed.connect(self._look_changed)
        workbench.preferences.changed.connect(self._preferred)
        workbench.document.saved_changed.connect(self._retitle)
        workbench.survey_changed.connect(self._survey_changed)
        workbench.plan_changed.connect(self._plan_changed)
        workbench.recent_changed.connect(self.recent.put)
        self.resize(1440, 900)
        self._restore()
        self._retitle()
        self._survey_changed()

    # ---- parts ------------------------------------------------------------------------------------------

    def pane(self, id: str) -> QWidget:
        """The widget of a pane; :class:`UsageError` where there is none of that name."""
        widget = self._dock_of(id).widget()
        assert widget is not None
        return widget

    def show_pane(self, id: str) -> None:
        """Bring a pane to the front."""
        dock = self._dock_of(id)
        dock.show()
        dock.raise_()

    def picture(self, pane: str, width: int, height: int, scale_bar: bool | None = None) -> QImage:
        """A picture of a pane, or of the whole window ("window").

        :param scale_bar: with one or without, where the pane is a plan; None: as the pane shows it.
        """
        if pane == "window":
            return self._window_picture(width, height)
        self.dresser.finish()
        widget = self.pane(pane)
        if isinstance(widget, PlanCanvas):
            return widget.picture(width, height, scale_bar)
        if hasattr(widget, "picture"):
            return widget.picture(width, height)
        widget.resize(width, height)
        return widget.grab().toImage()

    def save_picture(
        self, path: Path, pane: str, width: int, height: int, scale_bar: bool | None = None
    ) -> None:
        """Write the picture of a pane; :class:`OutputError` where that fails."""
        if not 16 <= width <= 16384 or not 16 <= height <= 16384:
            raise UsageError(f"A picture has 16 to 16384 pixels a side (asked: {width} x {height}).")
        from floorplan_core.files import output_file

        with output_file(path) as staging:
            if not self.picture(pane, width, height, scale_bar).save(str(staging), _picture_format(path)):
                raise OutputError(f"Cannot write the picture {path.name}.")
        if not self.unattended:
            self.tell(tr("Wrote {name}.").format(name=path.name))

    def copy_picture(self, pane: str) -> None:
        """The picture of a pane into the clipboard."""
        QGuiApplication.clipboard().setImage(self.picture(pane, 1600, 1200))
        self.tell(tr("The picture is in the clipboard."))

    def tell(self, text: str, kind: str = "info") -> None:
        """A sentence to the user, gone after a while; errors stay until they are clicked."""
        if kind != "info" or not self.unattended:  # nobody is there to read that all went well
            self.toast.tell(text, kind)

    # ---- what happens -----------------------------------------------------------------------------------

    def closeEvent(self, event: QCloseEvent) -> None:
        from floorcast_app.actions.file_actions import may_leave

        if not may_leave(self.workbench):
            event.ignore()
            return
        self._remember()
        self.workbench.jobs.cancel()
        self.workbench.planner.close()
        self.workbench.jobs.wait(LAST_WAIT)
        if self.recovery is not None:
            self.recovery.end()
        for dock in self.docks.values():
            stop = getattr(dock.widget(), "shut_down", None)
            if stop is not None:
                stop()
        super().closeEvent(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.escape()
            return
        super().keyPressEvent(event)

    def escape(self) -> None:
        """Esc: what runs is cancelled; else the tool is put down; else nothing is selected."""
        if self.workbench.jobs.running:
            self.workbench.try_run("plan.cancel")
        elif self.workbench.tool != "select":
            self.workbench.set_tool("select")
        else:
            self.workbench.selection.select(None)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if event.mimeData().hasUrls():
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        for url in event.mimeData().urls()[:1]:
            self.workbench.try_run("file.open", path=url.toLocalFile())

    def childEvent(self, event: QChildEvent) -> None:
        super().childEvent(event)
        if event.polished():
            self.dresser.welcome(event.child())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.empty.cover(self)
        self._proportions.window_resized()

    # ---- inside -----------------------------------------------------------------------------------------

    def _survey_changed(self) -> None:
        nothing = self.workbench.state.survey is None
        self.empty.setVisible(nothing)
        if nothing:
            self.empty.cover(self)
            self.empty.raise_()
        self._fitted = False

    def _plan_changed(self, plan: object) -> None:
        if plan is not None and not self._fitted:
            self._fitted = True
            QTimer.singleShot(0, lambda: self.workbench.plan is not None and self.workbench.run("view.fit"))

    def _look_changed(self, before: Look, after: Look) -> None:
        self.workbench.preferences.set("theme", after.theme)
        self.workbench.preferences.set("units", after.units)
        if before.theme != after.theme:
            self.dresser.change(after.theme)
        if before.workspace != after.workspace:
            self._keep_arrangement(before.workspace)
            self._arrange(after.workspace)

    def _preferred(self, name: str, value: Any) -> None:
        if name in ("theme", "units"):
            self.workbench.view.set(**{name: value})
        elif name == "recent":
            self.empty.refresh()

    def _arrange(self, workspace: str) -> None:
        kept = self._settings.value(f"workspace/{workspace}")
        before = [bar for bar in tab_bars(self) if bar.count()]
        restored = isinstance(kept, QByteArray) and self.restoreState(kept, DOCKS)
        for banner in (self.banner, self.missing, self.recovery):
            if banner is not None:
                banner.put_right()
        if not restored:
            arrange(self, self.docks, workspace)
            return
        self._proportions.recall(str(self._settings.value(f"workspace/{workspace}-sizes", "")))
        for bar in before:  # Qt makes new ones and forgets to take these away
            bar.hide()

    def _keep_arrangement(self, workspace: str) -> None:
        self._settings.setValue(f"workspace/{workspace}", self.saveState(DOCKS))
        self._settings.setValue(f"workspace/{workspace}-sizes", self._proportions.kept())

    def _retitle(self) -> None:
        survey, project = self.workbench.state.survey, self.workbench.project
        name = project.name if project else survey.path.name if survey else ""
        self.setWindowTitle(f"{name}[*] – Floorcast" if name else "Floorcast[*]")
        self.setWindowModified(self.workbench.has_edits)

    def _dock_of(self, id: str) -> QDockWidget:
        id = FORMER.get(id, id)
        if id not in self.docks:
            raise UsageError(f"There is no pane {id!r}; the panes are: {', '.join(self.docks)}.")
        return self.docks[id]

    def _dock(self, id: str, title: str, widget: QWidget) -> QDockWidget:
        dock = QDockWidget(tr(title), self)
        dock.setObjectName(id)
        dock.setWidget(widget)
        seen = getattr(widget, "seen", None)
        if seen is not None:
            dock.visibilityChanged.connect(seen)
        return dock

    def _fill_menus(self) -> None:
        menus = {menu: self.menuBar().addMenu(tr(MENU_TITLES[menu])) for menu in MENUS}
        inner: dict[str, QMenu] = {}
        for action in self.workbench.actions:
            menu = menus[action.id.partition(".")[0]]
            if action.id in NOT_IN_MENUS:
                continue
            if action.id in MENU_GROUPS:
                menu.addSeparator()
            title = next((t for prefix, t in SUBMENUS.items() if action.id.startswith(prefix)), "")
            if title and title not in inner:
                inner[title] = menu.addMenu(tr(title))
            inner.get(title, menu).addAction(self.actions_by_id[action.id])
            if action.id == "file.open_folder":
                menu.addMenu(self._recent_menu())
        panes = menus["view"].addMenu(tr("Panes"))
        for dock in self.docks.values():
            panes.addAction(dock.toggleViewAction())

    def _recent_menu(self) -> QMenu:
        menu = QMenu(tr("Open recent"), self)

        def fill() -> None:
            menu.clear()
            for path in self.recent.paths():
                menu.addAction(str(path), lambda p=path: self.workbench.try_run("file.open", path=p))
            menu.setDisabled(False)

        menu.aboutToShow.connect(fill)
        return menu

    def _window_picture(self, width: int, height: int) -> QImage:
        """The whole window; one smaller than it can be is scaled."""
        size, wanted = self.size(), QSize(width, height)
        self.resize(wanted)
        self._settle()
        image = self.grab().toImage()
        self._paint_space(image)
        self.resize(size)
        smooth = Qt.TransformationMode.SmoothTransformation
        return image if image.size() == wanted else image.scaled(wanted, mode=smooth)

    def _settle(self) -> None:
        """Let the panes show what holds now."""
        self.dresser.finish()
        end = time.monotonic() + LAST_WAIT
        while time.monotonic() < end:
            QApplication.processEvents()
            shown = (dock.widget() for dock in self.docks.values())
            if not self._proportions.busy and all(getattr(widget, "ready", True) for widget in shown):
                break
            time.sleep(0.01)

    def _paint_space(self, image: QImage) -> None:
        """The 3D pane draws in a thread, when it finds the time: a picture of it is drawn here and now."""
        space = self.docks["space"].widget()
        if space is None or not space.isVisible() or self.empty.isVisible():
            return
        painter = QPainter(image)
        painter.drawImage(
            space.mapTo(self, QPoint(0, 0)), self.picture("space", space.width(), space.height())
        )
        direct = Qt.FindChildOption.FindDirectChildrenOnly
        for child in space.findChildren(QWidget, options=direct):
            if child.isVisible():
                painter.drawPixmap(child.mapTo(self, QPoint(0, 0)), child.grab())
        painter.end()

    def _restore(self) -> None:
        geometry = self._settings.value("window/geometry")
        if isinstance(geometry, QByteArray):
            self.restoreGeometry(geometry)
        preferences = self.workbench.preferences
        self.workbench.view.set(theme=preferences["theme"], units=preferences["units"])
        self._arrange(self.workbench.view.look.workspace)

    def _remember(self) -> None:
        look = self.workbench.view.look
        self._settings.setValue("window/geometry", self.saveGeometry())
        self._keep_arrangement(look.workspace)


def _picture_format(path: Path) -> str:
    suffix = path.suffix.lower().lstrip(".")
    if suffix not in ("png", "jpg", "jpeg", "bmp", "webp"):
        raise UsageError(f"Pictures are written as .png, .jpg or .webp (asked: {path.name}).")
    return suffix.upper()
