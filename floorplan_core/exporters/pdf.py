"""plan.pdf: the drawing of plan.svg as one page at true scale, to print and to hand over.

The SVG stays the only description of the drawing: its elements are drawn again (``pdf_page``), so that both
show the same. Lines are lines and text is text, in the workbench's font, of which the letters used are inside
the file. Without a date; the same plan always gives the same bytes.
"""

from __future__ import annotations

from pathlib import Path

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters.pdf_page import pdf_of_svg
from floorplan_core.exporters.sheet import IMPERIAL_PAPERS, PAPERS
from floorplan_core.exporters.svg import svg_text
from floorplan_core.model import FloorPlan


class PdfExporter:
    """Writes ``plan.pdf``."""

    name = "PDF"
    suffixes: tuple[str, ...] = (".pdf",)
    description = "The drawing of plan.svg on one page at true scale, to print and to hand over."

    def __init__(self, style: DrawingStyle = PLAIN) -> None:
        self._style = style

    def styled(self, style: DrawingStyle) -> PdfExporter:
        """The exporter of drawings in these units, in this language."""
        return PdfExporter(style)

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the drawing of ``plan`` to ``path``."""
        papers = IMPERIAL_PAPERS if self._style.imperial else PAPERS
        path.write_bytes(pdf_of_svg(svg_text(plan, self._style), papers))
