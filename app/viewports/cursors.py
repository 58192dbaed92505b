"""What the pointer looks like over a plan: which way something can be dragged."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

CURSORS = {
    "arrow": Qt.CursorShape.ArrowCursor,
    "cross": Qt.CursorShape.CrossCursor,
    "x": Qt.CursorShape.SizeHorCursor,
    "y": Qt.CursorShape.SizeVerCursor,
    "rising": Qt.CursorShape.SizeBDiagCursor,
    "falling": Qt.CursorShape.SizeFDiagCursor,
}


def show_cursor(widget: QWidget, name: str) -> None:
    """The cursor that a tool asks for (:meth:`floorcast_app.tools.gestures.Tool.cursor_at`)."""
    if widget.cursor().shape() != CURSORS[name]:
        widget.setCursor(CURSORS[name])
