"""The sheet of a drawing: its scale, and where plan and information blocks lie. Millimetres of paper."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

Float = NDArray[np.float64]

Papers = tuple[tuple[str, float, float], ...]  # name, short and long side

SCALES = (50, 100, 200, 500, 1000, 2000, 5000)
PAPERS: Papers = (("A4", 210.0, 297.0), ("A3", 297.0, 420.0), ("A2", 420.0, 594.0), ("A1", 594.0, 841.0))
IMPERIAL_SCALES = {  # as architects and, beyond 1/32 inch, engineers have them on their rulers
    48: '1/4" = 1\'', 64: '3/16" = 1\'', 96: '1/8" = 1\'', 128: '3/32" = 1\'', 192: '1/16" = 1\'',
    384: '1/32" = 1\'',
    600: '1" = 50\'', 1200: '1" = 100\'', 2400: '1" = 200\'', 4800: '1" = 400\'',
}  # fmt: skip
IMPERIAL_PAPERS: Papers = (
    ("Letter", 215.9, 279.4), ("Tabloid", 279.4, 431.8), ("ANSI C", 431.8, 558.8), ("ANSI D", 558.8, 863.6),
)  # fmt: skip
SMALL = 600  # scale, beyond which lines are thinner: 1:500, or 1" = 50'
LARGEST = 1  # of the papers: the largest that an office prints; a coarser scale comes before a larger one
MARGIN = 13.0
DIMENSIONS = 18.0  # room for two rows of dimensions on the left and at the top
CHAIN = 11.0  # room for one row on the right and below
GAP = 9.0  # between the drawing and the information blocks
BLOCKS = ((92.0, 32.0), (78.0, 32.0), (82.0, 32.0))  # width, height of title, legend, scale and north
BLOCK_GAP = 8.0
COLUMN = 92.0  # width of the blocks where they stand beside the plan
UPRIGHT = 1.25  # plans this much taller than wide have their blocks beside them


@dataclass(frozen=True)
class Sheet:
    """A laid-out sheet. ``to_page`` maps plan coordinates to it."""

    scale: int  # 1:scale
    width: float
    height: float
    origin: tuple[float, float]  # plan coordinates (metres) of the drawing's upper left corner
    corner: tuple[float, float]  # page coordinates of that corner
    size: tuple[float, float]  # width and height of the plan with its walls on the page
    blocks: tuple[tuple[float, float], ...]  # upper left corners of the information blocks
    beside: bool  # the blocks stand beside the plan, not below it
    imperial: bool = False  # scale and paper

    @property
    def mm(self) -> float:
        """Millimetres of paper for a metre of building."""
        return 1000.0 / self.scale

    @property
    def pen(self) -> float:
        """Width of the lines over the usual one: thinner where doors would be blots otherwise."""
        return min(1.0, SMALL / self.scale)

    @property
    def paper(self) -> str:
        """The smallest paper that holds the sheet at full scale."""
        papers, beyond = (IMPERIAL_PAPERS, "E or larger") if self.imperial else (PAPERS, "A0 or larger")
        found = _smallest(self.width, self.height, papers)
        return found[0] if found else beyond

    @property
    def scale_text(self) -> str:
        """The scale as it is written: ``1:100``, or ``1/8" = 1'``."""
        return IMPERIAL_SCALES[self.scale] if self.imperial else f"1:{self.scale}"

    def to_page(self, points: Float) -> Float:
        """(N, 2) plan metres to (N, 2) page millimetres, y down."""
        p = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        x = self.corner[0] + (p[:, 0] - self.origin[0]) * self.mm
        y = self.corner[1] + (self.origin[1] - p[:, 1]) * self.mm
        return np.column_stack([x, y])

    def geometry(self, shape: Any) -> Any:
        """A shapely geometry on the page."""
        return shapely.transform(shape, self.to_page)


def _smallest(width: float, height: float, papers: Papers) -> tuple[str, float, float] | None:
    """The smallest of ``papers`` that holds a sheet of this size, upright or not."""
    short, long = sorted((width, height))
    return next((paper for paper in papers if short <= paper[1] and long <= paper[2]), None)


def paper_size(width: float, height: float, papers: Papers) -> tuple[float, float] | None:
    """Width and height of the smallest of ``papers`` that holds a sheet of this size, turned as it is."""
    found = _smallest(width, height, papers)
    if found is None:
        return None
    _, short, long = found
    return (long, short) if width > height else (short, long)


def lay_out(bounds: tuple[float, float, float, float], imperial: bool = False) -> Sheet:
    """The sheet for a plan (walls included) of these bounds: x0, y0, x1, y1 in metres.

    The finest scale at which everything fits the largest usual paper, of the metric or imperial ones.
    """
    scales = IMPERIAL_SCALES if imperial else SCALES
    sheets = [replace(_at_scale(bounds, scale), imperial=imperial) for scale in scales]
    return next((s for s in sheets if _fits(s)), sheets[-1])


def _fits(sheet: Sheet) -> bool:
    short, long = sorted((sheet.width, sheet.height))
    _, a, b = (IMPERIAL_PAPERS if sheet.imperial else PAPERS)[LARGEST]
    return short <= a and long <= b


def _at_scale(bounds: tuple[float, float, float, float], scale: int) -> Sheet:
    x0, y0, x1, y1 = bounds
    w, h = (x1 - x0) * 1000 / scale, (y1 - y0) * 1000 / scale
    drawing = (w + DIMENSIONS + CHAIN, h + DIMENSIONS + CHAIN)
    if h > UPRIGHT * w:
        return _beside((x0, y1), (w, h), drawing, scale)
    return _below((x0, y1), (w, h), drawing, scale)


def _below(
    origin: tuple[float, float], size: tuple[float, float], drawing: tuple[float, float], scale: int
) -> Sheet:
    """Blocks in a strip under the plan; a narrow plan is centred above it."""
    strip = sum(w for w, _ in BLOCKS) + BLOCK_GAP * (len(BLOCKS) - 1)
    inner = max(drawing[0], strip)
    corner = (MARGIN + (inner - drawing[0]) / 2 + DIMENSIONS, MARGIN + DIMENSIONS)
    top = MARGIN + drawing[1] + GAP
    spare = (inner - strip) / (len(BLOCKS) - 1)
    lefts = np.cumsum([MARGIN, *(w + BLOCK_GAP + spare for w, _ in BLOCKS[:-1])]).tolist()
    height = top + BLOCKS[0][1] + MARGIN
    blocks = tuple((left, top) for left in lefts)
    return Sheet(scale, inner + 2 * MARGIN, height, origin, corner, size, blocks, False)


def _beside(
    origin: tuple[float, float], size: tuple[float, float], drawing: tuple[float, float], scale: int
) -> Sheet:
    """Blocks in a column to the right: the title where the plan begins, the others where it ends."""
    column = sum(h for _, h in BLOCKS) + BLOCK_GAP * (len(BLOCKS) - 1)
    inner = max(drawing[1], column)
    left = MARGIN + drawing[0] + GAP
    tops = np.cumsum([MARGIN + inner - column, *(h + BLOCK_GAP for _, h in BLOCKS[:-1])]).tolist()
    corner = (MARGIN + DIMENSIONS, MARGIN + DIMENSIONS + (inner - drawing[1]) / 2)
    tops[0] = min(tops[0], corner[1])
    width = left + COLUMN + MARGIN
    blocks = tuple((left, top) for top in tops)
    return Sheet(scale, width, inner + 2 * MARGIN, origin, corner, size, blocks, True)
