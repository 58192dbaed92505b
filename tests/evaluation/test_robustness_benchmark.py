"""The sweep over sensors, noise and clutter: its plan of surveys, and one survey from end to end."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks import robustness
from benchmarks.accuracy.cases import simulated_cases
from benchmarks.accuracy.surveys import CACHE_VARIABLE


def test_every_condition_has_the_same_buildings_and_no_seed_of_the_halves():
    cases = robustness.cases()
    conditions: dict[tuple[str, ...], set[int]] = {}
    for case in cases:
        factors = dict(case.factors)
        conditions.setdefault(tuple(factors[n] for n in robustness.CONDITION), set()).add(case.spec.seed)
    assert len(conditions) == 4 * 3 * 3
    assert len({frozenset(seeds) for seeds in conditions.values()}) == 1
    assert len({case.name for case in cases}) == len(cases)
    assert not {c.spec.seed for c in cases} & {c.spec.seed for c in simulated_cases()}


def test_one_survey_runs_and_is_kept_as_a_row(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv(CACHE_VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setattr(robustness, "RESULTS", tmp_path / "robustness.json")
    monkeypatch.setattr(robustness, "DOCUMENT", tmp_path / "robustness.md")
    monkeypatch.setattr(robustness, "ROOT", tmp_path)
    monkeypatch.setattr(
        robustness, "cases", lambda seed: [c for c in ALL if "planar-none-20mm-flat" in c.name]
    )
    assert robustness.main([]) == 0
    (entry,) = json.loads((tmp_path / "robustness.json").read_text())["surveys"]
    assert entry["error"] == "" and entry["iou_entered"] > 0.5
    row = next(r for r in (tmp_path / "robustness.md").read_text().splitlines() if r.startswith("| planar"))
    assert row.split(" | ")[:4] == ["| planar", "none", "2.0 cm", "1"]
    assert f"{entry['iou_entered']:.3f}" in row


ALL = robustness.cases()


def test_a_part_is_not_kept_and_an_unknown_name_is_refused(monkeypatch, capsys):
    monkeypatch.setattr(robustness, "save", lambda *_: pytest.fail("a part was kept"))
    monkeypatch.setattr(
        robustness, "run_cases", lambda cases, *_: [{"factors": dict(c.factors)} for c in cases]
    )
    monkeypatch.setattr(robustness, "draw", lambda *_: None)
    assert robustness.main(["--only", "camera-heavy"]) == 0
    assert robustness.main(["--seed", "30000"]) == 0
    assert robustness.main(["--only", "sonar"]) == 2
    assert "sonar" in capsys.readouterr().out
