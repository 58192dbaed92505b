"""The desktop application. Importing it loads no Qt; :func:`run` does."""

from __future__ import annotations

from pathlib import Path


def run(survey: Path | None = None, script: Path | None = None) -> int:
    """Open the window (or run ``script`` without one); returns the exit status."""
    from floorcast_app.main import run as start

    return start(survey, script)
