"""Tables of the benchmark: for the terminal (rich) and for ``docs/accuracy.md``."""

from __future__ import annotations

from collections.abc import Sequence

from benchmarks.accuracy import reliability as bins
from benchmarks.accuracy.cases import FRESH, HALVES
from benchmarks.accuracy.record import METRICS, Metric, Record, mean, worst

# Columns of the table of single surveys: key, title, digits.
COLUMNS = (
    ("yaw_error_deg", "yaw °", 2),
    ("dimension_m", "dim m", 3),
    ("dimension_max_m", "max m", 2),
    ("dimension_share", "share", 2),
    ("f1_entered", "F1", 2),
    ("iou_entered", "IoU", 3),
    ("recall_glimpsed", "glimpsed", 2),
    ("labels", "labels", 2),
    ("labels_shape", "shape", 2),
    ("door_precision", "door P", 2),
    ("door_recall", "door R", 2),
    ("door_width_m", "width m", 3),
    ("free_precision", "free P", 3),
    ("free_recall", "free R", 3),
    ("outside_percent", "out %", 1),
    ("seconds", "s", 1),
)
# Columns of the tables of what hurts: title, key (none: how many surveys).
EFFECTS = {
    "surveys": "",
    "dimension m": "dimension_m",
    "F1": "f1_entered",
    "IoU": "iou_entered",
    "door P": "door_precision",
    "door R": "door_recall",
}
Table = tuple[list[str], list[list[str]]]  # header, rows


def number(value: float | None, digits: int) -> str:
    """Fixed digits, a dash where there is nothing."""
    return "–" if value is None else f"{value:.{digits}f}"


def change(new: float | None, old: float | None, metric: Metric) -> str:
    """Signed difference with a word where it matters at the printed precision."""
    if new is None or old is None:
        return ""
    difference = round(new - old, metric.digits)
    if difference == 0:
        return "="
    word = "better" if difference * metric.good > 0 else "worse"
    return f"{difference:+.{metric.digits}f} {word}"


def totals(records: Sequence[Record], last: Sequence[Record]) -> Table:
    """One row a metric: target, mean of each half, worst survey and change of what counts."""
    halves = halves_of(records)
    header = ["metric", "target", *halves, f"worst {halves[1]}", "survey", f"{halves[1]} against last"]
    return header, [_total(metric, records, last, halves) for metric in METRICS]


def halves_of(records: Sequence[Record]) -> tuple[str, str]:
    """The half that was tuned on, and the one that counts: the held out, or fresh surveys where there are."""
    return HALVES[0], FRESH if any(r["half"] == FRESH for r in records) else HALVES[1]


def _total(
    metric: Metric, records: Sequence[Record], last: Sequence[Record], halves: tuple[str, str]
) -> list[str]:
    of_half = [[r for r in records if r["half"] == half] for half in halves]
    means = [mean(some, metric.key) for some in of_half]
    low = worst(of_half[1], metric)
    names = {r["name"] for r in of_half[1]}
    before = mean([r for r in last if r["name"] in names], metric.key)
    return [
        metric.title,
        target(metric),
        *(marked(value, metric) for value in means),
        marked_worst(low and low[metric.key], metric),
        low["name"] if low else "",
        change(means[1], before, metric),
    ]


def target(metric: Metric) -> str:
    """Like ``≤ 0.01, worst ≤ 0.03``."""
    sign = "≥" if metric.good > 0 else "≤"
    if metric.target is None:
        return ""
    limit = f"{sign} {metric.target:g}"
    return limit if metric.worst is None else f"{limit}, worst {sign} {metric.worst:g}"


def marked(value: float | None, metric: Metric) -> str:
    """The number, with a cross where it misses its target."""
    text = number(value, metric.digits)
    if value is None or metric.target is None:
        return text
    return text if metric.good * (value - metric.target) >= 0 else f"{text} ✗"


def marked_worst(value: float | None, metric: Metric) -> str:
    """The same for the worst survey."""
    text = number(value, metric.digits)
    missed = value is not None and metric.worst is not None and metric.good * (value - metric.worst) < 0
    return f"{text} ✗" if missed else text


def surveys(records: Sequence[Record]) -> Table:
    """One row a survey."""
    header = ["survey", "half", *(title for _, title, _ in COLUMNS)]
    rows = [[r["name"], r["half"], *(number(r.get(k), d) for k, _, d in COLUMNS)] for r in records]
    return header, rows


def exploration(records: Sequence[Record]) -> Table:
    """How good prediction is, by how much was explored (both halves)."""
    keys = (
        "iou_entered",
        "recall_glimpsed",
        "iou_glimpsed",
        "predicted_m2",
        "predicted_right",
        "outside_percent",
    )
    titles = ("IoU entered", "recall glimpsed", "IoU glimpsed", "predicted m²", "right", "outside %")
    levels = sorted(
        {r["factors"].get("explored", "") for r in records} - {""}, key=lambda s: -float(s.split()[0])
    )
    rows = []
    for level in levels:
        group = [r for r in records if r["factors"].get("explored") == level]
        rows.append([level, str(len(group)), *(number(mean(group, key), 3) for key in keys)])
    return ["explored", "surveys", *titles], rows


def factors(records: Sequence[Record]) -> Table:
    """Mean results by the level of each factor: what hurts most."""
    rows = []
    for factor in ("sensor", "furniture", "style", "noise", "drift"):
        for level in sorted({r["factors"].get(factor, "") for r in records} - {""}):
            group = [r for r in records if r["factors"].get(factor) == level]
            rows.append([f"{factor}: {level}", *effects(group)])
    return ["factor", *EFFECTS], rows


def effects(group: Sequence[Record]) -> list[str]:
    """How many surveys, and the means that :data:`EFFECTS` names."""
    return [str(len(group)), *(number(mean(group, key), 3) for key in EFFECTS.values() if key)]


def reliability(records: Sequence[Record]) -> Table:
    """Confidence of apertures against truth, both halves side by side; the last row is the Brier score."""
    halves = halves_of(records)
    judged = {
        h: [tuple(a) for r in records if r["half"] == h for a in r.get("apertures", [])] for h in halves
    }
    header = [
        "confidence",
        *(f"{half}: {what}" for half in halves for what in ("apertures", "mean", "doors")),
    ]
    columns = [bins.table(judged[half]) for half in halves]
    rows = [
        [
            both[0][0],
            *(cell for _, n, mean, share in both for cell in (str(n), number(mean, 2), number(share, 2))),
        ]
        for both in zip(*columns, strict=True)
    ]
    scores = [["", "", number(bins.brier(judged[half]), 4)] for half in halves]
    return header, [*rows, ["Brier score", *(cell for score in scores for cell in score)]]


def mislabelled(records: Sequence[Record]) -> Table:
    """The rooms of each survey that carry the wrong label, and what the rule says of their true outlines."""
    header = ["survey", "room", "is", "called", "by its true outline", "perimeter, m", "turning distance"]
    rows = [
        [
            r["name"],
            w["room"],
            w["kind"],
            w["label"],
            w["by_outline"],
            f"{w['perimeter']:.1f}",
            f"{w['turning']:.2f}",
        ]
        for r in records
        for w in r.get("mislabelled", [])
    ]
    return header, rows


def markdown(table: Table) -> str:
    """A table of GitHub's Markdown."""
    header, rows = table
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])
