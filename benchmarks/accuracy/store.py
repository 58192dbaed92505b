"""The last result: ``benchmarks/results/accuracy.json``, ``docs/accuracy.md``, pictures of the worst."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from benchmarks.accuracy import tables
from benchmarks.accuracy.record import Record, badness

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / "benchmarks" / "results" / "accuracy.json"
DOCUMENT = ROOT / "docs" / "accuracy.md"
PICTURES = ROOT / "docs" / "accuracy"
WORST = 5

INTRODUCTION = """# Accuracy

Written by `make accuracy` (`python -m benchmarks.accuracy`); do not edit. Simulated surveys vary style,
sensor, exploration, furniture, noise and drift together; settings are tuned on the first half of the seeds
only, so the *held out* column counts. A number that misses its target carries a cross. Every survey weighs
the same in a mean. Every sensor with every noise and every clutter: [robustness](robustness.md).

- **dimension error**: the plan's own distance between two wall faces against the truth's, in rooms that
  were entered. A line is shot both ways from the middle of the true dimension to the boundary of the region
  that holds it; it counts as measured (*share*) where both ends lie within 1 m of the true faces.
- **room F1, IoU**: regions and true rooms (interior faces) matched one to one by largest total intersection
  over union; found at 0.5; the mean IoU counts a missed room as 0. *Entered*: the sensor was inside and saw
  at least half of the floor; *glimpsed*: it saw at least 15 %; rooms seen less are neither expected nor
  forbidden.
- **labels**: room or corridor, over the rooms found; by the paper's classifier (the default) and by `shape`
  (`--set labels.classifier=shape`).
- **doors**: same wall (middles within 0.5 m across it) and overlapping along it by half of the narrower
  one. Expected are open doors of rooms that were entered; shut ones may be found or not; a window called a
  door is wrong. Width errors are over the doors found. *Wide openings*: those without a leaf, 1.6 to 2.8 m;
  the share is a mean over the surveys that have any.
- **free space**: area of all regions against the floor of all rooms; *outside* is beyond the outer walls.
  For `octomap_fr079_3d` it is the share of cells, among those that the real sensor carved free or saw as
  wall.
- **predicted area right**: share of the floor that was predicted, not seen, which is floor in truth.
"""
RELIABILITY = """Every aperture in a wall, reported or not, by the probability that it was given, and how many
are doors or openings in truth (shut ones too). The probabilities were fitted on the tuning half and on
36 surveys that are in neither; in the other column they are used as they are. Doors below
`doors.min_confidence` are not reported.
"""
LABELS = """Rooms found whose label by the paper's classifier is wrong, all surveys. The rule is the paper's
(perimeter below 60 m and turning distance to the square below 1: a room); the last columns are of the true
outline, and where the rule is wrong about that too, no better plan would help. The turning distance of a
rectangle to the square is below pi / 4 = 0.785 however long it is, so a straight corridor is a room to the
rule unless its perimeter reaches 60 m; of a corridor that runs round, only the outer boundary counts, which
is nearly square. `labels.classifier=shape` asks for doors and ways through instead.
"""


def load() -> list[Record]:
    """The records of the last full run; none where there was none."""
    if not RESULTS.is_file():
        return []
    return list(json.loads(RESULTS.read_text(encoding="utf-8"))["surveys"])


def save(records: Sequence[Record], path: Path | None = None) -> None:
    """Keep the records, rounded so that a change of the last digit of a float is no change of the file."""
    rounded = [{k: round(v, 6) if isinstance(v, float) else v for k, v in r.items()} for r in records]
    path = path or RESULTS
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"surveys": rounded}, indent=1) + "\n", encoding="utf-8")


def worst_records(records: Sequence[Record], count: int = WORST) -> list[Record]:
    """The surveys farthest from perfect, worst first (ties: in order)."""
    return sorted(records, key=lambda r: -badness(r))[:count]


def picture_path(rank: int) -> Path:
    """The picture of the ``rank``-th worst survey (from 1)."""
    return PICTURES / f"worst-{rank}.png"


def write_document(records: Sequence[Record], last: Sequence[Record]) -> None:
    """Totals, change against the last run, single surveys and pictures as Markdown."""
    simulated = [r for r in records if r["half"] != "shared"]
    shared = [r for r in records if r["half"] == "shared"]
    parts = [
        INTRODUCTION,
        "## Simulated surveys, both halves\n",
        tables.markdown(tables.totals(records, last)),
    ]
    parts += ["\n## Shared surveys\n", tables.markdown(tables.surveys(shared))] if shared else []
    parts += ["\n## Prediction, by how much was seen\n", tables.markdown(tables.exploration(simulated))]
    parts += ["\n## What hurts\n", tables.markdown(tables.factors(simulated))]
    parts += ["\n## Single surveys\n", tables.markdown(tables.surveys(simulated))]
    parts += ["\n## Labels of the paper's rule\n", LABELS, tables.markdown(tables.mislabelled(records))]
    parts += ["\n## Confidence of doors\n", RELIABILITY, tables.markdown(tables.reliability(simulated))]
    parts += [_failures(records), "\n## The five worst\n", *_pictures(records)]
    DOCUMENT.parent.mkdir(parents=True, exist_ok=True)
    DOCUMENT.write_text("\n".join(p for p in parts if p) + "\n", encoding="utf-8")


def _failures(records: Sequence[Record]) -> str:
    failed = [f"- {r['name']}: {r['error']}" for r in records if r["error"]]
    return "\n".join(["\n## No plan\n", *failed]) if failed else ""


def _pictures(records: Sequence[Record]) -> list[str]:
    return [
        f"{rank}. {r['name']} ({r['half']})\n\n   ![{r['name']}]({PICTURES.name}/{picture_path(rank).name})\n"
        for rank, r in enumerate(worst_records(records), start=1)
    ]
