"""Puts points, surfaces and lines into one picture. No Qt; it may run in any thread, one at a time.

Kernels are imported where they are used: numba takes a second to load, and the window must not wait for it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from floorcast_app.colours import THEMES
from floorcast_app.rendering import ramps
from floorcast_app.rendering.camera import Camera, camera_of
from floorcast_app.rendering.cloud import Cloud, Paint
from floorcast_app.rendering.drawables import Lines, Surfaces
from floorcast_app.rendering.scene import Scene
from floorcast_app.rendering.shapes import floor_grid, grid_step
from floorcast_app.view_state import Look

Pixels = NDArray[np.uint32]

KEY_RANGE = float(2**31 - 256)  # of the scaled inverse depth in a key; float32 cannot round it up to 2^31
MAX_SPLAT = 3  # pixels of the pane: larger squares look like confetti, smaller ones like sand
BLOCK = 1 << 20  # points between two looks at whether the frame is still wanted
PULL = 0.05  # metres by which surfaces win over points on them
DEEP = 0.018  # of the span: a step in depth that is shaded by half
BELOW = 0.35  # metres below the floor: what lies deeper is seen through glass or belongs to another storey
GRID_REACH = 5.0  # spans from the centre to which the grid is drawn
EVERYTHING = 1e9  # metres


@dataclass(frozen=True)
class FrameRequest:
    """Everything that a frame depends on."""

    look: Look
    width: int  # pixels
    height: int
    scene: Scene
    cloud: Cloud | None = None
    paint: Paint | None = None
    storey: bool = False  # True: a plan tells where floor and ceiling are; points far below are left out
    ratio: float = 1.0  # pixels of the picture for a pixel of the pane: points and lines are as much wider


@dataclass(frozen=True)
class Frame:
    """A finished picture; the arrays are its own."""

    image: Pixels  # (h, w) 0xffRRGGBB
    inverse: NDArray[np.float32]  # (h, w) 1 / metres in front of the eye of the nearest point; 0: none
    camera: Camera  # of ``image``
    request: FrameRequest
    points: int  # that it was drawn with


class Renderer:
    """Keeps the buffers from frame to frame."""

    def __init__(self) -> None:
        self._keys = np.zeros((0, 0), dtype=np.uint64)

    def render(
        self,
        request: FrameRequest,
        most: int | None = None,
        fine: bool = False,
        stop: Callable[[], bool] = lambda: False,
    ) -> Frame | None:
        """Draw a frame with at most ``most`` points; None where ``stop()`` became true meanwhile.

        ``fine``: drawn at twice the size and averaged, so that edges are smooth.
        """
        factor = 2 if fine else 1
        wider = max(round(factor * request.ratio), 1)
        width, height = request.width * factor, request.height * factor
        camera = camera_of(request.look, width, height)
        pose = np.column_stack([camera.rotation, -camera.rotation @ camera.eye])
        lens = np.array([camera.focal, width / 2, height / 2, camera.near, camera.near * KEY_RANGE])
        keys = self._cleared(height, width)
        count = self._points(request, camera, pose, lens, most, wider, keys, stop)
        if count is None:
            return None
        image, inverse = self._shaded(request, camera, lens, keys, wider)
        self._surfaces(request, camera, pose, lens, inverse, image, wider)
        if stop():
            return None
        if fine:
            image, inverse = _halved(image), inverse[::2, ::2].copy()
            camera = camera_of(request.look, request.width, request.height)
        return Frame(image, inverse, camera, request, count)

    def _cleared(self, height: int, width: int) -> NDArray[np.uint64]:
        if self._keys.shape != (height, width):
            self._keys = np.zeros((height, width), dtype=np.uint64)
        else:
            self._keys[:] = 0
        return self._keys

    def _points(
        self,
        request: FrameRequest,
        camera: Camera,
        pose: NDArray[np.float64],
        lens: NDArray[np.float64],
        most: int | None,
        wider: int,
        keys: NDArray[np.uint64],
        stop: Callable[[], bool],
    ) -> int | None:
        cloud, paint = request.cloud, request.paint
        if cloud is None or paint is None or not len(cloud) or "points" not in request.look.layers:
            return 0
        from floorcast_app.rendering import kernels

        count = len(cloud) if most is None else min(most, len(cloud))
        low, high = point_box(request)
        size = splat_size(cloud, count, camera, MAX_SPLAT * wider)
        pose32, lens32 = pose.astype(np.float32), lens.astype(np.float32)
        for at in range(0, count, BLOCK):
            if stop():
                return None
            end = min(at + BLOCK, count)
            kernels.splat(cloud.xyz, paint.colours, at, end, pose32, lens32, low, high, size, keys)
        return count

    def _shaded(
        self,
        request: FrameRequest,
        camera: Camera,
        lens: NDArray[np.float64],
        keys: NDArray[np.uint64],
        wider: int,
    ) -> tuple[Pixels, NDArray[np.float32]]:
        from floorcast_app.rendering import kernels

        image = np.empty(keys.shape, dtype=np.uint32)
        inverse = np.empty(keys.shape, dtype=np.float32)
        strength = np.float32(camera.distance / (DEEP * request.look.span))
        sky = backdrop(len(keys), request.look.theme)
        kernels.shade(keys, np.float32(1.0 / lens[4]), wider, strength, sky, image, inverse)
        return image, inverse

    def _surfaces(
        self,
        request: FrameRequest,
        camera: Camera,
        pose: NDArray[np.float64],
        lens: NDArray[np.float64],
        inverse: NDArray[np.float32],
        image: Pixels,
        wider: int,
    ) -> None:
        from floorcast_app.rendering import kernels

        scene, towards = request.scene, np.float32(1.0 + PULL / camera.distance)

        def lines(drawn: Lines, pull: float) -> None:
            widths = drawn.widths * wider
            kernels.draw_lines(
                drawn.ends, drawn.colours, drawn.alphas, widths, pose, lens, np.float32(pull), inverse, image
            )

        def surfaces(drawn: Surfaces) -> None:
            arrays = drawn.corners, drawn.colours, drawn.alphas, drawn.hatches * wider
            kernels.fill_triangles(*arrays, pose, lens, towards, inverse, image)

        bounds = grid_bounds(request)
        if bounds is not None:
            lines(floor_grid(bounds, grid_step(request.look.span), request.look), towards)
        surfaces(scene.floors)
        surfaces(scene.walls.far_to_near(camera.rotation[2]))
        lines(scene.lines, towards)
        lines(scene.marks, EVERYTHING)


def point_box(request: FrameRequest) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Lowest and highest (3,) coordinates of points that are drawn: ceiling cut and section box."""
    low, high = np.full(3, -EVERYTHING, dtype=np.float32), np.full(3, EVERYTHING, dtype=np.float32)
    look = request.look
    if look.ceiling_cut is not None:
        high[2] = look.ceiling_cut
    if request.storey:
        low[2] = -BELOW
    if look.section is not None:
        low[:2], high[:2] = look.section[:2], look.section[2:]
    return low, high


def splat_size(cloud: Cloud, count: int, camera: Camera, most: int = MAX_SPLAT) -> int:
    """Pixels on a side of a point so that ``count`` of them just close a surface."""
    return int(np.clip(round(cloud.spacing(count) * camera.pixels_per_metre), 1, most))


def grid_bounds(request: FrameRequest) -> tuple[float, float, float, float] | None:
    """x0, y0, x1, y1 under which the floor's grid lies: plan, else points; None where there is nothing.

    Not farther than can be seen: stray points may lie kilometres away.
    """
    cloud, bounds = request.cloud, request.look.section or request.scene.bounds
    if bounds is None and cloud is not None and len(cloud):
        bounds = cloud.extent
    if bounds is None:
        return None
    reach, (x, y) = GRID_REACH * request.look.span, request.look.centre
    x0, y0 = max(bounds[0], x - reach), max(bounds[1], y - reach)
    x1, y1 = min(bounds[2], x + reach), min(bounds[3], y + reach)
    return (x0, y0, x1, y1) if x0 < x1 and y0 < y1 else None


def backdrop(rows: int, theme: str) -> Pixels:
    """(rows,) the ground behind everything: a quiet gradient."""
    holds = THEMES[theme]
    top, bottom = (
        np.array([int(c[i : i + 2], 16) for i in (1, 3, 5)], dtype=np.float64)
        for c in (holds.canvas, holds.window)
    )
    share = np.linspace(0.0, 1.0, rows)[:, None]
    return ramps.pack(np.round(top + share * (bottom - top)))


def _halved(image: Pixels) -> Pixels:
    from floorcast_app.rendering import kernels

    out = np.empty((image.shape[0] // 2, image.shape[1] // 2), dtype=np.uint32)
    kernels.halve(image, out)
    return out


def with_look(request: FrameRequest, look: Look) -> FrameRequest:
    """The same request from another camera."""
    return replace(request, look=look)
