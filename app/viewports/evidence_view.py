"""Door evidence: histogram, gradient and filter response along the chosen plane, with what was detected."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from PySide6.QtCore import QEvent, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QToolButton, QWidget

from floorcast_app import format, theme
from floorcast_app.layers.evidence import EvidenceLayer, evidence_layer
from floorcast_app.selection import Item
from floorcast_app.theme import Colours
from floorcast_app.translation import tr, tr_n
from floorcast_app.view_state import turned_only
from floorcast_app.viewports.evidence_tracks import (
    paint_gradient,
    paint_histogram,
    paint_label,
    paint_response,
    track_x,
)
from floorcast_app.viewports.listening import listen, stop_listening
from floorcast_app.viewports.plan_camera import STEP
from floorcast_app.viewports.plan_frame import (
    BODY,
    SMALL,
    colour,
    draw_text,
    font,
    pen,
    round_length,
    text_size,
)
from floorcast_app.viewports.plan_observed_views import plane_colour
from floorcast_app.workbench import Workbench
from floorplan_core.drawing_style import METRES_PER_FOOT
from floorplan_core.model import Door

LEFT, RIGHT, TOP, BOTTOM, GAP = 44.0, 14.0, 52.0, 34.0, 10.0  # pixels around and between the tracks
EDGE = 16.0  # pixels left of the title
TICKS = 70.0  # pixels that a metre tick takes at least
AROUND = 3.0  # metres shown beside a selected door
NEAREST = 0.5  # metres: closer in there is nothing to see
BESIDE = 0.6  # metres from the plane at which the pointer of a plan pane is still shown
CLICK = 4.0  # pixels that a click may move


class EvidenceView(QWidget):
    """Three tracks over one axis in metres."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.workbench = workbench
        self.setMouseTracking(True)
        self.setMinimumSize(220, 180)
        self.evidence: EvidenceLayer | None = None
        self._face = 0
        self._shown = (0.0, 1.0)  # metres along the plane
        self._cursor: float | None = None  # metres along the plane
        self._inside = False  # the pointer is over this pane
        self._press: QPointF | None = None
        self._last = QPointF()
        self.other = QToolButton(self)
        self.other.setText(tr("Other face"))
        self.other.setProperty("role", "small")
        self.other.setToolTip(tr("Show the evidence on the other face of the wall"))
        self.other.clicked.connect(self.turn)
        w = workbench
        self._bound = (
            (w.plan_changed, self._plan_changed),
            (w.selection.changed, self._selected),
            (w.selection.hover_changed, self.update),
            (w.pointer_moved, self._pointer_moved),
            (w.view.changed, self._look_changed),
            (theme.changed, self._look_changed),
        )
        listen(self, self._bound)
        self._selected()

    def shut_down(self) -> None:
        """Stop listening; the window calls it when it closes."""
        stop_listening(self._bound)

    def picture(self, width: int, height: int) -> QImage:
        """The pane as an image of ``width`` x ``height`` pixels."""
        image = QImage(width, height, QImage.Format.Format_ARGB32_Premultiplied)
        painter = QPainter(image)
        self._paint(painter, QRectF(0, 0, width, height))
        painter.end()
        return image

    def turn(self) -> None:
        """Show the other face of the selected door's wall."""
        self._face += 1
        self._load(keep_range=True)

    # ---- listening --------------------------------------------------------------------------------------

    def _plan_changed(self, plan: object) -> None:
        self._load(keep_range=self.evidence is not None)

    def _selected(self) -> None:
        """A selected plane or door is shown; other things leave what is shown."""
        item = self.workbench.selection.item
        if item is None or item.kind in ("plane", "door"):
            self._face = 0
            self._load()

    def _look_changed(self, *told: object) -> None:
        if not turned_only(*told):
            self.update()

    def _pointer_moved(self, x: float | None, y: float | None) -> None:
        """The pointer of a plan pane, where it is near the plane."""
        if self._inside:
            return
        self._cursor = None
        if x is not None and y is not None and self.evidence is not None:
            along, away = self.evidence.along(x, y)
            self._cursor = along if away <= BESIDE else None
        self.update()

    def _load(self, keep_range: bool = False) -> None:
        plan, item = self.workbench.plan, self.workbench.selection.item
        before = self.evidence
        self.evidence = evidence_layer(plan, item, self._face) if plan is not None else None
        self.other.setVisible(self.evidence is not None and len(self.evidence.faces) > 1)
        if self.evidence is not None and not (keep_range and before is not None):
            self._shown = self._range(self.evidence)
        self.update()

    def _range(self, evidence: EvidenceLayer) -> tuple[float, float]:
        """All that was seen, or the surroundings of a selected door."""
        door = self.workbench.find(self.workbench.selection.item)
        if isinstance(door, Door):
            return max(evidence.start, door.start - AROUND), min(evidence.end, door.end + AROUND)
        return evidence.start, evidence.end

    # ---- painting ---------------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        self._paint(painter, QRectF(self.rect()))
        painter.end()

    def _paint(self, painter: QPainter, area: QRectF) -> None:
        c = theme.colours()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(area, colour(c.panel))
        evidence = self.evidence
        if evidence is None:
            self._paint_empty(painter, area, c)
            return
        self._paint_title(painter, area, evidence, c)
        tracks = self._tracks(area)
        self._paint_doors(painter, tracks, evidence, c)
        self._paint_axis(painter, tracks, evidence, c)
        for track, paint in zip(tracks, (paint_histogram, paint_gradient, paint_response), strict=True):
            painter.save()
            painter.setClipRect(track)
            paint(painter, track, evidence, self._shown, c)
            painter.restore()
        for track, text in zip(tracks, (tr("Histogram"), tr("Gradient"), tr("Filter")), strict=True):
            paint_label(painter, track, text, c)
        self._paint_widths(painter, tracks, evidence, c)
        if self._cursor is not None:
            self._paint_cursor(painter, tracks, evidence, c)

    def _paint_empty(self, painter: QPainter, area: QRectF, c: Colours) -> None:
        thing = self.workbench.selection.item
        known = thing is not None and thing.kind in ("plane", "door")
        text = tr("Nothing was seen along this wall.") if known else tr("Select a wall or a door.")
        draw_text(painter, text, (area.center().x(), area.center().y()), BODY, colour(c.muted))

    def _paint_title(self, painter: QPainter, area: QRectF, evidence: EvidenceLayer, c: Colours) -> None:
        units, axis = self.workbench.view.look.units, evidence.facing.axis
        facing = {"EAST": tr("east"), "WEST": tr("west"), "NORTH": tr("north"), "SOUTH": tr("south")}
        text = tr("Plane {id} faces {facing}").format(id=evidence.plane, facing=facing[evidence.facing.name])
        room = area.width() - EDGE - RIGHT
        _write(painter, text, (EDGE, 18), room, font(BODY, 600), colour(plane_colour(c, axis)))
        doors = tr_n("%Ln door(s)", len(evidence.doors))
        text = f"{'xy'[axis]} = {format.length(evidence.offset, units)} · {doors}"
        taken = self.other.width() + 8 if self.other.isVisibleTo(self) else 0
        _write(painter, text, (EDGE, 36), room - taken, font(SMALL), colour(c.muted))

    def _paint_doors(
        self, painter: QPainter, tracks: list[QRectF], evidence: EvidenceLayer, c: Colours
    ) -> None:
        """Bands over all tracks; the selected and the hovered one outlined."""
        selection = self.workbench.selection
        for door, band in self._bands(tracks, evidence):
            item = Item("door", door.id)
            painter.fillRect(band, colour(c.door, 0.35))
            tone = (
                c.selection if item in selection.items else c.hover if item == selection.hovered else c.door
            )
            painter.setPen(pen(tone, 2.0 if tone != c.door else 1.2))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(band)

    def _paint_widths(
        self, painter: QPainter, tracks: list[QRectF], evidence: EvidenceLayer, c: Colours
    ) -> None:
        """On the bands, above the curves."""
        for door, band in self._bands(tracks, evidence):
            text = format.length(door.width, self.workbench.view.look.units)
            if text_size(text, SMALL)[0] + 6 <= band.width():
                at = (band.center().x(), band.top() + 12)
                draw_text(painter, text, at, SMALL, colour(c.text), 500, halo=colour(c.panel, 0.85))

    def _bands(self, tracks: list[QRectF], evidence: EvidenceLayer) -> Iterator[tuple[Door, QRectF]]:
        """Where the doors in view lie across all tracks."""
        for door in evidence.doors:
            left, right = (track_x(tracks[0], self._shown, v) for v in (door.start, door.end))
            band = QRectF(left, tracks[0].top(), right - left, tracks[-1].bottom() - tracks[0].top())
            band = band.intersected(QRectF(LEFT, 0, tracks[0].width(), tracks[-1].bottom()))
            if band.width() > 0:
                yield door, band

    def _paint_axis(
        self, painter: QPainter, tracks: list[QRectF], evidence: EvidenceLayer, c: Colours
    ) -> None:
        """Metres along the plane: a grid over all tracks, numbers below."""
        unit = METRES_PER_FOOT if self.workbench.view.look.units == "ft-in" else 1.0
        low, high = self._shown
        width = tracks[0].width()
        step = max(round_length((high - low) / unit * TICKS / width) * 2, 0.1) * unit
        bottom = tracks[-1].bottom()
        for k in range(math.ceil(low / step), math.floor(high / step) + 1):
            x = track_x(tracks[0], self._shown, k * step)
            painter.setPen(pen(c.line, 1.0))
            for track in tracks:
                painter.drawLine(QPointF(x, track.top()), QPointF(x, track.bottom()))
            draw_text(painter, format.number(k * step / unit, "g"), (x, bottom + 11), SMALL, colour(c.muted))
        name = "yx"[evidence.facing.axis]
        text = f"{name}, {'ft' if unit != 1.0 else 'm'}"
        draw_text(painter, text, (tracks[0].center().x(), bottom + 25), SMALL, colour(c.muted))

    def _paint_cursor(
        self, painter: QPainter, tracks: list[QRectF], evidence: EvidenceLayer, c: Colours
    ) -> None:
        """Where the pointer is, with the values there."""
        assert self._cursor is not None
        x = track_x(tracks[0], self._shown, self._cursor)
        if not tracks[0].left() <= x <= tracks[0].right():
            return
        painter.setPen(pen(c.accent, 1.2))
        painter.drawLine(QPointF(x, tracks[0].top()), QPointF(x, tracks[-1].bottom()))
        k = int(np.argmin(np.abs(evidence.at - self._cursor)))
        for track, values in zip(
            tracks, (evidence.histogram, evidence.gradient, evidence.response), strict=True
        ):
            at = (track.right() - 18, track.top() + 9)
            draw_text(
                painter,
                format.number(values[k] + 0.0, ".2f"),
                at,
                SMALL,
                colour(c.accent),
                600,
                False,
                colour(c.panel),
            )

    def _tracks(self, area: QRectF) -> list[QRectF]:
        """The three tracks; the histogram is the tallest."""
        height = max(area.height() - TOP - BOTTOM - 2 * GAP, 30.0)
        width = max(area.width() - LEFT - RIGHT, 30.0)
        shares, y, out = (0.4, 0.3, 0.3), TOP, []
        for share in shares:
            out.append(QRectF(LEFT, y, width, share * height))
            y += share * height + GAP
        return out

    # ---- mouse ------------------------------------------------------------------------------------------

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        self._inside, evidence = True, self.evidence
        if evidence is None:
            return
        track = self._tracks(QRectF(self.rect()))[0]
        if self._press is not None and (event.position() - self._press).manhattanLength() > CLICK:
            metres = (
                (event.position().x() - self._last.x()) / track.width() * (self._shown[1] - self._shown[0])
            )
            self._shown = (self._shown[0] - metres, self._shown[1] - metres)
        self._last = event.position()
        self._cursor = self._along(event.position())
        self.workbench.pointer_moved.emit(*evidence.point(self._cursor))
        self.workbench.selection.hover(self.door_at(event.position()))
        self.update()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() in (Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton):
            self._press = self._last = event.position()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        press, self._press = self._press, None
        if press is None or (event.position() - press).manhattanLength() > CLICK:
            return
        item = self.door_at(event.position())
        if event.button() == Qt.MouseButton.LeftButton and item is not None:
            self.workbench.selection.select(
                item, bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)
            )

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """On a door: bring it into view; elsewhere: the whole plane."""
        item = self.door_at(event.position())
        if item is not None:
            self.workbench.selection.zoom_asked.emit(item)
        elif self.evidence is not None:
            self._shown = (self.evidence.start, self.evidence.end)
            self.update()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom along the axis to the pointer."""
        if self.evidence is None or not event.angleDelta().y():
            return
        at = self._along(event.position())
        share = STEP ** (-event.angleDelta().y() / 120)
        low, high = (at + (v - at) * share for v in self._shown)
        if high - low >= NEAREST:
            self._shown = (max(low, self.evidence.start), min(high, self.evidence.end))
        event.accept()
        self.update()

    def leaveEvent(self, event: QEvent) -> None:
        self._inside, self._cursor = False, None
        self.workbench.selection.hover(None)
        self.workbench.pointer_moved.emit(None, None)
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        size = self.other.sizeHint()
        self.other.setGeometry(self.width() - size.width() - round(RIGHT), 22, size.width(), size.height())

    def door_at(self, position: QPointF) -> Item | None:
        """The detection at a pixel of this widget."""
        if self.evidence is None:
            return None
        tracks = self._tracks(QRectF(self.rect()))
        if not tracks[0].top() <= position.y() <= tracks[-1].bottom():
            return None
        along = self._along(position)
        return next((Item("door", d.id) for d in self.evidence.doors if d.start <= along <= d.end), None)

    def pixel_of(self, along: float) -> float:
        """Horizontal pixel of a place along the plane, metres."""
        return track_x(self._tracks(QRectF(self.rect()))[0], self._shown, along)

    def _along(self, position: QPointF) -> float:
        track = self._tracks(QRectF(self.rect()))[0]
        low, high = self._shown
        return low + (position.x() - track.left()) / track.width() * (high - low)


def _write(
    painter: QPainter, text: str, at: tuple[float, float], room: float, face: QFont, ink: QColor
) -> None:
    """One line from ``at``, its end left out where there is no room for it."""
    painter.setFont(face)
    painter.setPen(ink)
    shown = QFontMetricsF(face).elidedText(text, Qt.TextElideMode.ElideRight, room)
    painter.drawText(QPointF(*at), shown)
