"""``python -m benchmarks.accuracy.fit_regions``: the weights of the confidence of regions, fitted again.

In: every region of the surveys of the tuning half and of ``--fresh`` seeds, with its measures and whether one
true room and it have an intersection over union of 0.5. Out, on the terminal: the bias and the weights for
``floorplan_core/stages/region_confidence.py``, and how reliable they and those in use are on ``--check``
seeds that took no part. Also, how much of what is predicted is floor in truth, by the way to what was seen.
Nothing is changed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from benchmarks.accuracy.cases import Case, fresh_cases, simulated_cases
from benchmarks.accuracy.fit_doors import fit
from benchmarks.accuracy.reliability import Judged, brier, table
from benchmarks.accuracy.runner import make_plan, plan_folder
from benchmarks.accuracy.surveys import cloud, survey_folder
from floorplan_core.config import Config
from floorplan_core.evaluation import load_truth
from floorplan_core.evaluation.compare import inverse
from floorplan_core.geometry.raster import polygon_mask
from floorplan_core.observer import Observer
from floorplan_core.stages.region_confidence import MEASURES, measures_of, probability

Float = NDArray[np.float64]
FRESH, CHECK = (4000, 5000, 7000), (2000, 3000, 9000)
FOUND = 0.5  # intersection over union from which a region is a true room
CELL = 0.1  # m
AWAY = (0.0, 0.5, 1.0, 2.0, 3.0, np.inf)  # m from what was seen, edges of the table


def main(arguments: list[str] | None = None) -> int:
    """Exit status 0."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.accuracy.fit_regions", description=__doc__)
    for name, default in (("--fresh", FRESH), ("--check", CHECK)):
        parser.add_argument(name, type=int, action="append", metavar="SEED", help=f"{default} if not given")
    options = parser.parse_args(arguments)
    tuning = [c for c in simulated_cases() if c.half == "tuning"]
    shares, true, _ = measured([*tuning, *fresh_cases(options.fresh or FRESH)])
    weights = fit(shares, true)
    print(f"{len(true)} regions")
    for name, weight in zip(("bias", *MEASURES), weights, strict=True):
        print(f"{name:>9} {weight:6.2f}")
    shares, true, away = measured(fresh_cases(options.check or CHECK))
    fitted = 1 / (1 + np.exp(-(weights[0] + shares @ weights[1:])))
    for title, said in (("fitted", fitted.tolist()), ("in use", [probability(s) for s in shares])):
        show(title, list(zip(said, true.tolist(), strict=True)))
    for low, high in pairwise(AWAY):
        right = away[(away[:, 0] >= low) & (away[:, 0] < high), 1]
        print(
            f"predicted {low:g} to {high:g} m away: {len(right) * CELL**2:.0f} m2, floor {right.mean():.3f}"
        )
    return 0


def show(title: str, judged: Judged) -> None:
    """The reliability of one set of weights."""
    print(f"{title}, {len(judged)} regions: Brier score {brier(judged):.4f}")
    for row in table(judged):
        print(*("–" if v is None else f"{v:.2f}" if isinstance(v, float) else v for v in row), sep="\t")


def measured(cases: Sequence[Case]) -> tuple[Float, NDArray[np.bool_], Float]:
    """(N, 3) measures of all regions, which are true rooms, and (K, 2) of the predicted cells: metres to what
    was seen, and 1 where floor is in truth.
    """
    shares, true, away = [], [], []
    for case in cases:
        folder = survey_folder(case, Observer())
        plan, file = make_plan(cloud(folder), plan_folder(case), Config(), Observer())
        truth = load_truth(folder)
        local = file.moved(inverse(truth.world_from_building))
        rooms = np.array([r.polygon for r in truth.rooms], dtype=object)
        floor = shapely.union_all([*rooms, *(shapely.box(*d.bounds) for d in truth.doors)])
        for region, placed in zip(plan.regions, local.regions, strict=True):
            shares.append(measures_of(region.sides, region.free_cells, region.total_cells, region.area))
            common = shapely.area(shapely.intersection(rooms, placed.polygon))
            either = shapely.area(shapely.union(rooms, placed.polygon))
            true.append(bool((common >= FOUND * either).any()))
            away.append(_predicted(placed.polygon, local.speculated, floor))
    return np.array(shares), np.array(true, dtype=bool), np.concatenate(away)


def _predicted(region: shapely.Polygon, speculated: shapely.Geometry, floor: shapely.Geometry) -> Float:
    """(K, 2) of the predicted cells of one region: metres to its nearest seen one, and 1 where floor is."""
    x0, y0, x1, y1 = region.bounds
    guess = region.intersection(speculated)
    if guess.is_empty:
        return np.zeros((0, 2))
    origin, shape = np.array([x0, y0]) - CELL, (int((y1 - y0) / CELL) + 3, int((x1 - x0) / CELL) + 3)
    inside, guessed, right = (polygon_mask(s, origin, CELL, shape) for s in (region, guess, floor))
    seen = inside & ~guessed
    if not seen.any():
        return np.zeros((0, 2))
    rows = inside & guessed
    return np.column_stack([CELL * distance_transform_edt(~seen)[rows], right[rows]])


if __name__ == "__main__":
    sys.exit(main())
