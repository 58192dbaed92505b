"""The 3D pane: points, translucent planes, floors, doors and the path, drawn in threads beside the window."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEvent, QPoint, QRect, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QContextMenuEvent,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from floorcast_app.panels.item_menu import item_menu
from floorcast_app.rendering.cloud import Cloud, plan_origin, scene_matrix
from floorcast_app.rendering.cloud_loader import CloudLoader, CloudMaker, Loaded, Wanted
from floorcast_app.rendering.frame_worker import FrameWorker, Stage, Subject
from floorcast_app.rendering.renderer import Frame, Renderer
from floorcast_app.run_replay import scans_until
from floorcast_app.selection import Item
from floorcast_app.translation import tr
from floorcast_app.view_state import Look
from floorcast_app.viewports.plan_camera import framed
from floorcast_app.viewports.space_buttons import ViewButtons
from floorcast_app.viewports.space_overlay import Overlay, draw_message, draw_overlay
from floorcast_app.viewports.space_pointer import SpacePointer
from floorcast_app.workbench import Workbench
from floorplan_core.model import FloorPlan

Float = NDArray[np.float64]

POLL = 300  # ms between looks at the store while points come in
GROWTH = 1.25  # times the points that are shown, from which more are loaded
PATIENCE = 4.0  # times the seconds that loading took: reading must not be slowed down by showing it
PATH_HEIGHT = 1.2  # metres above the floor, where only the plan of the path is known
MOST_PATH = 4000  # corners of the path that are drawn
INSET = 12  # pixels from the corner of the pane to the buttons
AROUND = 1.1  # of the extent of the points, when they are brought into view before there is a plan
NO_PATH = np.zeros((0, 3))


class SpaceView(QWidget):
    """Listens to the workbench, asks a thread for frames, shows the last one."""

    _frame_done = Signal(object, bool)  # Frame, fine
    _points_done = Signal(object)  # Loaded

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workbench = workbench
        self.frame: Frame | None = None  # the picture that is shown
        self._image = QImage()
        self._loaded: Loaded | None = None
        self._wanted: Wanted | None = None
        self._load_began = self._load_took = 0.0
        self._path: tuple[FloorPlan | None, Float] = (None, NO_PATH)
        self._placed = False  # True once the points of this survey were brought into view
        self._pointer = SpacePointer(workbench, self)
        self._worker = FrameWorker(_emitting(self._frame_done))
        self._loader = CloudLoader(_emitting(self._points_done))
        self._frame_done.connect(self._show_frame)
        self._points_done.connect(self._points_loaded)
        self._poll = QTimer(self, interval=POLL)
        self._poll.timeout.connect(self._look_for_points)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName(tr("3D view"))
        self.buttons = ViewButtons(workbench, self)
        self._listen()
        self._want_points()

    def sizeHint(self) -> QSize:
        return QSize(640, 440)

    def minimumSizeHint(self) -> QSize:
        return QSize(160, 120)

    def picture(self, width: int, height: int) -> QImage:
        """The pane as an image of ``width`` x ``height`` pixels, with all points, drawn here and now."""
        wanted = self._wanted_now()
        loaded = self._loaded if self._shows(wanted) else CloudMaker().load(wanted)
        subject = self.subject(width, height, loaded)
        frame = Renderer().render(Stage().request(subject), fine=True)
        assert frame is not None  # nobody stops it
        image = _image_of(frame)
        painter = QPainter(image)
        draw_overlay(painter, self._overlay(frame, subject), width, height)
        painter.end()
        return image

    def shut_down(self) -> None:
        """Stop listening and drawing; the window calls it when it closes."""
        self._poll.stop()
        self._worker.close()
        self._loader.close()
        for event, listener in self._bound:
            event.disconnect(listener)

    # ---- what is shown ----------------------------------------------------------------------------------

    def _listen(self) -> None:
        w = self.workbench
        self._bound = (
            (w.plan_changed, lambda _plan: self._want_points()),
            (w.points_changed, self._want_points),
            (w.survey_changed, self._survey_changed),
            (w.view.changed, self._look_changed),
            (w.selection.changed, self._ask),
            (w.selection.hover_changed, self._ask),
            (w.jobs.started, lambda _text: self._poll.start()),
        )
        for event, listener in self._bound:
            event.connect(listener)
        bound, worker, loader = self._bound, self._worker, self._loader

        def gone() -> None:  # the widget is no more: only what it left behind may be touched
            worker.close()
            loader.close()
            for event, listener in bound:
                event.disconnect(listener)

        self.destroyed.connect(gone)

    def _look_changed(self, before: Look, after: Look) -> None:
        if (before.point_colour, before.theme) != (after.point_colour, after.theme):
            self._want_points()
        if before.theme != after.theme:
            self.buttons.wear(after.theme)
        self._ask()

    def _survey_changed(self) -> None:
        self._placed = False
        self._want_points()

    def _wanted_now(self) -> Wanted:
        w = self.workbench
        look, session = w.view.look, w.session
        scans = None if session is None else scans_until(session.reconstruction, w.moment)
        return Wanted(w.points, w.plan, look.point_colour, look.theme, self._origin(), scans)

    def _origin(self) -> tuple[float, float, float]:
        session = self.workbench.session
        return plan_origin(
            self.workbench.plan, None if session is None else session.reconstruction.local_frame
        )

    def _want_points(self) -> None:
        """Load points and colours as they should be now; until then the old ones stay."""
        self._wanted = self._wanted_now()
        if self._loaded is not None and self._loaded.wanted.store is not self._wanted.store:
            self._loaded = None
        self._load_began = time.perf_counter()
        self._loader.want(self._wanted)
        self._ask()

    def _look_for_points(self) -> None:
        """While a job reads: show more points now and then."""
        if not self.workbench.jobs.running:
            self._poll.stop()
        shown = 0 if self._loaded is None else self._loaded.read
        rested = time.perf_counter() - self._load_began > PATIENCE * self._load_took
        if rested and not self._loader.busy and len(self.workbench.points) > GROWTH * shown:
            self._want_points()

    def _points_loaded(self, loaded: Loaded) -> None:
        if not loaded.wanted.same(self._wanted):
            return
        self._loaded = loaded
        if len(loaded.cloud):  # the first time imports and compiles, and tells nothing
            self._load_took = time.perf_counter() - self._load_began
        if not self._placed and len(loaded.cloud):
            self._place(loaded.cloud)
        self._ask()

    def _place(self, cloud: Cloud) -> None:
        """Bring the first points of a survey into view; a plan is brought into view by the window."""
        self._placed = True
        if self.workbench.plan is None:
            self.workbench.view.set(**framed(cloud.extent, AROUND))

    def _shows(self, wanted: Wanted) -> bool:
        loaded = self._loaded
        return loaded is not None and wanted.same(loaded.wanted) and loaded.read == len(wanted.store)

    def subject(self, width: int, height: int, loaded: Loaded | None = None) -> Subject:
        """What is to be seen in a picture of ``width`` x ``height`` pixels, with the points loaded so far."""
        w, loaded = self.workbench, loaded or self._loaded
        return Subject(
            w.view.look,
            width,
            height,
            self.devicePixelRatioF(),
            w.plan,
            w.selection.items,
            w.selection.hovered,
            self._path_now(),
            loaded.cloud if loaded is not None else None,
            loaded.paint if loaded is not None else None,
        )

    def _path_now(self) -> Float | None:
        """(M, 3) the trajectory in the scene, kept as long as the plan stays."""
        plan, session = self.workbench.plan, self.workbench.session
        if plan is None:
            return None
        if self._path[0] is not plan:
            flown = None if session is None else session.reconstruction.trajectory
            if flown is not None and len(flown) == len(plan.trajectory):  # not a moment of a run
                matrix = scene_matrix(plan, origin=self._origin())
                path = flown.origins @ matrix[:, :3].T + matrix[:, 3]
            else:
                path = np.column_stack([plan.trajectory, np.full(len(plan.trajectory), PATH_HEIGHT)])
            self._path = (plan, path[:: max(len(path) // MOST_PATH, 1)])
        return self._path[1]

    def _ask(self) -> None:
        if self.isVisible() and self.width() > 1 and self.height() > 1:
            self._worker.ask(self.subject(self.width(), self.height()))

    def _show_frame(self, frame: Frame, fine: bool) -> None:
        self.frame, self._image = frame, _image_of(frame)
        self.update()

    # ---- painting ---------------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        if self.frame is None:
            painter.fillRect(self.rect(), self.palette().window())
            draw_message(painter, self._message(), self.workbench.view.look, self.width(), self.height())
        else:
            painter.drawImage(QRectF(self.rect()), self._image)
            subject = self.subject(self.width(), self.height())
            draw_overlay(painter, self._overlay(self.frame, subject), self.width(), self.height())
        if self.hasFocus():
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(self.palette().highlight().color())
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(QRect(QPoint(0, 0), self.size() - QSize(1, 1)))

    def _overlay(self, frame: Frame, subject: Subject) -> Overlay:
        request = frame.request
        drawn = frame.points > 0
        return Overlay(
            request.look,
            request.scene.labels,
            subject.selected,
            subject.hovered,
            request.paint if drawn else None,
            self._message(),
            drawn or request.scene.bounds is not None,
        )

    def _message(self) -> str:
        w = self.workbench
        if w.plan is not None or len(w.points):
            return ""
        if w.jobs.running:
            return tr("Points appear here as they are read")
        return "" if w.state.survey is not None else tr("Open a survey to see its points here")

    # ---- events -----------------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:
        self.buttons.move(self.width() - self.buttons.width() - INSET, INSET)
        self._ask()

    def showEvent(self, event: QShowEvent) -> None:
        self._ask()

    def closeEvent(self, event: QCloseEvent) -> None:
        self._poll.stop()
        super().closeEvent(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._pointer.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._pointer.move(event)
        if self._pointer.dragging:
            self.setCursor(Qt.CursorShape.ClosedHandCursor)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.unsetCursor()
        item = self._pointer.release(event)
        if item is not None:
            self._open_menu(item, event.position().toPoint())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        self._pointer.double_click()

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._pointer.wheel(event)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if not self._pointer.key(event):
            super().keyPressEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        self._pointer.leave()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        item = self.workbench.selection.item
        if event.reason() == QContextMenuEvent.Reason.Keyboard and item is not None:
            self._open_menu(item, self.rect().center())

    def _open_menu(self, item: Item, at: QPoint) -> None:
        if item not in self.workbench.selection.items:
            self.workbench.selection.select(item)
        item_menu(self.workbench, item, self).popup(self.mapToGlobal(at))


def _image_of(frame: Frame) -> QImage:
    """A picture that owns its memory."""
    height, width = frame.image.shape
    return QImage(frame.image.data, width, height, 4 * width, QImage.Format.Format_RGB32).copy()


def _emitting(signal: object) -> object:
    """A function for a thread that emits ``signal``; nothing happens once the widget is gone."""

    def emit(*values: object) -> None:
        try:
            signal.emit(*values)  # type: ignore[attr-defined]
        except RuntimeError:
            return

    return emit
