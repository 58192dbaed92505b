"""``python -m benchmarks.accuracy.fit_doors``: the weights of the confidence of doors, fitted again.

In: every aperture of the surveys of the tuning half and of ``--fresh`` seeds that nobody reports on, with its
measures and whether truth has a door or opening there (shut ones too). Out, on the terminal: the bias and the
weights for ``floorplan_core/stages/door_evidence.py``, and how reliable they are on the same surveys, each
judged by weights that were fitted without it. Nothing is changed.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.accuracy.cases import Case, fresh_cases, simulated_cases
from benchmarks.accuracy.reliability import Judged, Keeper, brier, is_door, table
from benchmarks.accuracy.runner import make_plan, plan_folder
from benchmarks.accuracy.surveys import cloud, survey_folder
from floorplan_core.config import Config
from floorplan_core.evaluation import load_truth
from floorplan_core.stages.door_apertures import shows_lintels
from floorplan_core.stages.door_evidence import SHARES, DoorMeasures
from floorplan_core.stages.doors import find_candidates, merge_faces

Float = NDArray[np.float64]
FRESH = (4000, 5000)
PENALTY = 0.0005  # on the squared weights: the best of cross-validation within a factor of two
FOLDS = 6


def main(arguments: list[str] | None = None) -> int:
    """Exit status 0."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.accuracy.fit_doors", description=__doc__)
    parser.add_argument(
        "--fresh", type=int, action="append", metavar="SEED", help="4000 and 5000 if not given"
    )
    cases = [c for c in simulated_cases() if c.half == "tuning"]
    cases += fresh_cases(parser.parse_args(arguments).fresh or FRESH)
    found = [measured(case) for case in cases]
    shares = np.vstack([s for s, _, _ in found])
    true = np.concatenate([t for _, t, _ in found])
    weights = fit(shares, true)
    print(f"{len(true)} apertures of {len(cases)} surveys")
    for name, weight in zip(("bias", *SHARES), weights, strict=True):
        print(f"{name:>9} {weight:6.2f}")
    judged = cross_validated(found)
    for row in table(judged):
        print(*("–" if v is None else f"{v:.2f}" if isinstance(v, float) else v for v in row), sep="\t")
    print(f"Brier score {brier(judged):.4f}")
    return 0


Measured = tuple[Float, NDArray[np.bool_], list[bool]]


def measured(case: Case) -> Measured:
    """(N, F) shares of the apertures of one survey, which are doors, and which lead on."""
    keeper = Keeper()
    folder = survey_folder(case, keeper)
    plan, _ = make_plan(cloud(folder), plan_folder(case), Config(), keeper)
    planes, evidence = keeper.planes, keeper.evidence
    assert evidence is not None
    lintels = shows_lintels([p.profile for p in planes if p.profile])
    config = Config().doors
    candidates = merge_faces(find_candidates(planes, evidence, config, lintels), planes, config)
    truth = is_door([c.door for c in candidates], plan, load_truth(Path(folder)))
    kept = [(c.measures, right) for c, right in zip(candidates, truth, strict=True) if right is not None]
    shares = np.array([list(m.shares(lintels).values()) for m, _ in kept]).reshape(-1, len(SHARES))
    return shares, np.array([right for _, right in kept], dtype=bool), [m.leads_on() for m, _ in kept]


def fit(shares: Float, true: NDArray[np.bool_], penalty: float = PENALTY) -> Float:
    """(1 + F,) bias and weights of a logistic regression; no weight below zero."""
    from scipy.optimize import minimize

    def loss(w: Float) -> tuple[float, Float]:
        odds = w[0] + shares @ w[1:]
        off = (1 / (1 + np.exp(-odds)) - true) / len(true)
        value = float(np.mean(np.logaddexp(0, odds) - true * odds) + penalty * (w[1:] ** 2).sum())
        return value, np.concatenate([[off.sum()], shares.T @ off + 2 * penalty * w[1:]])

    bounds = [(None, None)] + [(0.0, None)] * shares.shape[1]
    found = minimize(loss, np.zeros(1 + shares.shape[1]), jac=True, method="L-BFGS-B", bounds=bounds)
    return np.asarray(found.x)


def cross_validated(found: list[Measured], folds: int = FOLDS) -> Judged:
    """Every aperture by weights that were fitted without its survey."""
    judged: Judged = []
    for k in range(folds):
        others = [f for i, f in enumerate(found) if i % folds != k]
        weights = fit(np.vstack([s for s, _, _ in others]), np.concatenate([t for _, t, _ in others]))
        for shares, true, leads in found[k::folds]:
            odds = weights[0] + shares @ weights[1:]
            judged += [
                (DoorMeasures.limited(float(p), on), bool(right))
                for p, right, on in zip(1 / (1 + np.exp(-odds)), true, leads, strict=True)
            ]
    return judged


if __name__ == "__main__":
    sys.exit(main())
