"""The settings' table, YAML and page come from one declaration, and the page in docs/ is up to date."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import Field

from floorplan_core.config import Config, Section
from floorplan_core.errors import FloorPlanError
from floorplan_core.settings_table import COMMAND, markdown_page, setting_rows

PAGE = Path(__file__).resolve().parents[1] / "docs" / "settings.md"


def test_the_page_of_the_documentation_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == markdown_page(Config()), f"run: {COMMAND}"


def test_every_setting_has_a_meaning_and_every_number_bounds() -> None:
    for row in setting_rows(Config()):
        stage, _, name = row.name.partition(".")
        assert row.meaning.endswith("."), row.name
        if isinstance(getattr(getattr(Config(), stage), name), float | int):
            assert row.bounds, row.name


def test_rows_show_values_units_bounds_and_choices() -> None:
    rows = {row.name: row for row in setting_rows(Config().with_values({"doors.max_width": "1.2"}))}
    assert (rows["doors.max_width"].value, rows["doors.max_width"].unit) == ("1.2", "m")
    assert rows["doors.max_width"].bounds == "> 0.3, ≤ 4"
    assert rows["frame.yaw_deg"].value == "none" and rows["frame.yaw_deg"].bounds == "≥ -180, ≤ 180"
    assert rows["cover.solver"].bounds == "greedy, exact"


def test_a_setting_declared_without_a_unit_is_found() -> None:
    class Bare(Section):
        width: float = Field(1.0, description="Of what?")

    class Broken(Config):
        bare: Bare = Bare()

    with pytest.raises(FloorPlanError, match="'Of what\\?' was declared without a unit"):
        setting_rows(Broken())
