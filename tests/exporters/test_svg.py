"""plan.svg is well-formed, layered, labelled, deterministic, and tells seen from predicted."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from floorplan_core.exporters.door_symbols import leaves
from floorplan_core.exporters.placement import Placed, block_size
from floorplan_core.exporters.sheet import SCALES, lay_out
from floorplan_core.exporters.svg import SvgExporter, drawn_bounds, svg_text
from floorplan_core.exporters.svg_canvas import number, printable
from floorplan_core.exporters.svg_labels import place_labels
from floorplan_core.exporters.walls import poche, predicted_floor
from tests.factories import DoorSpec, RoomSpec, l_corridor, make_plan, office, small_flat

NS = "{http://www.w3.org/2000/svg}"


def parse(plan: Any) -> ET.Element:
    return ET.fromstring(svg_text(plan).encode())


def group(root: ET.Element, ident: str) -> ET.Element:
    found = [e for e in root.iter() if e.get("id") == ident]
    assert len(found) == 1, ident
    return found[0]


def texts(root: ET.Element) -> list[str]:
    return [e.text or "" for e in root.iter(f"{NS}text")]


@pytest.mark.parametrize("make", [small_flat, l_corridor, office])
def test_layers_size_and_ids(make: Any) -> None:
    root = parse(make())
    for layer in ("walls", "doors", "rooms", "predicted", "dimensions", "annotation", "legend", "north"):
        group(root, layer)
    width, height = root.get("width", ""), root.get("height", "")
    assert width.endswith("mm")
    assert root.get("viewBox") == f"0 0 {width[:-2]} {height[:-2]}"
    ids = [e.get("id") for e in root.iter() if e.get("id")]
    assert len(ids) == len(set(ids))
    assert all(f"url(#{i})" not in svg_text(make()) or i in ids for i in ("guessed-wall",))


def test_every_room_has_its_name_area_and_tooltip() -> None:
    plan = l_corridor()
    root = parse(plan)
    shown = texts(root)
    for i, region in enumerate(plan.regions):
        assert f"{region.label.capitalize()} {region.name}" in shown
        title = group(root, f"region-{i + 1}").find(f"{NS}title")
        assert title is not None
        assert f"{region.area:.2f} m²" in (title.text or "")
    assert shown.count("16.10 m²") == 8


def test_dimensions_are_the_clear_lengths() -> None:
    shown = texts(group(parse(small_flat()), "dimensions"))
    assert {"4.20", "3.25", "7.60", "3.40"} <= set(shown)


def test_a_face_in_two_pieces_is_dimensioned_once() -> None:
    plan = small_flat()
    ring = shapely.get_coordinates(plan.regions[0].polygon.exterior)
    middle = (ring[:-1] + ring[1:]) / 2
    cut = shapely.Polygon(np.column_stack([ring[:-1], middle]).reshape(-1, 2))
    split = replace(plan, regions=(replace(plan.regions[0], polygon=cut), *plan.regions[1:]))
    assert texts(group(parse(split), "dimensions")) == texts(group(parse(plan), "dimensions"))


def test_the_legend_names_a_shut_door_only_where_there_is_one() -> None:
    plan = small_flat()
    assert "Door, found shut" not in texts(group(parse(plan), "legend"))
    shut = replace(plan, doors=(replace(plan.doors[0], shut=True), *plan.doors[1:]))
    assert "Door, found shut" in texts(group(parse(shut), "legend"))


def test_title_block_states_area_basis_scale_and_share() -> None:
    plan = l_corridor()
    shown = " ".join(texts(group(parse(plan), "title-block")))
    assert (
        f"{sum(r.area for r in plan.regions):.2f} m² net internal area to wall faces; 89 % observed" in shown
    )
    assert "1:100" in shown
    assert "17.00°" in shown


def test_hostile_names_are_escaped() -> None:
    name = "<script>alert(\"1\")</script> & 'x' \x00\x0b"
    plan = make_plan([RoomSpec((0, 0, 9, 5), name=name)], source=name)
    root = parse(plan)
    assert not [e for e in root.iter() if e.tag.endswith("script")]
    assert any("<script>" in t for t in texts(root))


def test_same_plan_same_bytes(tmp_path: Path) -> None:
    for name in ("a", "b"):
        SvgExporter().write(office(), tmp_path / name)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_no_assets_from_elsewhere() -> None:
    text = svg_text(office())
    assert set(re.findall(r"https?://[^\"' ]+", text)) == {"http://www.w3.org/2000/svg"}
    assert "<image" not in text


def test_predicted_floor_is_hatched_and_seen_floor_is_not() -> None:
    plan = l_corridor()
    hatched = list(group(parse(plan), "predicted").iter(f"{NS}path"))
    assert len(hatched) == 2  # the two rooms that were seen in part
    assert all(p.get("fill", "").startswith("url(#predicted") for p in hatched)
    area = predicted_floor(plan)
    assert area.area == pytest.approx(plan.speculated().area, rel=0.05)
    seen = replace(plan, grid=replace(plan.grid, states=plan.grid.states * 0 + 1))
    assert not list(group(parse(seen), "predicted").iter(f"{NS}path"))


def test_guessed_walls_are_told_apart() -> None:
    walls = poche(l_corridor())
    assert walls.guessed.area > 0
    assert walls.observed.intersection(walls.guessed).area == pytest.approx(0, abs=1e-9)
    assert group(parse(l_corridor()), "walls-guessed").get("stroke-dasharray")
    assert poche(small_flat()).guessed.is_empty


def test_walls_fill_the_gaps_and_spare_floor_and_doors() -> None:
    plan = l_corridor()
    walls = poche(plan)
    floor = shapely.union_all([r.polygon for r in plan.regions])
    solid = walls.observed.union(walls.guessed)
    assert solid.intersection(floor).area == pytest.approx(0, abs=1e-9)
    assert solid.contains(shapely.Point(3.575, 2.0))  # between rooms 1 and 2
    for opening in walls.openings:
        assert solid.intersection(shapely.box(*opening.bounds)).area == pytest.approx(0, abs=1e-9)
        x0, y0, x1, y1 = opening.bounds
        assert min(x1 - x0, y1 - y0) == pytest.approx(0.15, abs=1e-6)


def test_an_opening_is_as_deep_as_its_wall_where_another_wall_ends_in_it() -> None:
    """Stairs in a hall: the wall beside them reaches into the line of the opening at their foot."""
    hall = RoomSpec([(0, 0), (5, 0), (5, 6), (1, 6), (1, 1), (0, 1)])
    foot = DoorSpec(1, 1.0, 0.1, 1.0, "opening", (0, 1), thickness=0.1)
    (opening,) = poche(make_plan([hall, RoomSpec((0, 1, 1, 6))], [foot])).openings
    x0, y0, x1, y1 = opening.bounds
    assert (x0, x1) == (0.1, 1.0) and y1 - y0 == pytest.approx(0.1, abs=0.01)


def test_doors_open_into_rooms_over_free_floor() -> None:
    plan = l_corridor()
    corridor = plan.regions[-1].polygon
    for opening in poche(plan).openings:
        made = leaves(opening, plan.regions)
        assert bool(made) == (opening.door.kind == "door")
        for leaf in made:
            assert leaf.sector.intersection(corridor).area < 1e-3
            assert any(
                r.polygon.intersection(leaf.sector).area > 0.99 * leaf.sector.area for r in plan.regions
            )


def test_openings_have_dashes_and_no_swing() -> None:
    rooms = [RoomSpec((0, 0, 4, 4)), RoomSpec((4.15, 0, 8, 4))]
    plan = make_plan(rooms, [DoorSpec(0, 4.075, 1.0, 3.0, "opening", (0, 1))])
    doors = group(parse(plan), "doors")
    assert not [p for p in doors.iter(f"{NS}path") if "A" in (p.get("d") or "")]
    assert all(line.get("stroke-dasharray") for line in doors.iter(f"{NS}line"))


def test_room_labels_stay_on_their_floor() -> None:
    from floorplan_core.exporters.placement import block_size
    from floorplan_core.exporters.svg_labels import place_labels

    plan = office()
    sheet = lay_out((-0.15, -0.15, 61.3, 24.1))
    for region, label in zip(plan.regions, place_labels(sheet, plan, []), strict=True):
        w, h = block_size(label.lines)[:: -1 if label.turned else 1]
        box = shapely.box(label.x - w / 2, label.y - h / 2, label.x + w / 2, label.y + h / 2)
        assert label.fits
        assert sheet.geometry(region.polygon).contains(box)


@pytest.mark.parametrize(
    ("width", "height"), [(3, 2), (8, 6), (18, 18), (25, 56), (60, 25), (80, 40), (900, 700)]
)
def test_scale_is_the_finest_that_fits(width: float, height: float) -> None:
    sheet = lay_out((0.0, 0.0, width, height))
    assert sheet.scale in SCALES
    corners = sheet.to_page([[0, 0], [width, height]])
    assert corners.min() > 0
    assert corners[:, 0].max() < sheet.width
    assert corners[:, 1].max() < sheet.height
    if width < 900:
        short, long = sorted((sheet.width, sheet.height))
        assert short <= 297
        assert long <= 420
    assert all(0 < x < sheet.width and 0 < y < sheet.height for x, y in sheet.blocks)


def test_numbers_of_a_site_do_not_lie_on_each_other() -> None:
    """At 1:2000 no number fits its room at the usual size; there each is as small as it has to be."""
    pitch = 2.4 + 0.15
    rooms = [RoomSpec((k * pitch, 0, k * pitch + 2.4, 3.0)) for k in range(101, 109)]
    far = RoomSpec((500.0, 400.0, 504.0, 403.0))
    plan = make_plan([*rooms, far], [])
    plan = replace(plan, regions=tuple(replace(r, name=str(1000 + k)) for k, r in enumerate(plan.regions)))
    walls = poche(plan)
    sheet = lay_out(drawn_bounds(plan, walls))
    assert sheet.scale == 2000
    placed = place_labels(sheet, plan, [])
    boxes = [shapely.box(*_box(label)) for label in placed]
    floors = [sheet.geometry(region.polygon) for region in plan.regions]
    assert all(floor.covers(box) for floor, box in zip(floors[:-1], boxes[:-1], strict=True))
    assert not any(a.intersects(b) for k, a in enumerate(boxes) for b in boxes[:k])
    assert all(label.lines[0].text == region.name for label, region in zip(placed, plan.regions, strict=True))
    alone = place_labels(sheet, replace(plan, regions=plan.regions[-1:]), [])[0]
    assert alone == placed[-1] and alone.lines[0].size > 2 * placed[0].lines[0].size


def _box(label: Placed) -> tuple[float, float, float, float]:
    width, height = block_size(label.lines)[:: -1 if label.turned else 1]
    return label.x - width / 2, label.y - height / 2, label.x + width / 2, label.y + height / 2


def test_empty_plan_still_draws() -> None:
    root = parse(replace(small_flat(), regions=(), doors=()))
    assert "0 regions" in " ".join(texts(root))


def test_numbers_and_text() -> None:
    assert [number(v) for v in (1.0, -0.0001, 0.1234567, 12.5)] == ["1", "0", "0.123", "12.5"]
    assert printable("a\x00b\ud800c²") == "a b c²"


def test_unknown_labels_empty_names_and_no_source() -> None:
    rooms = [RoomSpec((0, 0, 4, 4), label="lobby"), RoomSpec((4.15, 0, 8, 4), label="")]
    plan = make_plan(rooms, source="")
    plan = replace(plan, regions=tuple(replace(r, name="", sides=()) for r in plan.regions))
    shown = " ".join(texts(parse(plan)))
    assert "lobby" in shown
    assert "15.40 m²" in shown


def test_touching_regions_get_a_wall_between_them() -> None:
    plan = make_plan(
        [RoomSpec((0, 0, 4, 4)), RoomSpec((4, 0, 8, 4))], [DoorSpec(0, 4.05, 1.0, 1.9, joins=(0, 1))]
    )
    walls = poche(plan)
    assert walls.observed.contains(shapely.Point(4.0, 3.0))
    assert not walls.observed.intersects(shapely.Point(4.0, 1.5))  # the door


def test_text_has_whole_sizes_for_viewers_that_cut_off_the_rest() -> None:
    """QtSvg takes 1.9 for 1: text is written large and scaled down to its millimetres."""
    for element in parse(office()).iter(f"{NS}text"):
        size, place = float(element.get("font-size", "0")), element.get("transform", "")
        scale = re.search(r"scale\(([\d.]+)\)", place)
        assert scale is not None and size >= 20
        assert 1.0 < size * float(scale[1]) < 5.0  # mm


def test_the_legend_explains_only_what_is_drawn() -> None:
    plan = small_flat()
    rooms = tuple(replace(r, label="room") for r in plan.regions)
    without = texts(group(parse(replace(plan, regions=rooms, doors=())), "legend"))
    assert "Room" in without
    assert not {"Corridor", "Door", "Opening"} & set(without)
    assert {"Corridor"} <= set(texts(group(parse(replace(plan, regions=_relabelled(plan))), "legend")))


def _relabelled(plan: Any) -> Any:
    return (replace(plan.regions[0], label="corridor"), *plan.regions[1:])
