"""The window: docks of panes, menus and a toolbar of actions, a status bar. What they do is elsewhere."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from PySide6.QtCore import QByteArray, QChildEvent, QLocale, QPoint, QSettings, QSize, Qt, QTimer
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
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QTabWidget, QWidget

from floorcast_app.dialogs.base import Dialog
from floorcast_app.dialogs.preferences import PreferencesDialog
from floorcast_app.dialogs.thumbnails import ThumbnailKeeper, plan_png
from floorcast_app.dock_layout import Proportions, TitleBars, arrange, tab_bars
from floorcast_app.dressing import Dresser
from floorcast_app.menus import fill_menus
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
from floorcast_app.translation import install_translator, tr
from floorcast_app.view_state import Look
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.workbench import Workbench
from floorplan_core.errors import OutputError, UsageError

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
        self.docks = {pane.id: self._dock(pane.id) for pane in PANES}
        self._titles = TitleBars(self, self.docks)
        self._proportions = Proportions(self, self.docks)
        self.toast = Toast(self)
        self._fill()
        self.addToolBar(self.toolbar)
        self.banner = None if unattended else AssumptionsBanner(workbench, self)
        self.missing = None if unattended else MissingBanner(workbench, self)
        self.recovery = None if unattended else RecoveryBanner(workbench, self)
        for banner in (self.banner, self.missing, self.recovery):
            if banner is not None:
                banner.moved.connect(lambda: self.empty.cover(self))
        self._keeper = None if unattended else ThumbnailKeeper(self)
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

    def speak(self, language: str) -> None:
        """Say everything in another language from now on; what is open, done and running stays.

        What has words is made anew, in the docks as they stand.
        """
        before, app = QLocale().name(), QApplication.instance()
        assert isinstance(app, QApplication)
        install_translator(app, language)
        if QLocale().name() == before:
            return
        dialogs = self.findChildren(Dialog)
        old = [*(dock.widget() for dock in self.docks.values()), self.toolbar, self.empty, *dialogs]
        old += [action.menu() for action in self.menuBar().actions()]  # not the one that Qt made itself
        bar = self.toolbar
        self._stop_panes()
        self.actions_by_id.reword()
        self._fill()
        self.insertToolBar(bar, self.toolbar)
        self.removeToolBar(bar)
        self._proportions.put_back()
        self._cover()
        for widget in old:
            widget.hide()
            widget.deleteLater()
        if any(isinstance(dialog, PreferencesDialog) for dialog in dialogs):
            self.workbench.ui.show("preferences")

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
        self._stop_panes()
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
        self._cover()
        self._fitted = False

    def _cover(self) -> None:
        """The empty state lies over the panes where there is no survey."""
        nothing = self.workbench.state.survey is None
        self.empty.setVisible(nothing)
        if nothing:
            self.empty.cover(self)
            self.empty.raise_()

    def _stop_panes(self) -> None:
        for dock in self.docks.values():
            stop = getattr(dock.widget(), "shut_down", None)
            if stop is not None:
                stop()

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
        elif name == "language":  # when the menu or dialog that asked for it has had its say
            QTimer.singleShot(0, self, lambda: self.speak(str(value)))

    def _arrange(self, workspace: str) -> None:
        self._proportions.start_anew()
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

    def _dock(self, id: str) -> QDockWidget:
        dock = QDockWidget(self)
        dock.setObjectName(id)
        return dock

    def _fill(self) -> None:
        """Make what has words: panes, menus, toolbar, status bar, and what is said without a survey."""
        for pane in PANES:
            dock, widget = self.docks[pane.id], pane.make(self.workbench)
            dock.setWindowTitle(tr(pane.title))
            dock.setWidget(widget)
            seen = getattr(widget, "seen", None)
            if seen is not None:
                dock.visibilityChanged.connect(seen)
                seen(not dock.visibleRegion().isEmpty())
        fill_menus(self)
        self.toolbar = MainToolbar(self.workbench, self.actions_by_id, self)
        self.status = StatusBar(self.workbench, self)
        self.setStatusBar(self.status)
        self.empty = EmptyState(self.workbench, self.recent, self)

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
        self._settings.sync()


def _picture_format(path: Path) -> str:
    suffix = path.suffix.lower().lstrip(".")
    if suffix not in ("png", "jpg", "jpeg", "bmp", "webp"):
        raise UsageError(f"Pictures are written as .png, .jpg or .webp (asked: {path.name}).")
    return suffix.upper()
