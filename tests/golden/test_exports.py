"""The exports of one small plan, byte for byte: a change shows up as a difference that somebody looks at.

To accept a change, run this file as a script from the checkout: ``python -m tests.golden.test_exports``.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from floorplan_core import __version__
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.exporters.svg import svg_text
from tests.factories import l_corridor

HERE = Path(__file__).parent
WRITERS = {"l_corridor.geojson": geojson_text, "l_corridor.svg": svg_text}


def made(name: str) -> str:
    text = WRITERS[name](l_corridor(2, 2, shift=(512345.678, 5412345.123, 310.5)))
    return text.replace(f'"version": "{__version__}"', '"version": "x.y.z"')


@pytest.mark.parametrize("name", WRITERS)
def test_export_is_unchanged(name: str) -> None:
    assert made(name) == (HERE / name).read_text(encoding="utf-8")


if __name__ == "__main__":
    for target in WRITERS:
        (HERE / target).write_text(made(target), encoding="utf-8", newline="\n")
