"""Widgets that listen to the workbench: they stop when Qt takes them away."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject

from floorcast_app.events import Event

Bound = tuple[tuple[Event, Callable[..., Any]], ...]


def listen(widget: QObject, bound: Bound) -> None:
    """Connect each listener to its event until ``widget`` is destroyed."""
    for event, listener in bound:
        event.connect(listener)
    widget.destroyed.connect(lambda: stop_listening(bound))


def stop_listening(bound: Bound) -> None:
    """Disconnect them all; those that are not connected are left alone."""
    for event, listener in bound:
        event.disconnect(listener)
