"""The orbit camera of the 3D pane, made from the look that all panes share. Pure functions, no Qt.

Pixel coordinates are continuous: pixel ``i`` covers ``i`` to ``i + 1``; y grows downwards.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorcast_app.view_state import Look

Float = NDArray[np.float64]

FIELD_OF_VIEW = math.radians(28.0)  # of the shorter side: slight perspective, walls stay nearly parallel
TARGET_HEIGHT = 1.0  # metres above the floor: what the camera looks at and turns about
NEAR_SHARE = 0.02  # of the camera's distance: nothing nearer is drawn
MIN_SPAN, MAX_SPAN = 0.5, 2000.0  # metres across the shorter side
MIN_ELEVATION, MAX_ELEVATION = -89.0, 90.0  # degrees
FRONT, SIDE, TOP = (-90.0, 0.0), (0.0, 0.0), (-90.0, 90.0)  # azimuth and elevation of the three views

_DEGREES_PER_PIXEL = 0.35  # a drag across a pane of 1000 pixels is a full turn
_LOWEST_SINE = 0.25  # below some 15 degrees a vertical drag would fly off along the floor
_ZOOM_PER_STEP = 1.2  # span ratio of a notch of the wheel


@dataclass(frozen=True)
class Camera:
    """A perspective camera; ``rotation @ (point - eye)`` is right, up, forward in metres."""

    rotation: Float  # (3, 3) rows: right, up, forward, scene frame
    eye: Float  # (3,) metres, scene frame
    target: Float  # (3,) metres: in the middle of the picture
    focal: float  # pixels
    width: int  # pixels
    height: int
    near: float  # metres in front of the eye

    @property
    def distance(self) -> float:
        """Metres from eye to target."""
        return float(np.linalg.norm(self.target - self.eye))

    @property
    def pixels_per_metre(self) -> float:
        """At the target."""
        return self.focal / self.distance

    def project(self, points: Float) -> Float:
        """(N, 3) scene points to (N, 3): pixel x, pixel y, metres in front of the eye (NaN pixels behind)."""
        local = (np.asarray(points, dtype=np.float64).reshape(-1, 3) - self.eye) @ self.rotation.T
        depth = local[:, 2]
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = np.where(depth >= self.near, self.focal / depth, np.nan)
        x = self.width / 2 + local[:, 0] * scale
        y = self.height / 2 - local[:, 1] * scale
        return np.column_stack([x, y, depth])

    def ray(self, x: float, y: float) -> tuple[Float, Float]:
        """Origin (3,) and direction (3,) through a pixel position; 1 along the direction is 1 m of depth."""
        across = (x - self.width / 2) / self.focal
        up = (self.height / 2 - y) / self.focal
        return self.eye, np.array([across, up, 1.0]) @ self.rotation

    def at_depth(self, x: float, y: float, depth: float) -> Float:
        """(3,) the scene point that a pixel shows at ``depth`` metres."""
        origin, direction = self.ray(x, y)
        return origin + depth * direction

    def on_level(self, x: float, y: float, z: float = 0.0) -> Float | None:
        """(3,) where the pixel's ray meets the level ``z`` metres; None where it does not, in front."""
        origin, direction = self.ray(x, y)
        if abs(direction[2]) < 1e-9:
            return None
        depth = float((z - origin[2]) / direction[2])
        return origin + depth * direction if depth >= self.near else None


def camera_of(look: Look, width: int, height: int) -> Camera:
    """The camera that shows ``look.span`` metres across the shorter side of ``width x height`` pixels."""
    azimuth, elevation = math.radians(look.azimuth), math.radians(look.elevation)
    back = np.array(
        [
            math.cos(elevation) * math.cos(azimuth),
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
        ]
    )
    right = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    rotation = np.array([right, np.cross(back, right), -back])
    target = np.array([*look.centre, TARGET_HEIGHT])
    distance = look.span / 2 / math.tan(FIELD_OF_VIEW / 2)
    focal = min(width, height) / 2 / math.tan(FIELD_OF_VIEW / 2)
    eye = target + distance * back
    return Camera(rotation, eye, target, focal, width, height, NEAR_SHARE * distance)


def orbited(look: Look, dx: float, dy: float) -> dict[str, float]:
    """Fields of the look after a drag of ``dx, dy`` pixels that turns the scene with the hand."""
    azimuth = (look.azimuth - dx * _DEGREES_PER_PIXEL + 180.0) % 360.0 - 180.0
    elevation = min(max(look.elevation + dy * _DEGREES_PER_PIXEL, MIN_ELEVATION), MAX_ELEVATION)
    return {"azimuth": azimuth, "elevation": elevation}


def panned(look: Look, width: int, height: int, dx: float, dy: float) -> dict[str, tuple[float, float]]:
    """Fields of the look after a drag of ``dx, dy`` pixels that moves the floor with the hand."""
    metres = look.span / min(width, height)
    azimuth = math.radians(look.azimuth)
    right = np.array([-math.sin(azimuth), math.cos(azimuth)])
    ahead = np.array([-math.cos(azimuth), -math.sin(azimuth)])
    steep = max(abs(math.sin(math.radians(look.elevation))), _LOWEST_SINE)
    sign = 1.0 if look.elevation >= 0 else -1.0
    x, y = np.array(look.centre) - right * dx * metres + ahead * dy * metres * sign / steep
    return {"centre": (float(x), float(y))}


def zoomed(look: Look, width: int, height: int, x: float, y: float, anchor: Float, steps: float) -> dict:
    """Fields of the look after ``steps`` notches of the wheel (positive: nearer).

    ``anchor`` (3,) is the scene point under the pixel ``x, y``; it stays there.
    """
    span = min(max(look.span / _ZOOM_PER_STEP**steps, MIN_SPAN), MAX_SPAN)
    trial = camera_of(_with(look, span), width, height)
    origin, direction = trial.ray(x, y)
    if abs(direction[2]) > 0.1 * float(np.linalg.norm(direction)):  # the ray meets the anchor's level well
        seen = origin + (anchor[2] - origin[2]) / direction[2] * direction
        shift = (anchor - seen)[:2]
    else:  # level views: only sideways
        wrong = (x - trial.project(anchor[None])[0, 0]) / trial.pixels_per_metre
        shift = -wrong * trial.rotation[0, :2] if math.isfinite(wrong) else np.zeros(2)
    centre = np.array(look.centre) + shift
    return {"span": span, "centre": (float(centre[0]), float(centre[1]))}


def _with(look: Look, span: float) -> Look:
    from dataclasses import replace

    return replace(look, span=span)
