"""The benchmark's book-keeping: balanced halves, honest totals, changes since the last run, failures."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import pytest

from tests.evaluation.evaluation_cases import perfect_plan, truth

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks.accuracy import paper_labels, record, reliability, runner, store, tables
from benchmarks.accuracy.__main__ import main
from benchmarks.accuracy.cases import HALVES, Case, chosen_cases, simulated_cases
from benchmarks.accuracy.overlay import draw_overlay
from floorplan_core.config import Config
from floorplan_core.errors import NoPlanError
from floorplan_core.evaluation import compare, parse_plan
from floorplan_core.evaluation.truth import Truth, TruthDoor, TruthRoom
from floorplan_core.evaluation.truths import parse_truth
from tests.factories import l_corridor


def perfect():
    return parse_plan(perfect_plan(), "plan"), parse_truth(truth(), "truth")


def entry(name="a", half=HALVES[1], **values):
    full = {metric.key: None for metric in record.METRICS}
    return {"name": name, "half": half, "factors": {}, "error": "", **full, **values}


def test_the_halves_are_balanced_and_share_no_seed():
    cases = simulated_cases()
    assert len(cases) == 36
    assert len({c.name for c in cases}) == len({c.spec.seed for c in cases}) == 36
    for half in HALVES:
        mine = [dict(c.factors) for c in cases if c.half == half]
        for factor, levels in (("style", 6), ("sensor", 3), ("explored", 3), ("furniture", 3), ("drift", 3)):
            counts = Counter(f[factor] for f in mine)
            assert len(counts) == levels, (half, factor)
            assert max(counts.values()) <= 2.1 * len(mine) / levels, (half, factor, counts)
        pairs = {(f["sensor"], f["explored"]) for f in mine}
        assert len(pairs) >= 6


def test_a_name_chooses_surveys_and_an_unknown_one_is_refused(capsys):
    assert {c.half for c in chosen_cases(False, "ring")} == set(HALVES)
    assert len(chosen_cases(True, None)) >= 6
    assert main(["--only", "no such survey"]) == 2
    assert "no such survey" in capsys.readouterr().out


def test_fresh_seeds_make_surveys_of_the_same_kind_that_no_half_holds():
    fresh = chosen_cases(False, None, [4000, 5000])
    assert len(fresh) == 36
    assert not {c.spec.seed for c in fresh} & {c.spec.seed for c in simulated_cases()}
    held_out = [c.factors for c in simulated_cases() if c.half == HALVES[1]]
    assert [c.factors for c in fresh[:18]] == held_out
    header, rows = tables.totals([entry(half="fresh", iou_entered=0.9)], [])
    assert header[2:4] == ["tuning", "fresh"]
    assert next(r for r in rows if r[0] == "room IoU, entered")[3] == "0.900 ✗"


def test_a_perfect_plan_is_the_least_bad_and_an_empty_one_worse_than_any_error():
    plan, true = perfect()
    best = record.record(compare(plan, true))
    lost = record.record(compare(runner.nothing(), true))
    assert record.badness(best) == pytest.approx(0, abs=1e-9)
    assert record.badness(lost) > 1.4
    assert (lost["f1_entered"], lost["iou_entered"], lost["door_recall"]) == (0, 0, 0)


def test_totals_mark_missed_targets_and_name_the_worst_survey():
    records = [
        entry("good", iou_entered=0.99),
        entry("bad", iou_entered=0.5),
        entry("t", HALVES[0], iou_entered=1.0),
    ]
    last = [entry("good", iou_entered=0.99), entry("bad", iou_entered=0.7), entry("other", iou_entered=0.0)]
    _, rows = tables.totals(records, last)
    row = next(r for r in rows if r[0] == "room IoU, entered")
    assert row[2:] == ["1.000", "0.745 ✗", "0.500 ✗", "bad", "-0.100 worse"]


@pytest.mark.parametrize(
    ("new", "old", "word"), [(0.02, 0.01, "+0.010 worse"), (0.01, 0.02, "-0.010 better"), (0.01, 0.0101, "=")]
)
def test_change_knows_which_way_is_better(new, old, word):
    metric = next(m for m in record.METRICS if m.key == "dimension_m")
    assert tables.change(new, old, metric) == word
    assert tables.change(new, None, metric) == ""


def test_a_survey_without_a_plan_scores_zero_and_keeps_its_reason(tmp_path, monkeypatch):
    import json

    def fail(*_):
        raise NoPlanError("No Manhattan structure was found.")

    (tmp_path / "truth.json").write_text(json.dumps(truth()))
    monkeypatch.setattr(runner, "make_plan", fail)
    found = runner.run_case(Case("broken", "shared", folder=tmp_path), Config())
    assert found["error"] == "No Manhattan structure was found."
    assert found["iou_entered"] == 0


def test_results_survive_and_the_document_names_everything(tmp_path, monkeypatch):
    monkeypatch.setattr(store, "RESULTS", tmp_path / "results" / "accuracy.json")
    monkeypatch.setattr(store, "DOCUMENT", tmp_path / "accuracy.md")
    assert store.load() == []
    records = [
        entry("a", iou_entered=0.123456789, seconds=1.0),
        entry("b", error="No plan: a sphere.", seconds=1.0),
    ]
    store.save(records)
    assert store.load()[0]["iou_entered"] == 0.123457
    store.write_document(records, store.load())
    text = (tmp_path / "accuracy.md").read_text()
    for word in ("| room IoU, entered |", "| a | held out |", "- b: No plan: a sphere.", "worst-2.png"):
        assert word in text


@pytest.mark.parametrize(("length", "label"), [(6.0, "room"), (27.0, "room"), (29.0, "corridor")])  # 2 m wide
def test_the_papers_rule_calls_straight_corridors_rooms_up_to_sixty_metres(length, label):
    import shapely

    corridor = TruthRoom("0", shapely.box(0, 0, length, 2.0), "corridor")
    config = Config().labels
    found, perimeter, turning = paper_labels.by_rule(corridor, config)
    assert found == label
    assert perimeter == pytest.approx(2 * length + 4)
    assert turning < 3.1416 / 4
    assert paper_labels.on_true_outlines(Truth("t", rooms=(corridor,)), config) == (label == "corridor")
    assert paper_labels.on_true_outlines(Truth("t"), config) is None


def test_wrong_labels_are_listed_with_what_the_rule_says_of_the_true_outline():
    plan, true = perfect()
    config = Config().labels
    assert paper_labels.mislabelled(compare(plan, true), true, config) == []
    turned = {r.id: "corridor" if r.label == "room" else "room" for r in plan.regions}
    wrong = paper_labels.mislabelled(compare(runner.relabelled(plan, turned), true), true, config)
    assert [w["room"] for w in wrong] == [r.name for r in true.rooms if r.kind and r.exposure != "hidden"]
    assert all(w["label"] != w["kind"] for w in wrong)
    _, rows = tables.mislabelled([entry("a", mislabelled=wrong), entry("b")])
    assert [row[0] for row in rows] == ["a"] * len(wrong)


def test_the_overlay_shows_regions_truth_and_a_missed_room(tmp_path):
    from PIL import Image

    from benchmarks.accuracy import overlay

    document = perfect_plan()
    del document["features"][1]
    true = parse_truth(truth(), "truth")
    path = tmp_path / "overlay.png"
    draw_overlay(parse_plan(document, "plan"), true, "title", "remark", path)
    pixels = Image.open(path).convert("RGB")
    colours = {colour for _, colour in pixels.getcolors(pixels.width * pixels.height)}
    for colour in (overlay.FILL["room"], overlay.FILL["corridor"], overlay.LOST, overlay.FOUND, overlay.INK):
        assert colour in colours


def test_confidences_are_compared_with_what_is_there():
    sure = [(0.97, True)] * 9 + [(0.97, False)]
    doubtful = [(0.1, False)] * 3
    rows = {name: (count, mean, share) for name, count, mean, share in reliability.table(sure + doubtful)}
    assert rows["0.95 to 1"] == (10, pytest.approx(0.97), pytest.approx(0.9))
    assert rows["0.05 to 0.2"] == (3, pytest.approx(0.1), 0.0)
    assert rows["0.4 to 0.6"] == (0, None, None)
    assert sum(count for count, _, _ in rows.values()) == 13
    assert reliability.brier([(1.0, True), (0.0, False)]) == 0.0
    assert reliability.brier([(0.5, True)]) == pytest.approx(0.25)


def test_apertures_are_judged_in_the_axes_of_the_building():
    plan = l_corridor()
    doors = list(plan.doors)
    line = plan.to_world(doors[0].line())
    low, high = line.min(axis=0) - 0.05, line.max(axis=0) + 0.05
    only = TruthDoor((*low, *high), doors[0].axis)
    judged = reliability.judge(doors, plan, Truth("truth", doors=(only,)))
    assert judged[0] == (pytest.approx(doors[0].confidence, abs=1e-3), True)
    assert not any(right for _, right in judged[1:])
    assert len(judged) == len(doors)
