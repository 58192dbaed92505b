"""plan.pdf as a PDF viewer shows it (pdfium)."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pypdfium2
import pytest

from floorplan_core.drawing_style import PLAIN, DrawingStyle
from floorplan_core.exporters import palette
from floorplan_core.exporters.door_symbols import swings
from floorplan_core.exporters.pdf import PdfExporter
from floorplan_core.exporters.sheet import Sheet, lay_out
from floorplan_core.exporters.svg import drawn_bounds
from floorplan_core.exporters.walls import poche
from floorplan_core.model import FloorPlan
from tests.factories import RoomSpec, make_plan, small_flat
from tests.hash_seeds import printed

PIXELS = 20  # a millimetre


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("pdf") / "flat.pdf"
    PdfExporter().write(small_flat(), path)
    return path


def paper(path: Path) -> list[float]:
    """Width and height of the page in millimetres."""
    return [round(v / 72 * 25.4, 1) for v in pypdfium2.PdfDocument(path)[0].get_size()]


def picture(path: Path) -> np.ndarray:
    """(H, W, 3) colours of the page."""
    page = pypdfium2.PdfDocument(path)[0]
    return np.asarray(page.render(scale=PIXELS * 25.4 / 72).to_pil().convert("RGB")).astype(int)


def text(path: Path) -> str:
    return str(pypdfium2.PdfDocument(path)[0].get_textpage().get_text_range())


def sheet_of(plan: FloorPlan) -> Sheet:
    return lay_out(drawn_bounds(plan, poche(plan)))


def colour(shown: np.ndarray, plan: FloorPlan, xy: tuple[float, float], reach: int = 0) -> set[str]:
    """Colours at a place of the plan, in metres, on the page in whose middle the drawing lies."""
    sheet = sheet_of(plan)
    gap = (np.array(shown.shape[1::-1]) / PIXELS - (sheet.width, sheet.height)) / 2
    x, y = ((sheet.to_page(np.array([xy]))[0] + gap) * PIXELS).astype(int).tolist()
    near = shown[y - reach : y + reach + 1, x - reach : x + reach + 1].reshape(-1, 3)
    return {"#{:02x}{:02x}{:02x}".format(*rgb) for rgb in near.tolist()}


def test_the_page_is_a_usual_paper_on_which_the_scale_is_true(written: Path) -> None:
    sheet = sheet_of(small_flat())
    assert sheet.paper == "A4"
    assert paper(written) == [297.0, 210.0]
    assert f"{sheet.scale_text} when printed on A4 at full size" in text(written)


def test_a_plan_too_large_for_paper_has_a_page_of_its_size(tmp_path: Path) -> None:
    plan = make_plan([RoomSpec((0, 0, 9000, 40))])
    PdfExporter().write(plan, tmp_path / "long.pdf")
    sheet = sheet_of(plan)
    assert paper(tmp_path / "long.pdf") == pytest.approx([sheet.width, sheet.height], abs=0.1)


def test_feet_come_on_american_paper(tmp_path: Path) -> None:
    style = DrawingStyle(units="imperial", language="de")
    PdfExporter().styled(style).write(small_flat(), tmp_path / "flat.pdf")
    assert paper(tmp_path / "flat.pdf") == [431.8, 279.4]
    assert "Legende" in text(tmp_path / "flat.pdf")


def test_words_can_be_searched(written: Path) -> None:
    assert {"Living & dining", "14.28 m²"} <= {line.strip() for line in text(written).splitlines()}
    assert pypdfium2.PdfDocument(written).get_metadata_dict()["Title"].startswith("Floor plan of")


def test_walls_floors_and_swings_lie_where_the_drawing_has_them(written: Path) -> None:
    plan, shown = small_flat(), picture(written)
    walls = poche(plan)
    assert walls.observed.area > 0
    assert colour(shown, plan, walls.observed.representative_point().coords[0]) == {palette.WALL}
    leaves = [leaf for made in swings(walls.openings, plan.regions) for leaf in made if not leaf.shut]
    assert leaves
    for leaf in leaves:
        u, v = np.subtract(leaf.tip, leaf.hinge), np.subtract(leaf.closed, leaf.hinge)
        arc = leaf.hinge + (u + v) / np.sqrt(2)
        assert palette.DOOR.accent in colour(shown, plan, tuple(arc), reach=6)


def test_predicted_floor_is_hatched_and_seen_floor_is_not(tmp_path: Path) -> None:
    plan = make_plan([RoomSpec((0, 0, 4, 4), seen=0.5)])
    PdfExporter().write(plan, tmp_path / "half.pdf")
    shown = picture(tmp_path / "half.pdf")
    assert colour(shown, plan, (3.5, 0.5), reach=25) == {palette.ROOM.tint}
    assert len(colour(shown, plan, (3.5, 3.5), reach=25)) > 2


def test_same_bytes_whatever_order_sets_have() -> None:
    code = "from tests.factories import small_flat; from floorplan_core.exporters.sheet import PAPERS\n"
    code += "from floorplan_core.exporters.pdf_page import pdf_of_svg\n"
    code += "from floorplan_core.exporters.svg import svg_text; from zlib import crc32\n"
    code += "print(crc32(pdf_of_svg(svg_text(small_flat()), PAPERS)))"
    assert len(printed(code)) == 1


def test_a_plan_without_rooms_is_a_title(tmp_path: Path) -> None:
    PdfExporter(PLAIN).write(replace(small_flat(), regions=(), doors=()), tmp_path / "none.pdf")
    assert "Floor plan" in text(tmp_path / "none.pdf")
