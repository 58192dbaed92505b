"""Pictures: a view of the plan in pixels, and what all pictures share (text, outlines, scale bar).

Geometry is along the pixel axes (manhattan frame), so filled areas are exact masks; only text is antialiased.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from io import BytesIO
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters.placement import LEADING, Placed, block_size

Float = NDArray[np.float64]
Colour = tuple[int, int, int]
Bounds = tuple[float, float, float, float]

LONG_SIDE = 1600  # pixels
# Lines and text have a width in pixels: a site of more than 130 m would be nothing else at that size.
LEAST_SCALE, LARGEST = 12.0, 8000  # pixels a metre; pixels on a side at most
BORDER = 1.0  # metres around the plan
ROW = 44  # pixels: height of a row of the strip under the plan
AIR = 3  # pixels around names: hatching leaves them free
NARROW = 1400  # pixels: narrower pictures have caption and scale bar in two rows
BAR_LENGTHS = (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500)  # metres or feet
BAR_SHARE = 0.2  # of the picture's width that the scale bar may take
CAPTION = (18, 16, 14, 12)  # pixels: its text, the largest at which all of it fits
SPACE, WORD_SPACE = 28, 10  # pixels between its entries, and from swatch to word
SIGN = (26, 16)  # pixels: width and height of its swatches
WHITE = (255, 255, 255)
SUPERSCRIPT, RAISE, CAP = 0.62, 0.32, 0.72  # of the font size: a raised 2, its lift; height of capitals
PNG_LEVEL = 1  # zlib: the fastest; pictures of flat colours are small anyway


@dataclass(frozen=True)
class View:
    """A part of the plan on a grid of pixels; row 0 is the lowest, pictures are flipped when finished."""

    x0: float  # metres, manhattan frame, left edge
    y0: float  # metres, lower edge
    scale: float  # pixels for a metre
    width: int  # pixels
    height: int  # pixels, without the strip

    @property
    def strip(self) -> int:
        """Pixels under the plan for caption and scale bar."""
        return 20 + ROW * (2 if self.width < NARROW else 1)

    @property
    def origin(self) -> Float:
        """(2,) the lower left corner, metres."""
        return np.array([self.x0, self.y0])

    def pixels(self, points: Float) -> Float:
        """(N, 2) plan coordinates to picture coordinates (x right, y down)."""
        p = (np.asarray(points, dtype=np.float64).reshape(-1, 2) - self.origin) * self.scale
        return np.column_stack([p[:, 0], self.height - p[:, 1]])

    def window(self, polygon: Any) -> tuple[tuple[slice, slice], NDArray[np.bool_]]:
        """Rows, columns and mask of the pixels inside a shapely polygon, row 0 lowest."""
        from floorplan_core.geometry.raster import polygon_window  # kernels: not for finding the exporter

        return polygon_window(polygon, self.origin, 1.0 / self.scale, (self.height, self.width))

    def sample(self, cells: NDArray[Any], origin: Float, cell: float, outside: Any) -> NDArray[Any]:
        """(height, width) the value of the cell under each pixel; ``outside`` beyond the grid."""
        padded = np.pad(cells, 1, constant_values=outside)
        ix = self._cells(self.x0 - origin[0], self.width, cell, cells.shape[1])
        iy = self._cells(self.y0 - origin[1], self.height, cell, cells.shape[0])
        return padded[iy][:, ix]

    def _cells(self, start: float, pixels: int, cell: float, count: int) -> NDArray[np.int64]:
        at = np.floor((start + (np.arange(pixels) + 0.5) / self.scale) / cell).astype(np.int64)
        inside: NDArray[np.int64] = np.clip(at + 1, 0, count + 1)
        return inside


def fit_view(bounds: Bounds, long_side: int | None = None) -> View:
    """The view of ``bounds`` with a border; its longer side has ``long_side`` pixels, or what can be read."""
    x0, y0, x1, y1 = bounds
    w, h = x1 - x0 + 2 * BORDER, y1 - y0 + 2 * BORDER
    usual = max(LONG_SIDE, min(LEAST_SCALE * max(w, h), LARGEST))
    scale = (long_side or usual) / max(w, h)
    return View(x0 - BORDER, y0 - BORDER, scale, max(1, round(w * scale)), max(1, round(h * scale)))


def paper(view: View) -> NDArray[np.uint8]:
    """(height, width) codes, all 0, row 0 lowest."""
    return np.zeros((view.height, view.width), dtype=np.uint8)


def finish(codes: NDArray[np.uint8], colours: Sequence[Colour], view: View) -> tuple[Image.Image, Any]:
    """The picture of ``codes`` (rows of ``colours``, 0 being the ground), and its drawing context.

    The array is turned the right way up and gets its strip. Codes become colours in Pillow, which is several
    times faster than indexing with numpy.
    """
    below = np.zeros((view.strip, view.width), dtype=np.uint8)
    coded = Image.fromarray(np.concatenate([codes[::-1], below]))
    coded.putpalette([channel for colour in colours for channel in colour])
    image = coded.convert("RGB")
    return image, ImageDraw.Draw(image)


@lru_cache(maxsize=64)
def font(size: int) -> Any:
    """Pillow's own scalable font: the same on every machine."""
    return ImageFont.load_default(size=size)


@lru_cache(maxsize=64)
def _wide_font(size: int) -> Any:
    """The font of the workbench, for letters that Pillow's own has not."""
    from importlib.resources import files

    data = (files("floorcast_resources") / "fonts" / "Inter-Regular.ttf").read_bytes()
    return ImageFont.truetype(BytesIO(data), size)


def face(text: str, size: int) -> Any:
    """The font that has the letters of ``text``: umlauts, fractions."""
    return font(size) if text.replace("²", "").isascii() else _wide_font(size)


def draw_text(
    draw: Any, at: tuple[float, float], text: str, size: int, ink: Colour | int, align: float = 0.0
) -> float:
    """Text in the middle of whose height lies ``at``; 0 starts there, 0.5 is centred. Returns its width.

    Pillow's font has no superscript two, so one is made of a small raised 2.
    """
    parts = [(part, i % 2 == 1) for i, part in enumerate(re.split("(²)", text)) if part]
    fonts = [face(text, max(1, round(size * SUPERSCRIPT)) if raised else size) for _, raised in parts]
    shown = ["2" if raised else part for part, raised in parts]
    widths = [float(draw.textlength(t, font=f)) for t, f in zip(shown, fonts, strict=True)]
    x, baseline = at[0] - align * sum(widths), at[1] + size * CAP / 2
    for (_, raised), t, f, width in zip(parts, shown, fonts, widths, strict=True):
        draw.text((x, baseline - (RAISE * size if raised else 0)), t, fill=ink, font=f, anchor="ls")
        x += width
    return sum(widths)


def draw_block(draw: Any, placed: Placed, ink: Colour) -> None:
    """Lines under each other, centred on their place; turned ones read upwards."""
    width, height = (math.ceil(v) for v in block_size(placed.lines))
    mask = Image.new("L", (width + 2 * AIR, height + 2 * AIR))
    writer, top = ImageDraw.Draw(mask), float(AIR)
    for line in placed.lines:
        middle = mask.width / 2, top + line.size * LEADING / 2
        draw_text(writer, middle, line.text, round(line.size), 255, 0.5)
        top += line.size * LEADING
    if placed.turned:
        mask = mask.transpose(Image.Transpose.ROTATE_90)
    draw.bitmap((round(placed.x - mask.width / 2), round(placed.y - mask.height / 2)), mask, fill=ink)


def draw_rings(draw: Any, view: View, polygon: Any, colour: Colour, width: int) -> None:
    """The outline of a shapely polygon, its holes included."""
    for ring in (polygon.exterior, *polygon.interiors):
        points = view.pixels(shapely.get_coordinates(ring)).round().astype(int)
        draw.line([tuple(p) for p in points.tolist()], fill=colour, width=width, joint="curve")


def draw_dashed(draw: Any, a: Float, b: Float, colour: Colour, width: int, dash: float = 9.0) -> None:
    """A dashed line between two picture points."""
    length = float(np.hypot(*(b - a)))
    for start in np.arange(0.0, length, 2 * dash).tolist():
        ends = [a + (b - a) * min(t, length) / length for t in (start, start + dash)]
        draw.line([tuple(e) for e in ends], fill=colour, width=width)


def draw_scale_bar(
    draw: Any, view: View, x: float, y: float, colour: Colour, style: DrawingStyle = PLAIN
) -> None:
    """A bar of a round length with its right end at ``x`` and its line at ``y``."""
    scale = view.scale * style.metres_per_unit
    fitting = [m for m in BAR_LENGTHS if m * scale <= BAR_SHARE * view.width]
    length = max(fitting, default=BAR_LENGTHS[0])
    left = x - length * scale
    draw.rectangle([left, y - 3, x, y + 2], fill=colour)
    text = f"{style.short(length)} {style.unit}"
    draw.text(((left + x) / 2, y - 8), text, fill=colour, font=font(18), anchor="mb")


@dataclass(frozen=True)
class Swatch:
    """What stands before a word of the caption."""

    colour: Colour
    look: str = "plain"  # or "hatched", "dashed", "leaf"


Entry = tuple[str, Colour | Swatch | None]


def draw_caption(draw: Any, entries: Sequence[Entry], y: float, ink: Colour, rows: Sequence[float]) -> None:
    """Swatches and words from the left, in ``rows`` of so many pixels; without a swatch text only."""
    for size in CAPTION:
        places = _places(draw, entries, rows, size)
        if len(places) == len(entries):
            break
    for (text, sign), (x, row) in zip(entries, places, strict=False):
        at = y + row * ROW
        if sign is not None:
            _draw_swatch(draw, x, at, sign if isinstance(sign, Swatch) else Swatch(sign), ink)
        draw_text(draw, (x + _lead(sign), at), text, size, ink)


def _places(draw: Any, entries: Sequence[Entry], rows: Sequence[float], size: int) -> list[tuple[float, int]]:
    """Where entries begin, and their row; as many as fit."""
    left = x = 24.0
    row, places = 0, []
    for text, sign in entries:
        needed = _lead(sign) + draw.textlength(text, font=face(text, size))
        if x > left and x + needed > rows[row] - left:
            x, row = left, row + 1
        if row == len(rows):
            break
        places.append((x, row))
        x += needed + SPACE
    return places


def _lead(sign: Colour | Swatch | None) -> float:
    """Pixels before the word."""
    return 0.0 if sign is None else SIGN[0] + WORD_SPACE


def _draw_swatch(draw: Any, x: float, y: float, swatch: Swatch, ink: Colour) -> None:
    w, h = SIGN
    x0, y0, x1, y1 = x, y - h / 2, x + w, y + h / 2
    if swatch.look == "dashed":
        draw_dashed(draw, np.array([x0, y]), np.array([x1, y]), ink, 4, 6.0)
        return
    draw.rectangle([x0, y0, x1, y1], fill=swatch.colour, outline=ink)
    if swatch.look == "hatched":
        for start in range(0, w - h + 1, 5):
            draw.line([(x0 + start + 1, y1 - 1), (x0 + start + h - 1, y0 + 1)], fill=WHITE, width=2)
    elif swatch.look == "leaf":
        draw.line([(x0, y), (x1, y)], fill=ink, width=3)


def save(image: Image.Image, path: Any) -> None:
    """Write as PNG whatever the suffix is (callers write to temporary names)."""
    image.save(path, format="PNG", compress_level=PNG_LEVEL)
