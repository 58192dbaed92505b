"""The loops that numpy cannot do: points, shading, triangles and lines into one depth buffer.

All in one file, so that numba's cache (which looks at one file only) is never stale. Depth is kept as its
inverse ``w`` (1 / metres in front of the eye): linear on the screen, larger is nearer, 0 is nothing.
Colours are 0xRRGGBB. Every kernel releases the interpreter lock.
"""

from __future__ import annotations

import numpy as np
from numba import njit

# no fast arithmetic: it rounds differently from one place in memory to another
_OPTIONS = {"cache": True, "nogil": True, "error_model": "numpy"}
_FAR = 1e30  # pixels
_LOW = np.uint64(0xFFFFFFFF)
_SHIFT = np.uint64(32)


@njit(**_OPTIONS)
def splat(xyz, colours, start, stop, pose, lens, low, high, size, keys):  # type: ignore[no-untyped-def]
    """Draw points ``start`` to ``stop`` as squares of ``size`` pixels.

    xyz (N, 3) float32; colours (N,) uint32; pose (3, 4) float32 scene to camera; lens: focal, centre x,
    centre y, near, key scale (float32); low, high (3,) float32 box outside of which nothing is drawn;
    keys (h, w) uint64: inverse depth (scaled to 31 bits) << 32 | colour, the largest wins.
    One branch a point and a store without one: mispredicted branches cost more than the arithmetic.
    """
    height, width = keys.shape
    focal, near, scale = lens[0], lens[3], lens[4]
    half = np.float32(0.5 * (size - 1))
    cx, cy = lens[1] - half, lens[2] - half
    p00, p01, p02, p03 = pose[0, 0] * focal, pose[0, 1] * focal, pose[0, 2] * focal, pose[0, 3] * focal
    p10, p11, p12, p13 = pose[1, 0] * focal, pose[1, 1] * focal, pose[1, 2] * focal, pose[1, 3] * focal
    p20, p21, p22, p23 = pose[2, 0], pose[2, 1], pose[2, 2], pose[2, 3]
    x0, y0, z0, x1, y1, z1 = low[0], low[1], low[2], high[0], high[1], high[2]
    zero, right, bottom = np.float32(0), np.float32(width - size), np.float32(height - size)
    for i in range(start, stop):
        x, y, z = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        inside = (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1) & (z >= z0) & (z <= z1)
        depth = p20 * x + p21 * y + p22 * z + p23
        w = np.float32(1.0) / depth
        u = cx + w * (p00 * x + p01 * y + p02 * z + p03)
        v = cy - w * (p10 * x + p11 * y + p12 * z + p13)
        if not (inside & (depth > near) & (u >= zero) & (v >= zero) & (u <= right) & (v <= bottom)):
            continue
        left, top = np.uint32(np.int32(u)), np.uint32(np.int32(v))  # unsigned: no wraparound check
        key = (np.uint64(np.uint32(np.int64(w * scale))) << _SHIFT) | np.uint64(colours[i])
        for row in range(np.uint32(size)):
            for column in range(np.uint32(size)):
                keys[top + row, left + column] = max(keys[top + row, left + column], key)


@njit(**_OPTIONS)
def shade(keys, unscale, reach, strength, sky, image, inverse):  # type: ignore[no-untyped-def]
    """Keys to colours with eye-dome lighting: what lies behind its neighbours is darkened.

    unscale: from a key's upper half to 1/m; reach: pixels to the neighbours; strength: per share of depth;
    sky (h,) uint32 the background of each row; image (h, w) uint32 0xffRRGGBB and inverse (h, w) float32
    (1/m) are written.
    """
    height, width = keys.shape
    opaque = np.uint32(0xFF000000)
    for v in range(height):
        for u in range(width):
            key = keys[v, u]
            if key == 0:
                image[v, u] = opaque | sky[v]
                inverse[v, u] = 0.0
                continue
            own = np.float32(key >> _SHIFT)
            behind = np.float32(0.0)
            if u >= reach:
                behind += max(np.float32(keys[v, u - reach] >> _SHIFT) - own, np.float32(0.0))
            if u + reach < width:
                behind += max(np.float32(keys[v, u + reach] >> _SHIFT) - own, np.float32(0.0))
            if v >= reach:
                behind += max(np.float32(keys[v - reach, u] >> _SHIFT) - own, np.float32(0.0))
            if v + reach < height:
                behind += max(np.float32(keys[v + reach, u] >> _SHIFT) - own, np.float32(0.0))
            light = np.float32(1.0) / (np.float32(1.0) + strength * behind / own)
            light = np.float32(0.35) + np.float32(0.65) * light
            colour = np.uint32(key & _LOW)
            red = np.uint32(np.float32((colour >> 16) & 255) * light)
            green = np.uint32(np.float32((colour >> 8) & 255) * light)
            blue = np.uint32(np.float32(colour & 255) * light)
            image[v, u] = opaque | (red << 16) | (green << 8) | blue
            inverse[v, u] = own * unscale


@njit(**_OPTIONS)
def _mix(under, over, alpha):  # type: ignore[no-untyped-def]
    """``over`` laid on ``under`` with ``alpha`` 0 to 256."""
    rest = np.uint32(256) - alpha
    red = (((under >> 16) & 255) * rest + ((over >> 16) & 255) * alpha) >> 8
    green = (((under >> 8) & 255) * rest + ((over >> 8) & 255) * alpha) >> 8
    blue = ((under & 255) * rest + (over & 255) * alpha) >> 8
    return np.uint32(0xFF000000) | np.uint32(red << 16) | np.uint32(green << 8) | np.uint32(blue)


@njit(**_OPTIONS)
def _clipped(corners, near, out):  # type: ignore[no-untyped-def]
    """The part of a camera-space triangle beyond ``near``; returns its number of corners (0 to 4)."""
    count = 0
    for i in range(3):
        a, b = corners[i], corners[(i + 1) % 3]
        if a[2] >= near:
            out[count] = a
            count += 1
        if (a[2] >= near) != (b[2] >= near):
            share = (near - a[2]) / (b[2] - a[2])
            for axis in range(3):
                out[count, axis] = a[axis] + share * (b[axis] - a[axis])
            count += 1
    return count


@njit(**_OPTIONS)
def _fill(a, b, c, colour, alpha, hatch, towards, inverse, image):  # type: ignore[no-untyped-def]
    """One screen triangle (x, y, w each); ``hatch`` pixels: width of diagonal stripes, 0: solid."""
    height, width = image.shape
    area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    if abs(area) < 1e-9:
        return
    wx = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area
    wy = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area
    top = max(int(np.ceil(min(a[1], b[1], c[1]) - 0.5)), 0)
    bottom = min(int(np.ceil(max(a[1], b[1], c[1]) - 0.5)), height)
    for v in range(top, bottom):
        y = v + 0.5
        left, right = _FAR, -_FAR
        for e in range(3):
            p, q = (a, b) if e == 0 else ((b, c) if e == 1 else (c, a))
            if (p[1] <= y) != (q[1] <= y):
                x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
                left, right = min(left, x), max(right, x)
        if right <= left:
            continue
        first, last = int(np.ceil(max(left, 0.0) - 0.5)), int(np.ceil(min(right, float(width)) - 0.5))
        w = np.float32((a[2] + (first + 0.5 - a[0]) * wx + (y - a[1]) * wy) * towards)
        step = np.float32(wx * towards)
        for u in range(first, last):
            if w >= inverse[v, u] and (hatch == 0 or (u + v) % (2 * hatch) < hatch):
                image[v, u] = _mix(image[v, u], colour, alpha)
            w += step


@njit(**_OPTIONS)
def fill_triangles(corners, colours, alphas, hatches, pose, lens, towards, inverse, image):  # type: ignore[no-untyped-def]
    """Lay translucent triangles on the image, in their order, where no point lies in front.

    corners (T, 3, 3) float64 scene; colours (T,) uint32; alphas (T,) uint32 0 to 256; hatches (T,) int64
    pixels; towards: factor on w that pulls surfaces towards the eye so that they win over their own points.
    """
    moved = np.empty((3, 3))
    out = np.empty((4, 3))
    focal, cx, cy, near = lens[0], lens[1], lens[2], lens[3]
    for t in range(len(corners)):
        for i in range(3):
            for axis in range(3):
                moved[i, axis] = pose[axis, 3]
                for k in range(3):
                    moved[i, axis] += pose[axis, k] * corners[t, i, k]
        count = _clipped(moved, near, out)
        for i in range(count):
            w = 1.0 / out[i, 2]
            out[i, 0], out[i, 1] = cx + focal * w * out[i, 0], cy - focal * w * out[i, 1]
            out[i, 2] = w
        for i in range(1, count - 1):
            _fill(out[0], out[i], out[i + 1], colours[t], alphas[t], hatches[t], towards, inverse, image)


@njit(**_OPTIONS)
def draw_lines(ends, colours, alphas, widths, pose, lens, towards, inverse, image):  # type: ignore[no-untyped-def]
    """Lay lines on the image where no point lies in front.

    ends (L, 2, 3) float64 scene; colours, alphas as for triangles; widths (L,) int64 pixels.
    """
    height, width = image.shape
    focal, cx, cy, near = lens[0], lens[1], lens[2], lens[3]
    a, b = np.empty(3), np.empty(3)
    for i in range(len(ends)):
        for axis in range(3):
            a[axis] = b[axis] = pose[axis, 3]
            for k in range(3):
                a[axis] += pose[axis, k] * ends[i, 0, k]
                b[axis] += pose[axis, k] * ends[i, 1, k]
        if a[2] < near and b[2] < near:
            continue
        if a[2] < near:
            a[:] = b + (a - b) * ((b[2] - near) / (b[2] - a[2]))
        elif b[2] < near:
            b[:] = a + (b - a) * ((a[2] - near) / (a[2] - b[2]))
        wa, wb = 1.0 / a[2], 1.0 / b[2]
        xa, ya, xb, yb = (
            cx + focal * wa * a[0],
            cy - focal * wa * a[1],
            cx + focal * wb * b[0],
            cy - focal * wb * b[1],
        )
        steep = abs(yb - ya) > abs(xb - xa)
        if steep:
            xa, ya, xb, yb = ya, xa, yb, xb
        if xa > xb:
            xa, ya, wa, xb, yb, wb = xb, yb, wb, xa, ya, wa
        limit, across = (height, width) if steep else (width, height)
        first, last = int(np.ceil(max(xa, 0.0) - 0.5)), int(np.ceil(min(xb, float(limit)) - 0.5))
        if xb - xa < 1e-9:
            continue
        slope, fall = (yb - ya) / (xb - xa), (wb - wa) / (xb - xa)
        for main in range(first, last):
            along = main + 0.5 - xa
            w = np.float32((wa + along * fall) * towards)
            low = int(np.floor(ya + along * slope - 0.5 * (widths[i] - 1)))
            for other in range(max(low, 0), min(low + widths[i], across)):
                v, u = (main, other) if steep else (other, main)
                if w >= inverse[v, u]:
                    image[v, u] = _mix(image[v, u], colours[i], alphas[i])


@njit(**_OPTIONS)
def halve(image, out):  # type: ignore[no-untyped-def]
    """Mean of each 2 x 2 pixels of ``image`` (2h, 2w) uint32 into ``out`` (h, w)."""
    height, width = out.shape
    for v in range(height):
        for u in range(width):
            a, b = image[2 * v, 2 * u], image[2 * v, 2 * u + 1]
            c, d = image[2 * v + 1, 2 * u], image[2 * v + 1, 2 * u + 1]
            # red and blue in one sum: each has 16 bits of room
            rb = (a & 0xFF00FF) + (b & 0xFF00FF) + (c & 0xFF00FF) + (d & 0xFF00FF) + 0x020002
            g = (a & 0x00FF00) + (b & 0x00FF00) + (c & 0x00FF00) + (d & 0x00FF00) + 0x000200
            out[v, u] = np.uint32(0xFF000000) | ((rb >> 2) & 0xFF00FF) | ((g >> 2) & 0x00FF00)


@njit(**_OPTIONS)
def move(xyz, matrix, out):  # type: ignore[no-untyped-def]
    """(N, 3) float32 points by a (3, 4) float32 matrix; BLAS is far slower at this shape."""
    for i in range(len(xyz)):
        x, y, z = xyz[i, 0], xyz[i, 1], xyz[i, 2]
        for axis in range(3):
            out[i, axis] = matrix[axis, 0] * x + matrix[axis, 1] * y + matrix[axis, 2] * z + matrix[axis, 3]


@njit(**_OPTIONS)
def nearest_planes(xyz, cells, origin, cell, low, high, out):  # type: ignore[no-untyped-def]
    """Which plane explains each point: ``cells`` (ny, nx) int16 holds its number, -1 nothing.

    xyz (N, 3) float32 scene; points below ``low`` or above ``high`` metres are floor and ceiling: -1.
    out (N,) int16 is written.
    """
    ny, nx = cells.shape
    for i in range(len(xyz)):
        out[i] = -1
        if xyz[i, 2] < low or xyz[i, 2] > high:
            continue
        u, v = (xyz[i, 0] - origin[0]) / cell, (xyz[i, 1] - origin[1]) / cell
        if u >= 0 and v >= 0 and u < nx and v < ny:
            out[i] = cells[int(v), int(u)]
