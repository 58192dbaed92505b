"""Drawings in feet and inches, and in German: words, measures, scales; geometry stays."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floorplan_core import drawing_style
from floorplan_core.drawing_style import PLAIN, DrawingStyle, feet_and_inches, in_style
from floorplan_core.errors import UsageError
from floorplan_core.exporters.geojson import GeoJsonExporter
from floorplan_core.exporters.png import PlanPngExporter, plan_image
from floorplan_core.exporters.sheet import IMPERIAL_PAPERS, IMPERIAL_SCALES, LARGEST, lay_out
from floorplan_core.exporters.svg import SvgExporter, svg_text
from floorplan_core.plugins import default_registry
from tests.factories import l_corridor, small_flat

IMPERIAL, GERMAN = DrawingStyle("imperial"), DrawingStyle("metric", "de")


def words(text: str) -> list[str]:
    root = ET.fromstring(text.encode())
    return [e.text or "" for e in root.iter("{http://www.w3.org/2000/svg}text")]


@pytest.mark.parametrize("metres", np.linspace(0.0, 40.0, 41).tolist())
def test_feet_and_inches_are_within_an_eighth_of_an_inch(metres: float) -> None:
    found = re.fullmatch(r"(\d+)' (\d+)([¼½¾]?)\"", feet_and_inches(metres))
    assert found is not None
    inches = int(found[1]) * 12 + int(found[2]) + {"": 0, "¼": 0.25, "½": 0.5, "¾": 0.75}[found[3]]
    assert abs(inches * 0.0254 - metres) <= 0.0254 / 8 + 1e-9
    assert int(found[2]) < 12


def test_a_metric_english_drawing_is_what_it_was() -> None:
    assert svg_text(small_flat(), DrawingStyle("metric", "en")) == svg_text(small_flat())


def test_an_imperial_drawing_has_no_metres() -> None:
    shown = words(svg_text(small_flat(), IMPERIAL))
    assert {"13' 9¼\"", "24' 11¼\""} <= set(shown)  # 4.20 m, 7.60 m
    assert not [t for t in shown if re.search(r"\d m\b|m²|\d\.\d\d\b", t) and "°" not in t]
    assert any("sq ft" in t for t in shown)
    assert any(t.endswith(" ft") for t in shown)  # the scale bar


@pytest.mark.parametrize("size", [(6.0, 5.0), (30.0, 20.0), (25.0, 56.0), (80.0, 40.0)])
def test_imperial_sheets_are_to_an_architects_scale_and_fit_the_paper(size: tuple[float, float]) -> None:
    sheet = lay_out((0.0, 0.0, *size), imperial=True)
    _, short, long = IMPERIAL_PAPERS[LARGEST]
    assert sheet.scale in IMPERIAL_SCALES
    assert sorted((sheet.width, sheet.height)) <= [short, long]
    feet = float(np.diff(sheet.to_page(np.array([[0.0, 0.0], [0.3048, 0.0]]))[:, 0])[0])
    assert feet * sheet.scale == pytest.approx(304.8)


def test_the_scale_that_is_written_is_the_scale() -> None:
    for scale, text in IMPERIAL_SCALES.items():
        found = re.fullmatch(r"(\d+)(?:/(\d+))?\" = (\d+)'", text)
        assert found is not None
        assert int(found[3]) * 12 / (int(found[1]) / int(found[2] or 1)) == scale


def test_a_german_drawing_has_no_english() -> None:
    plan = l_corridor()
    shut = replace(plan, storey=1, doors=(replace(plan.doors[0], shut=True), *plan.doors[1:]))
    text = svg_text(shut, GERMAN)
    said = " ".join(words(text))
    for word in ("Grundriss", "Raum 1", "Flur", "16,10 m²", "Legende", "Tür, geschlossen", "Geschoss 1"):
        assert word in said, word
    english = {w for key in drawing_style.GERMAN for w in re.findall(r"[A-Za-z]{4,}", key)}
    german = {w for value in drawing_style.GERMAN.values() for w in re.findall(r"[A-Za-z]{4,}", value)}
    titles = re.findall(r"<title>(.*?)</title>", text)
    spoken = set(re.findall(r"[A-Za-z]{4,}", " ".join([said.replace(plan.source, ""), *titles[1:]])))
    assert not spoken & (english - german)


def test_geometry_is_the_same_in_every_language() -> None:
    plan = l_corridor()
    paths = [re.findall(r' d="([^"]+)"', svg_text(plan, style)) for style in (PLAIN, GERMAN)]
    walls = [[p for p in found if len(p) > 200] for found in paths]
    assert walls[0] == walls[1]


def test_only_exporters_of_words_have_a_style(tmp_path: Path) -> None:
    geojson = GeoJsonExporter()
    assert in_style(geojson, IMPERIAL) is geojson
    registry = default_registry()
    styled = {e.name for e in registry.exporters if getattr(e, "has_style", False)}
    assert styled == {"SVG", "PNG", "Planes PNG", "Occupancy PNG", "PDF", "DXF"}
    made = in_style(registry.exporter(Path("plan.svg")), IMPERIAL)
    made.write(small_flat(), tmp_path / "plan.svg")
    SvgExporter(IMPERIAL).write(small_flat(), tmp_path / "other.svg")
    assert (tmp_path / "plan.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()


def test_a_drawing_is_called_as_asked(tmp_path: Path) -> None:
    style = DrawingStyle(title="Rose & Son, ground floor")
    SvgExporter(style).write(small_flat(), tmp_path / "plan.svg")
    text = (tmp_path / "plan.svg").read_text(encoding="utf-8")
    assert ">Rose &amp; Son, ground floor</text>" in text
    assert small_flat().source not in text


def test_pictures_have_a_style_too() -> None:
    plan = l_corridor()
    plain, german = plan_image(plan), plan_image(plan, style=GERMAN)
    assert plain.size == german.size
    assert plain.tobytes() != german.tobytes()
    assert PlanPngExporter().styled(GERMAN).style == GERMAN


@pytest.mark.parametrize("style", [PLAIN, GERMAN, DrawingStyle("imperial", "de")])
def test_all_of_a_caption_is_written(style: DrawingStyle, monkeypatch: pytest.MonkeyPatch) -> None:
    from floorplan_core.exporters import png_canvas

    written: list[str] = []
    draw_text = png_canvas.draw_text
    monkeypatch.setattr(
        png_canvas, "draw_text", lambda d, at, text, *a: written.append(text) or draw_text(d, at, text, *a)
    )
    plan = l_corridor()
    shut = replace(plan, doors=(replace(plan.doors[0], shut=True), *plan.doors[1:]))
    plan_image(shut, style=style)
    assert any(str(len(plan.regions)) in t and ("sq ft" in t or "m²" in t) for t in written)


def test_what_is_not_known_is_refused() -> None:
    with pytest.raises(UsageError, match="metric or imperial"):
        DrawingStyle("feet")
    with pytest.raises(UsageError, match="en or de"):
        DrawingStyle("metric", "fr")
