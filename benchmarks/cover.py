"""Candidates and cover: how they grow, how long an office takes, and how far greedy is from the optimum."""

from __future__ import annotations

import numpy as np

from benchmarks.buildings import Layout, building, with_planes
from benchmarks.record import Outcome, cpu_seconds
from floorplan_core.config import Config
from floorplan_core.model import CandidateSet, Facing, LayoutPlane, RectangleCover
from floorplan_core.stages.candidates import enumerate_candidates
from floorplan_core.stages.exact_cover import exact_cover
from floorplan_core.stages.labels import PaperClassifier, label_regions
from floorplan_core.stages.regions import build_regions
from floorplan_core.stages.set_cover import greedy_cover

CONFIG = Config()
SIZES = ((18, 12), (30, 17), (40, 26), (60, 36), (90, 55), (120, 84), (150, 134))  # m: 216 to 20,100 m2
OFFICE, OFFICE_PLANES, TARGET = (80.0, 40.0), 100, 0.3
BUILDINGS = 100
REPEAT = 12  # runs of a few milliseconds each, of which the best counts


def candidates_of(layout: Layout) -> CandidateSet:
    """The valid rectangles of a building."""
    return enumerate_candidates(*layout.planes, layout.blockers, layout.grid, CONFIG.candidates)


def cover_of(layout: Layout, made: CandidateSet) -> RectangleCover:
    """The paper's cover of a building."""
    return greedy_cover(made, layout.grid, CONFIG.cover)


def growth() -> Outcome:
    """Seconds against floor area; the exponent is the slope of the straight line through the logarithms."""
    rows, figures = [], []
    for width, height in SIZES:
        layout = building(width, height, np.random.default_rng(0))
        made = candidates_of(layout)
        chosen = cover_of(layout, made)
        times = [
            cpu_seconds(lambda layout=layout: candidates_of(layout), REPEAT),
            cpu_seconds(lambda layout=layout, made=made: cover_of(layout, made), REPEAT),
        ]
        planes = "/".join(str(len(p)) for p in layout.planes)
        figures.append((layout.area, len(made), *times, sum(times)))
        counts = (layout.rooms, planes, made.enumerated, len(made), len(chosen))
        rows.append((f"{layout.area:.0f}", *counts, *(f"{1000 * t:.1f}" for t in times)))
    area, *curves = np.log(np.array(figures)).T
    slopes = [float(np.polyfit(area, curve, 1)[0]) for curve in curves]
    names = ("valid rectangles", "candidates", "cover", "candidates + cover")
    header = ("area m2", "rooms", "planes", "enumerated", "valid", "chosen", "candidates ms", "cover ms")
    return Outcome(
        "growth with floor area",
        header,
        rows,
        {f"exponent of {name}": slope for name, slope in zip(names, slopes, strict=True)},
        ("An exponent of 1 is linear growth; the naive enumeration grows like the column 'enumerated'.",),
    )


def office() -> Outcome:
    """From planes to labels, for the size of the paper's two buildings."""
    layout = with_planes(building(*OFFICE, np.random.default_rng(1)), OFFICE_PLANES, np.random.default_rng(2))
    planes = layout_planes(layout)
    made = candidates_of(layout)
    chosen = cover_of(layout, made)

    def regions_of() -> tuple:
        return build_regions(chosen, planes, (), (), layout.grid, CONFIG.regions)

    found = regions_of()
    seconds = {
        "candidates": cpu_seconds(lambda: candidates_of(layout)),
        "cover": cpu_seconds(lambda: cover_of(layout, made)),
        "regions": cpu_seconds(regions_of),
        "labels": cpu_seconds(lambda: label_regions(found, PaperClassifier(), CONFIG)),
    }
    seconds["total"] = sum(seconds.values())
    counts = {"valid": len(made), "chosen": len(chosen), "regions": len(found)}
    return Outcome(
        f"planes to labels, {OFFICE[0]:.0f} x {OFFICE[1]:.0f} m, {OFFICE_PLANES} planes a facing "
        f"(target {TARGET} s)",
        ("stage", "ms"),
        [(name, f"{1000 * s:.1f}") for name, s in seconds.items()],
        {**{f"{name} s": s for name, s in seconds.items()}, **counts},
    )


def layout_planes(layout: Layout) -> tuple[LayoutPlane, ...]:
    """The planes as the stage of the regions wants them, each with its blockers as wall."""
    planes = []
    for facing, offsets in zip(Facing, layout.planes, strict=True):
        axis, along = facing.axis, 1 - facing.axis
        lines = layout.blockers[layout.blockers[:, axis] == layout.blockers[:, axis + 2]]
        nearest = np.abs(lines[:, [axis]] - offsets).argmin(axis=1)
        far = np.abs(lines[:, axis] - offsets[nearest]) > 0.06  # m: on a plane of another facing
        for k, offset in enumerate(offsets):
            walls = lines[(nearest == k) & ~far][:, [along, along + 2]]
            planes.append(
                LayoutPlane(f"{facing.name}{k}", facing, float(offset), walls=walls, observed=walls)
            )
    return tuple(planes)


def optimum() -> Outcome:
    """Weight of the greedy cover over the optimum, both of the same cells."""
    ratios, counts, seconds = [], [], []
    for seed in range(BUILDINGS):
        rng = np.random.default_rng(seed)
        layout = building(rng.uniform(15, 50), rng.uniform(12, 28), rng)
        made = candidates_of(layout)
        greedy = cover_of(layout, made)
        best = exact_cover(made, layout.grid, CONFIG.cover)
        if not (best.uncovered == greedy.uncovered).all():
            raise AssertionError(f"building {seed}: the covers hold different cells")
        ratios.append(greedy.weight / best.weight)
        counts.append((len(greedy), len(best)))
        seconds.append(cpu_seconds(lambda m=made, g=layout.grid: greedy_cover(m, g, CONFIG.cover), 1))
    shares = [0, 25, 50, 75, 90, 100]
    rows = [(f"{p} %", f"{np.percentile(ratios, p):.4f}") for p in shares]
    return Outcome(
        f"greedy against optimal, {BUILDINGS} buildings",
        ("buildings", "greedy / optimal"),
        rows,
        {
            "mean ratio": float(np.mean(ratios)),
            "worst ratio": float(np.max(ratios)),
            "solved by greedy": float(np.mean(np.array(ratios) == 1.0)),
            "rectangles greedy": float(np.mean([c[0] for c in counts])),
            "rectangles optimal": float(np.mean([c[1] for c in counts])),
        },
    )
