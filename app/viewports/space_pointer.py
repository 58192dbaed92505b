"""What mouse and keys do in the 3D pane: orbit, pan, zoom, pick. They change look and selection only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent

from floorcast_app.rendering.camera import FRONT, SIDE, TOP, Camera, camera_of, orbited, panned, zoomed
from floorcast_app.rendering.picking import pick
from floorcast_app.rendering.renderer import Frame
from floorcast_app.selection import Item
from floorcast_app.view_state import Look

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

Float = NDArray[np.float64]

CLICK_REACH = 4.0  # pixels that the pointer may move between press and release of a click
NOTCH = 120.0  # units of a wheel's notch
PAN_KEY, ORBIT_KEY = 60.0, 30.0  # pixels that an arrow key stands for
FARTHEST = 4.0  # camera distances: the floor near the horizon is no place to zoom to
ZOOMS = {Qt.Key.Key_Plus: 1.0, Qt.Key.Key_Equal: 1.0, Qt.Key.Key_Minus: -1.0}  # notches
VIEWS = {Qt.Key.Key_1: FRONT, Qt.Key.Key_3: SIDE, Qt.Key.Key_7: TOP}
ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}


class Pane(Protocol):
    """What the gestures ask of the pane."""

    @property
    def frame(self) -> Frame | None: ...  # the picture that it shows
    def width(self) -> int: ...  # pixels
    def height(self) -> int: ...


class SpacePointer:
    """One gesture at a time; positions are pixels of the pane."""

    def __init__(self, workbench: Workbench, pane: Pane) -> None:
        self._workbench, self._pane = workbench, pane
        self._pressed: QPointF | None = None  # where the button went down
        self._last = QPointF()
        self._pans = self._moved = False
        self._clicked: QPointF | None = None  # the last click: a second one there picks what lies behind

    @property
    def dragging(self) -> bool:
        """True while the camera follows the pointer."""
        return self._pressed is not None and self._moved

    def press(self, event: QMouseEvent) -> None:
        """A button goes down: a click or a drag begins."""
        shift = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        self._pressed = self._last = event.position()
        self._pans = event.button() == Qt.MouseButton.MiddleButton or (
            event.button() == Qt.MouseButton.RightButton or shift
        )
        self._moved = False

    def move(self, event: QMouseEvent) -> None:
        """The pointer moves: drag the camera, or light up what is under it."""
        at, view = event.position(), self._workbench.view
        if self._pressed is None:
            self._hover(at)
            return
        if not self._moved and (at - self._pressed).manhattanLength() <= CLICK_REACH:
            return
        self._moved = True
        step, self._last = at - self._last, at
        if self._pans:
            view.set(**panned(view.look, *self._size, step.x(), step.y()))
        else:
            view.set(**orbited(view.look, step.x(), step.y()))

    def release(self, event: QMouseEvent) -> Item | None:
        """The button comes up: a click selects. The item, where its menu is asked for by the right button."""
        click = self._pressed is not None and not self._moved
        self._pressed = None
        if click and event.button() == Qt.MouseButton.LeftButton:
            self._click(event)
        if click and event.button() == Qt.MouseButton.RightButton:
            return self.item_at(event.position())
        return None

    def double_click(self) -> None:
        """Bring what the first click selected into view."""
        if self._workbench.selection.item is not None:
            self._workbench.selection.zoom_asked.emit(self._workbench.selection.item)

    def wheel(self, event: QWheelEvent) -> None:
        """Zoom to the pointer."""
        delta = event.angleDelta().y() or event.angleDelta().x()
        x, y = event.position().x(), event.position().y()
        self._zoom(x, y, anchor_at(self._pane.frame, self._camera(), x, y), delta / NOTCH)

    def key(self, event: QKeyEvent) -> bool:
        """1, 3, 7: front, side, top; arrows orbit, with Shift pan; + and - zoom. False: none of these."""
        view, key = self._workbench.view, event.key()
        if event.modifiers() & (Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier):
            return False
        if key in VIEWS:
            azimuth, elevation = VIEWS[key]
            view.set(azimuth=azimuth, elevation=elevation)
        elif key in ARROWS and event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            dx, dy = ARROWS[key]
            view.set(**panned(view.look, *self._size, -dx * PAN_KEY, -dy * PAN_KEY))
        elif key in ARROWS:
            dx, dy = ARROWS[key]
            view.set(**orbited(view.look, dx * ORBIT_KEY, dy * ORBIT_KEY))
        elif key in ZOOMS:
            width, height = self._size
            self._zoom(width / 2, height / 2, self._camera().target, ZOOMS[key])
        else:
            return False
        return True

    def item_at(self, at: QPointF, behind: Item | None = None) -> Item | None:
        """What the picture shows at a place; what lies behind ``behind`` where that is there."""
        frame = self._pane.frame
        if frame is None:
            return None
        return pick(frame.request.scene, self._camera(frame.request.look), at.x(), at.y(), behind)

    def leave(self) -> None:
        """The pointer is outside of the pane."""
        if self._pressed is None:
            self._workbench.selection.hover(None)
            self._workbench.pointer_moved.emit(None, None)

    def _hover(self, at: QPointF) -> None:
        self._workbench.selection.hover(self.item_at(at))
        floor = self._camera().on_level(at.x(), at.y())
        if floor is not None and self._workbench.plan is not None:
            self._workbench.pointer_moved.emit(float(floor[0]), float(floor[1]))

    def _click(self, event: QMouseEvent) -> None:
        """Select what is nearest under the pointer; clicked again at the same place, what lies behind it."""
        selection, at = self._workbench.selection, event.position()
        again = self._clicked is not None and (at - self._clicked).manhattanLength() <= CLICK_REACH
        self._clicked = at
        add = event.modifiers() & (Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
        selection.select(self.item_at(at, selection.item if again else None), bool(add))

    def _zoom(self, x: float, y: float, anchor: Float, steps: float) -> None:
        view = self._workbench.view
        view.set(**zoomed(view.look, *self._size, x, y, anchor, steps))

    def _camera(self, look: Look | None = None) -> Camera:
        return camera_of(look or self._workbench.view.look, *self._size)

    @property
    def _size(self) -> tuple[int, int]:
        return self._pane.width(), self._pane.height()


def anchor_at(frame: Frame | None, camera: Camera, x: float, y: float) -> Float:
    """(3,) the scene point under a pixel: the nearest point, else the floor, else at the target's depth."""
    if frame is not None and (depth := _depth_at(frame, camera, x, y)) is not None:
        return camera_of(frame.request.look, camera.width, camera.height).at_depth(x, y, depth)
    floor = camera.on_level(x, y)
    if floor is not None and np.linalg.norm(floor - camera.eye) < FARTHEST * camera.distance:
        return floor
    return camera.at_depth(x, y, camera.distance)


def _depth_at(frame: Frame, camera: Camera, x: float, y: float) -> float | None:
    """Metres in front of the eye; None where no point was drawn. The frame may have other pixels."""
    rows, columns = frame.inverse.shape
    row, column = int(y * rows / camera.height), int(x * columns / camera.width)
    if not (0 <= row < rows and 0 <= column < columns) or frame.inverse[row, column] <= 0:
        return None
    return 1.0 / float(frame.inverse[row, column])
