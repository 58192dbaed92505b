"""Main windows for tests, opened and closed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from floorcast_app.main import make_application, make_window
from floorcast_app.main_window import MainWindow


@contextmanager
def open_window(width: int = 1440, height: int = 900) -> Iterator[MainWindow]:
    """An unattended window, shown."""
    make_application()
    window = make_window(unattended=True)
    window.resize(width, height)
    window.show()
    try:
        yield window
    finally:
        window.close()
