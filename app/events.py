"""The smallest possible event: who changed something tells whoever listens. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Event:
    """A list of listeners; they are called in the order in which they connected."""

    def __init__(self) -> None:
        self._listeners: list[Callable[..., Any]] = []

    def connect(self, listener: Callable[..., Any]) -> None:
        """Call ``listener`` at every :meth:`emit` from now on."""
        self._listeners.append(listener)

    def disconnect(self, listener: Callable[..., Any]) -> None:
        """Forget ``listener``; nothing happens if it never listened."""
        if listener in self._listeners:
            self._listeners.remove(listener)

    @property
    def is_heard(self) -> bool:
        """True where somebody listens."""
        return bool(self._listeners)

    def emit(self, *values: object) -> None:
        """Call every listener with ``values``."""
        for listener in tuple(self._listeners):
            listener(*values)
