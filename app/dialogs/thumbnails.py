"""Thumbnails of recent files: the picture inside a project, or one in the cache for a survey."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import platformdirs
from PySide6.QtCore import QBuffer, QObject, QSize, Qt, QTimer
from PySide6.QtGui import QImage, QPixmap

from floorplan_core.project_file import SUFFIX, read_thumbnail

KEPT_SIZE = (504, 312)  # px: three times a card, for dense displays
DELAY = 600  # ms after a plan, so that it was brought into view


def thumbnail(path: Path, size: QSize, ratio: float = 1.0) -> QPixmap | None:
    """The picture of the plan of ``path``, scaled into ``size``; None where there is none.

    :param ratio: device pixels for a pixel of ``size``.
    """
    data = _inside(path) or _kept(path)
    image = QImage.fromData(data) if data else QImage()
    if image.isNull():
        return None
    mode = Qt.AspectRatioMode.KeepAspectRatio
    made = QPixmap.fromImage(image.scaled(size * ratio, mode, Qt.TransformationMode.SmoothTransformation))
    made.setDevicePixelRatio(ratio)
    return made


def keep_thumbnail(path: Path, image: QImage) -> None:
    """Remember the picture of a survey or project; a full disk is no reason to fail."""
    target = _place(path)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError:
        return
    image.save(str(target), "PNG")


def plan_png(window: Any) -> bytes | None:
    """The picture as a file, for the project that is being saved; None without a plan."""
    if window.workbench.plan is None:
        return None
    data = QBuffer()
    data.open(QBuffer.OpenModeFlag.WriteOnly)
    window.picture("floor_plan", *KEPT_SIZE).save(data, "PNG")
    return bytes(data.data().data())


class ThumbnailKeeper(QObject):
    """Keeps a picture of the floor plan of what the window shows, whenever it was planned or saved."""

    def __init__(self, window: Any) -> None:
        super().__init__(window)
        self._window = window
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self.keep)
        workbench = window.workbench
        workbench.plan_changed.connect(lambda plan: plan is not None and self._soon.start(DELAY))
        workbench.recent_changed.connect(lambda _: self._soon.start(DELAY))

    def keep(self) -> None:
        """Keep it now."""
        workbench = self._window.workbench
        survey = workbench.state.survey
        if workbench.plan is None or survey is None:
            return
        image = self._window.picture("floor_plan", *KEPT_SIZE)
        keep_thumbnail(survey.path, image)  # a project holds its own


def _inside(path: Path) -> bytes | None:
    return read_thumbnail(path) if path.suffix.lower() == SUFFIX else None


def _kept(path: Path) -> bytes | None:
    try:
        return _place(path).read_bytes()
    except OSError:
        return None


def _place(path: Path) -> Path:
    name = hashlib.sha256(str(path.resolve()).encode()).hexdigest()[:24]
    return Path(platformdirs.user_cache_dir("floorcast")) / "thumbnails" / f"{name}.png"
