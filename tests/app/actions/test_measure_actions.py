"""The ground-truth table."""

from __future__ import annotations

import csv
import io

import pytest

from floorcast_app.actions.measure_actions import check_means, check_rows, table_csv
from floorcast_app.selection import Item
from floorcast_app.state import Check
from floorplan_core.errors import UsageError

CHECKS = (
    Check("c1", (0.0, 0.0), (3.0, 0.0), 3.01, "hall"),
    Check("c2", (0.0, 0.0), (0.0, 5.0), 4.96),
    Check("c3", (0.0, 0.0), (1.0, 1.0)),
)


def test_rows_and_means_are_those_of_the_paper():
    rows = check_rows(CHECKS)
    assert [r.difference for r in rows] == [pytest.approx(-0.01), pytest.approx(0.04), None]
    assert rows[1].percent == pytest.approx(100 * 0.04 / 4.96)
    assert [r.band for r in rows] == ["LOA30", "LOA20", ""]
    means = check_means(rows)
    assert means.count == 2
    assert means.mean_error == pytest.approx(0.025)
    assert means.mean_percent == pytest.approx((100 * 0.01 / 3.01 + 100 * 0.04 / 4.96) / 2)
    assert means.band == "LOA20"
    assert check_means(check_rows(CHECKS[2:])) is None


def test_the_table_as_csv_says_the_same():
    table = list(csv.reader(io.StringIO(table_csv(CHECKS))))
    assert table[0][0] == "id"
    assert table[1][:5] == ["c1", "hall", "3.0000", "3.0100", "-0.0100"]
    assert table[3][3:] == ["", "", "", ""]
    assert table[4][0] == "mean"
    assert float(table[4][4]) == pytest.approx(0.025)


def test_adding_setting_and_removing_are_steps(drawn):
    id = drawn.run("measure.add", start=(1.0, 2.0), end=(4.0, 6.0))
    assert id == "c1"
    assert drawn.selection.item == Item("check", "c1")
    drawn.run("measure.set", id="c1", metres=4.98)
    assert drawn.state.checks[0].measured == 4.98
    drawn.run("measure.set", id="c1", metres=4.98, note="door to door")
    assert drawn.run("measure.add", start=(0.0, 0.0), end=(1.0, 0.0)) == "c2"
    drawn.run("measure.remove", id="c1")
    assert drawn.run("measure.add", start=(0.0, 0.0), end=(1.0, 0.0)) == "c3"
    assert [c.id for c in drawn.state.checks] == ["c2", "c3"]
    drawn.document.go_to(0)
    assert drawn.state.checks == ()


@pytest.mark.parametrize(
    ("action", "arguments", "says"),
    [
        ("measure.add", {"start": (1, 1), "end": (1, 1)}, "the same"),
        ("measure.add", {"start": (1, 1), "end": (1, 2), "measured": -1.0}, "above 0 m"),
        ("measure.remove", {"id": "c9"}, "no measurement 'c9'"),
    ],
)
def test_what_makes_no_sense_is_said_in_a_sentence(drawn, action, arguments, says):
    drawn.run("measure.add", start=(0.0, 0.0), end=(1.0, 0.0))
    with pytest.raises(UsageError, match=says):
        drawn.run(action, **arguments)


def test_export_writes_the_table(drawn, tmp_path):
    drawn.run("measure.add", start=(0.0, 0.0), end=(3.0, 0.0), measured=3.02, note="kitchen, long side")
    drawn.run("measure.export", path=tmp_path / "table.csv")
    assert (tmp_path / "table.csv").read_text(encoding="utf-8") == table_csv(
        drawn.state.checks, drawn.to_plan
    )
    assert "kitchen" in (tmp_path / "table.csv").read_text(encoding="utf-8")
