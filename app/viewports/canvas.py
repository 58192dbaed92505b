"""A pane that shows the plan from above: layers, shared camera, selection and hover, and the tool in hand.

The layers are painted once into a pixmap that is kept until camera, plan, look or theme change; what changes
with the pointer (hover, selection, the tool's marks) is painted over it. Hits are looked up in arrays, by
the distance to a line in pixels. No QGraphicsView: with an item for each line, 4,000 runs of 400 planes took
39 ms of processor time a frame there; here they take 35 ms together with 200,000 points (benchmarks/ui_plan).
"""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPixmap,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from floorcast_app import theme
from floorcast_app.actions.view_actions import pictured
from floorcast_app.layers.partial import partial_layer
from floorcast_app.panels.item_menu import item_menu
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import At, Point, Tool
from floorcast_app.translation import tr
from floorcast_app.view_state import Look, turned_only
from floorcast_app.viewports.cursors import show_cursor
from floorcast_app.viewports.listening import listen, stop_listening
from floorcast_app.viewports.plan_builder import Drawing, PlanBuilder
from floorcast_app.viewports.plan_camera import STEP, Camera, framed, panned, zoomed
from floorcast_app.viewports.plan_checks import check_at, paint_checks
from floorcast_app.viewports.plan_floor_views import DimensionsView, NamesView
from floorcast_app.viewports.plan_frame import BODY, Frame, colour, draw_text
from floorcast_app.viewports.plan_layers import LAYER_KINDS, LayerView, paint_layers
from floorcast_app.viewports.plan_overlay import (
    draw_shifted,
    paint_compass,
    paint_cross,
    paint_hint,
    paint_item,
    paint_marks,
    paint_pins,
)
from floorcast_app.viewports.plan_scale import paint_scale
from floorcast_app.workbench import Workbench

HIT = 6.0  # pixels around a line within which it is hit
CLICK = 4.0  # pixels that a click may move
SETTLE = 60  # ms that other panes than the one under the pointer wait for the camera to rest
AROUND_PLAN = 1.4  # how much more than a plan that is being made is shown
KEYS = {Qt.Key.Key_Return: "Enter", Qt.Key.Key_Enter: "Enter", Qt.Key.Key_Backspace: "Backspace"}


class PlanCanvas(QWidget):
    """Base of the plan panes; they say which layers they have and what can be hit in them."""

    kinds: tuple[str, ...] = ()  # names in LAYER_KINDS, from the ground up
    hits: tuple[str, ...] = ("door", "plane", "region")
    dotted = False  # planes are hit all along
    lit = ("region", "door", "plane", "segment")  # kinds of items that light up here
    pins = False  # corrected things carry a pin
    empty = "No plan yet."

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workbench = workbench
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 90)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._drawing: Drawing | None = None
        self._partial: dict[str, LayerView] = {}  # what is known of the first plan while it is made
        self._base: QPixmap | None = None
        self._base_camera: Camera | None = None  # that of the base
        self._settle = QTimer(self, singleShot=True, interval=SETTLE)
        self._settle.timeout.connect(self._refresh)
        self._press: tuple[QPointF, Qt.MouseButton] | None = None
        self._last = QPointF()
        self._moved = False
        self._space = False
        self._inside = False  # the pointer is over this pane
        self._pointer: Point | None = None  # where the pointer is in another pane
        self._builder = PlanBuilder(self.kinds, self)
        self._builder.built.connect(self._show)
        self._builder.failed.connect(lambda text: workbench.ui.tell(text, "error"))
        self._listen()
        if workbench.plan is not None:
            self._builder.build(workbench.plan)

    # ---- what it shows ----------------------------------------------------------------------------------

    @property
    def ready(self) -> bool:
        """True where no plan is on its way to be shown, and none is shown as another camera had it."""
        return not self._builder.busy and not self._settle.isActive()

    @property
    def camera(self) -> Camera:
        """Plan metres to pixels of this widget."""
        return Camera.of(self.workbench.view.look, self.width(), self.height())

    def picture(self, width: int, height: int, scale_bar: bool | None = None) -> QImage:
        """The pane as an image of ``width`` x ``height`` pixels; None: a scale bar where the look has it."""
        self._catch_up()
        image = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
        look = pictured(self.workbench, self._look(), (width, height), scale_bar)
        frame = Frame(Camera.of(look, width, height), theme.colours(), look)
        painter = QPainter(image)
        self._paint_ground(painter, frame)
        self._paint_over(painter, frame, interactive=False)
        painter.end()
        return image

    def _catch_up(self) -> None:
        """Build what is missing, here and now."""
        plan = self.workbench.plan
        shown = self._drawing.source.plan if self._drawing is not None else None
        if plan is not shown:
            self._show(self._builder.build_now(plan) if plan is not None else None)

    def _look(self) -> Look:
        return self.workbench.view.look

    def ground(self, frame: Frame) -> QColor:
        """Behind the layers."""
        return colour(frame.colours.canvas)

    # ---- listening --------------------------------------------------------------------------------------

    def _listen(self) -> None:
        w = self.workbench
        self._bound = (
            (w.plan_changed, self._plan_changed),
            (w.partial, self._stage_done),
            (w.view.changed, self._look_changed),
            (w.selection.changed, self.update),
            (w.selection.hover_changed, self.update),
            (w.document.changed, lambda before, after: self.update()),
            (w.toolbox.changed, self._tool_changed),
            (w.pointer_moved, self._pointer_moved),
            (theme.changed, lambda name: self._refresh()),
        )
        listen(self, self._bound)

    def shut_down(self) -> None:
        """Stop listening; the window calls it when it closes."""
        self._builder.drop()
        stop_listening(self._bound)

    def _plan_changed(self, plan: object) -> None:
        if self.workbench.plan is None:
            self._builder.drop()
            self._show(None)
        else:
            self._builder.build(self.workbench.plan)

    def _stage_done(self, stage: str, result: object) -> None:
        """Show what a stage of the first plan found; a plan that is shown stays until the next is whole."""
        found = partial_layer(result) if self.workbench.plan is None else None
        if found is None or found[0] not in self.kinds:
            return
        kind, model, bounds = found
        if not self._partial and self.workbench.project is None:
            self.workbench.view.set(**framed(bounds, AROUND_PLAN))  # type: ignore[arg-type]
        self._partial[kind] = LAYER_KINDS[kind].view(model)
        self._refresh()

    def _show(self, drawing: Drawing | None) -> None:
        self._drawing, self._partial = drawing, {}
        self._refresh()

    def _look_changed(self, before: Look, after: Look) -> None:
        """Panes beside the one that is moved shift their picture, and paint it anew at intervals."""
        moved_only = replace(before, centre=after.centre, span=after.span) == after
        if moved_only and self._base is not None and not self._inside:
            if not self._settle.isActive():
                self._settle.start()
            self.update()
        elif not turned_only(before, after):
            self._refresh()

    def _tool_changed(self) -> None:
        show_cursor(self, self.workbench.toolbox.tool.cursor)
        self.update()

    def _pointer_moved(self, x: float | None, y: float | None) -> None:
        mine = self._inside or x is None or y is None
        self._pointer = None if mine else (x, y)  # type: ignore[assignment]
        self.update()

    def _refresh(self) -> None:
        self._settle.stop()
        self._base = None
        self.update()

    # ---- painting ---------------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        ratio = self.devicePixelRatioF()
        frame = Frame(self.camera, theme.colours(), self._look(), ratio)
        if self._base is None or self._base.size() != self.size() * ratio:
            self._base, self._base_camera = QPixmap(self.size() * ratio), frame.camera
            self._base.setDevicePixelRatio(ratio)
            painter = QPainter(self._base)
            self._paint_ground(painter, frame)
            painter.end()
        painter = QPainter(self)
        if self._base_camera is None or self._base_camera == frame.camera:
            painter.drawPixmap(0, 0, self._base)
        else:
            painter.fillRect(self.rect(), self.ground(frame))
            draw_shifted(painter, frame, self._base, self._base_camera)
        self._paint_over(painter, frame, interactive=True)
        painter.end()

    def _paint_ground(self, painter: QPainter, frame: Frame) -> None:
        painter.fillRect(
            0, 0, math.ceil(frame.camera.width), math.ceil(frame.camera.height), self.ground(frame)
        )
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        views = self._drawing.views if self._drawing is not None else self._partial
        paint_layers(painter, frame, views)

    def _paint_over(self, painter: QPainter, frame: Frame, interactive: bool) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._drawing is None and self._partial:
            paint_scale(painter, frame)
            return
        if self._drawing is None:
            draw_text(painter, tr(self.empty), frame.camera.middle, BODY, colour(frame.colours.muted))
            return
        source, selection = self._drawing.source, self.workbench.selection
        for item in selection.items:
            if item.kind in self.lit:
                paint_item(painter, frame, source, item, True)
        if interactive and selection.hovered is not None and selection.hovered.kind in self.lit:
            paint_item(painter, frame, source, selection.hovered, False)
        views = self._drawing.views
        names = view.blocks(frame) if isinstance(view := views.get("names"), NamesView) else {}
        paint_checks(painter, frame, self.workbench, tuple(names.values()))
        if self.pins:
            corrected = tuple(Item(kind, id) for kind, id in getattr(source.plan, "corrected", ()))
            paint_pins(painter, frame, source, corrected, names)
        shown = views.get("dimensions") if "dimensions" in frame.look.layers else None
        paint_scale(painter, frame, source, shown.model.rows if isinstance(shown, DimensionsView) else ())
        paint_compass(painter, frame, source)
        if interactive:
            self._paint_tool(painter, frame)

    def _paint_tool(self, painter: QPainter, frame: Frame) -> None:
        toolbox = self.workbench.toolbox
        paint_marks(painter, frame, toolbox.marks())
        if self._pointer is not None:
            paint_cross(painter, frame, self._pointer)
        if toolbox.tool.hint and (self._inside or self.hasFocus()):
            paint_hint(painter, frame, tr(toolbox.tool.hint))

    # ---- what lies where --------------------------------------------------------------------------------

    def item_at(self, position: QPointF, kinds: tuple[str, ...] = Tool.lights) -> Item | None:
        """The thing at a pixel of this widget, of the kinds asked for."""
        if self._drawing is None:
            return None
        camera = self.camera
        x, y = camera.to_plan(position.x(), position.y())
        reach = HIT / camera.scale
        check = check_at(self.workbench, x, y, reach)
        if check is not None and "check" in kinds:
            return check
        wanted = tuple(kind for kind in self.hits if kind in kinds)
        dotted = self.dotted and self.workbench.tool == "select"
        return self._drawing.source.hits.at(x, y, reach, self._look(), wanted, dotted)

    def _at(self, event: QMouseEvent) -> At:
        camera, keys = self.camera, event.modifiers()
        x, y = camera.to_plan(event.position().x(), event.position().y())
        return At(
            x,
            y,
            camera.scale,
            self.item_at(event.position(), self.workbench.toolbox.tool.lights),
            bool(keys & Qt.KeyboardModifier.ShiftModifier),
            bool(keys & (Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.MetaModifier)),
        )

    # ---- mouse ------------------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self._press, self._last, self._moved = (event.position(), event.button()), event.position(), False
        if event.button() == Qt.MouseButton.LeftButton and not self._space and self._drawing is not None:
            self.workbench.toolbox.press(self._at(event))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._inside, self._pointer = True, None
        here = self.camera.to_plan(event.position().x(), event.position().y())
        self.workbench.pointer_moved.emit(*here)
        if self._press is None:
            at = self._at(event)
            self.workbench.selection.hover(at.item)
            self.workbench.toolbox.move(at)
            show_cursor(self, self.workbench.toolbox.tool.cursor_at(at))
            return
        start, button = self._press
        if not self._moved and (event.position() - start).manhattanLength() <= CLICK:
            return
        self._moved = True
        if button == Qt.MouseButton.LeftButton and not self._space and self.workbench.toolbox.tool.drags:
            self.workbench.toolbox.drag(self._at(event))
        else:
            self._pan(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        press, self._press = self._press, None
        if press is None or press[1] != event.button():
            return
        if event.button() == Qt.MouseButton.LeftButton and not self._space and self._drawing is not None:
            self.workbench.toolbox.release(self._at(event), self._moved)
        elif event.button() == Qt.MouseButton.RightButton and not self._moved:
            self._open_menu(event.position().toPoint())
        self._tool_changed()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            return
        at = self._at(event)
        if not self.workbench.toolbox.double(at) and self.workbench.tool == "select" and at.item is not None:
            self.workbench.selection.zoom_asked.emit(at.item)
        self._press = None

    def wheelEvent(self, event: QWheelEvent) -> None:
        notches = event.angleDelta().y() / 120
        if notches:
            at = (event.position().x(), event.position().y())
            self.workbench.view.set(**zoomed(self._look(), self.camera, STEP**notches, at))
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        self._inside = False
        self.workbench.selection.hover(None)
        self.workbench.pointer_moved.emit(None, None)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        if event.reason() == QContextMenuEvent.Reason.Keyboard:  # the mouse opens it when it lets go
            self._open_menu(QPoint(self.width() // 2, self.height() // 2))

    def _pan(self, position: QPointF) -> None:
        moved, self._last = position - self._last, position
        self.setCursor(Qt.CursorShape.ClosedHandCursor)
        self.workbench.view.set(**panned(self._look(), self.camera, moved.x(), moved.y()))

    def _open_menu(self, position: QPoint) -> None:
        """What can be done with the thing here; nothing where nothing lies."""
        item = self.item_at(QPointF(position))
        if self.workbench.toolbox.cancel() or item is None:
            return
        if item not in self.workbench.selection.items:
            self.workbench.selection.select(item)
        item_menu(self.workbench, item, self).popup(self.mapToGlobal(position))

    # ---- keys -------------------------------------------------------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Keys that the tool waits for are not shortcuts meanwhile."""
        if event.type() == QEvent.Type.ShortcutOverride and self._wants(event):  # type: ignore[arg-type]
            event.accept()
            return True
        return super().event(event)

    def _wants(self, event: QKeyEvent) -> bool:
        escape = event.key() == Qt.Key.Key_Escape
        return self.workbench.toolbox.busy and (escape or event.key() in KEYS or event.text().isdigit())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape and self.workbench.toolbox.cancel():
            return
        if event.key() == Qt.Key.Key_Space and not self.workbench.toolbox.busy:
            self._space = True
            self.setCursor(Qt.CursorShape.OpenHandCursor)
            return
        plain = not event.modifiers() & (
            Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
        )
        key = KEYS.get(Qt.Key(event.key()), event.text())
        if not (plain and key and self.workbench.toolbox.key(key)):
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._space = False
            self._tool_changed()
        super().keyReleaseEvent(event)
