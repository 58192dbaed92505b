"""Thumbnails of recent surveys: the picture inside a project, or one kept beside the user's settings."""

from __future__ import annotations

import hashlib
import zipfile
from pathlib import Path

import platformdirs
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QImage, QPixmap

MEMBER = "thumbnail.png"  # of a .floorcast project
BIGGEST = 4_000_000  # bytes of a picture that is believed


def thumbnail(path: Path, size: QSize) -> QPixmap | None:
    """The picture of the plan of ``path``, scaled into ``size``; None where there is none."""
    data = _inside(path) or _kept(path)
    image = QImage.fromData(data) if data else QImage()
    if image.isNull():
        return None
    mode = Qt.AspectRatioMode.KeepAspectRatio
    return QPixmap.fromImage(image.scaled(size, mode, Qt.TransformationMode.SmoothTransformation))


def keep_thumbnail(path: Path, image: QImage) -> None:
    """Remember the picture for a survey that is no project; a full disk is no reason to fail."""
    target = _place(path)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError:
        return
    image.save(str(target), "PNG")


def _inside(path: Path) -> bytes | None:
    if path.suffix.lower() != ".floorcast":
        return None
    try:
        with zipfile.ZipFile(path) as archive:
            if archive.getinfo(MEMBER).file_size > BIGGEST:
                return None
            return archive.read(MEMBER)
    except (OSError, KeyError, zipfile.BadZipFile):
        return None


def _kept(path: Path) -> bytes | None:
    try:
        return _place(path).read_bytes()
    except OSError:
        return None


def _place(path: Path) -> Path:
    name = hashlib.sha256(str(path.resolve()).encode()).hexdigest()[:24]
    return Path(platformdirs.user_cache_dir("floorcast")) / "thumbnails" / f"{name}.png"
