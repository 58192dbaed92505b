"""Colours of points: ramps even to the eye, safe for colour-blind ones, readable on both grounds.

Ramps run from blue over green to yellow with lightness rising in equal steps in OKLab (B. Ottosson, 2020),
so that they can be read as greys too. Colours are 0xRRGGBB in uint32.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Colours = NDArray[np.uint32]

STEPS = 256
_ANCHORS = ("#3a2d77", "#2a5f95", "#1f8f8b", "#6bb060", "#e8cf57")  # hue and chroma only; lightness is set
_LIGHTNESS = {"light": (0.30, 0.84), "dark": (0.44, 0.93)}  # low and high end, 0 to 1, on each ground
_GREYS = {"light": (0.25, 0.88), "dark": (0.35, 0.98)}

_LMS_FROM_RGB = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_LAB_FROM_LMS = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def packed(colour: str) -> int:
    """``#rrggbb`` as 0xRRGGBB."""
    return int(colour[1:], 16)


def pack(rgb: Float | NDArray[np.uint8]) -> Colours:
    """(N, 3) red, green, blue 0 to 255 as (N,) 0xRRGGBB."""
    parts = np.asarray(rgb).astype(np.uint32)
    return (parts[:, 0] << 16) | (parts[:, 1] << 8) | parts[:, 2]


@cache
def height_ramp(theme: str) -> Colours:
    """(STEPS,) colours from low to high on the ground of a theme."""
    lab = _to_oklab(np.array([[int(c[i : i + 2], 16) for i in (1, 3, 5)] for c in _ANCHORS]) / 255.0)
    at = np.linspace(0, len(_ANCHORS) - 1, STEPS)
    low, high = _LIGHTNESS[theme]
    a, b = (np.interp(at, np.arange(len(_ANCHORS)), lab[:, axis]) for axis in (1, 2))
    return pack(_from_oklab(np.column_stack([np.linspace(low, high, STEPS), a, b])))


@cache
def grey_ramp(theme: str) -> Colours:
    """(STEPS,) greys from weak to strong echoes."""
    low, high = _GREYS[theme]
    lightness = np.linspace(low, high, STEPS)
    return pack(_from_oklab(np.column_stack([lightness, np.zeros(STEPS), np.zeros(STEPS)])))


def plane_colours(count: int, theme: str) -> Colours:
    """(count,) colours that differ between neighbours: hues a golden angle apart, two lightnesses."""
    number = np.arange(count)
    hue = number * np.pi * (3 - np.sqrt(5))
    base = 0.58 if theme == "light" else 0.72
    lightness = base + 0.09 * (number % 2)
    return pack(_from_oklab(np.column_stack([lightness, 0.13 * np.cos(hue), 0.13 * np.sin(hue)])))


def mixed(under: int, over: int, share: float) -> int:
    """``share`` (0 to 1) of ``over`` in ``under``, all 0xRRGGBB."""
    parts = ((((under >> s) & 255) * (1 - share) + ((over >> s) & 255) * share, s) for s in (16, 8, 0))
    return sum(round(part) << s for part, s in parts)


def shifted(colour: str, lighter: float) -> int:
    """``#rrggbb`` with its OKLab lightness changed by ``lighter`` (-1 to 1), as 0xRRGGBB."""
    lab = _to_oklab(np.array([[int(colour[i : i + 2], 16) for i in (1, 3, 5)]]) / 255.0)
    lab[:, 0] = np.clip(lab[:, 0] + lighter, 0.0, 1.0)
    return int(pack(_from_oklab(lab))[0])


def steps(values: Float, low: float, high: float) -> NDArray[np.uint8]:
    """(N,) step of a ramp for each value; beyond ``low`` and ``high`` the ends."""
    scaled = (values - low) * (STEPS / max(high - low, 1e-6))
    return np.clip(scaled, 0, STEPS - 1).astype(np.uint8)


def _to_oklab(srgb: Float) -> Float:
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    return np.cbrt(linear @ _LMS_FROM_RGB.T) @ _LAB_FROM_LMS.T


def _from_oklab(lab: Float) -> Float:
    """(N, 3) 0 to 255, rounded; what lies outside of sRGB is cut."""
    linear = (lab @ np.linalg.inv(_LAB_FROM_LMS).T) ** 3 @ np.linalg.inv(_LMS_FROM_RGB).T
    linear = np.clip(linear, 0.0, 1.0)
    srgb = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    return np.round(srgb * 255.0)
