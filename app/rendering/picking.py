"""What lies under the pointer: the ray of a pixel against the surfaces of the scene. Pure functions, no Qt.

Exact at any zoom and for any frame, without a second buffer to draw and to keep.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from floorcast_app.rendering.camera import Camera
from floorcast_app.rendering.scene import Scene
from floorcast_app.selection import Item

Float = NDArray[np.float64]

_EDGE = 1e-9  # of a triangle: its edges belong to it


def hits(scene: Scene, camera: Camera, x: float, y: float) -> tuple[tuple[Item, float], ...]:
    """The items under a pixel position with their depth in metres, the nearest first, each once."""
    corners = np.concatenate([scene.walls.corners, scene.floors.corners])
    owners = np.concatenate([scene.walls.owners, scene.floors.owners])
    depths = _depths(corners, *camera.ray(x, y))
    found: dict[int, float] = {}
    for row in np.argsort(depths, kind="stable"):
        if not depths[row] < np.inf:
            break
        if depths[row] >= camera.near and owners[row] >= 0:
            found.setdefault(int(owners[row]), float(depths[row]))
    return tuple((scene.items[owner], depth) for owner, depth in found.items())


def pick(scene: Scene, camera: Camera, x: float, y: float, behind: Item | None = None) -> Item | None:
    """The nearest item under a pixel position; the next one behind ``behind`` where that is under it too."""
    items = [item for item, _ in hits(scene, camera, x, y)]
    if not items:
        return None
    return items[(items.index(behind) + 1) % len(items)] if behind in items else items[0]


def _depths(corners: Float, origin: Float, direction: Float) -> Float:
    """(T,) metres of depth where a ray meets each triangle, else inf (Moeller, Trumbore 1997)."""
    if not len(corners):
        return np.zeros(0)
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = np.cross(direction, ac)
    scale = np.einsum("ij,ij->i", ab, p)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = origin - a
        u = np.einsum("ij,ij->i", t, p) / scale
        q = np.cross(t, ab)
        v = q @ direction / scale
        depth = np.einsum("ij,ij->i", ac, q) / scale
        inside = (u >= -_EDGE) & (v >= -_EDGE) & (u + v <= 1 + _EDGE) & (depth > 0)
    return np.where(inside, depth, np.inf)
