"""YAML of settings: data only, and every other file is one sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from floorplan_core.config import Config
from floorplan_core.errors import UsageError
from floorplan_core.plain_yaml import MOST_BYTES, parse_yaml, read_yaml

LAUGHS = "a: &a [x, x, x, x]\n" + "".join(
    f"{b}: &{b} [*{a}, *{a}, *{a}, *{a}]\n"
    for a, b in zip("abcdefghijklmnopqrst", "bcdefghijklmnopqrstu", strict=True)
)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (LAUGHS + "doors: {max_width: *u}\n", "refers to parts of itself"),
        ("doors: !!python/object/apply:os.getcwd []\n", "could not determine a constructor"),
        ("doors: " + "[" * 5000 + "]" * 5000, "nested too deeply"),
        ("doors: {max_width: 2001-99-99}\n", "month must be in"),
        ("doors: {max_width: 1" + "0" * 9000 + "}\n", "not valid YAML"),
        ("#" * (MOST_BYTES + 1), "is larger than 1,048,576 bytes"),
        ("doors: [\n", "not valid YAML"),
    ],
)
def test_what_is_more_than_data_is_refused_with_a_sentence(tmp_path: Path, text: str, says: str) -> None:
    path = tmp_path / "settings.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(UsageError, match=says) as caught:
        Config.load(path)
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


def test_settings_of_the_command_line_too() -> None:
    with pytest.raises(UsageError, match=r"doors\.max_width: .* refers to parts of itself"):
        Config().with_values({"doors.max_width": "[&a 1, *a]"})


def test_data_comes_back(tmp_path: Path) -> None:
    path = tmp_path / "settings.yaml"
    path.write_text("\ufeffdoors: {max_width: 1.2}\n", encoding="utf-8")
    assert read_yaml(path) == {"doors": {"max_width": 1.2}}
    assert parse_yaml("[1, two, 3.0, null]") == [1, "two", 3.0, None]
