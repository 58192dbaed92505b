"""The confidence of doors fitted again: on apertures whose probabilities are known."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from benchmarks.accuracy.fit_doors import cross_validated, fit
from floorplan_core.stages.door_evidence import SHARES, DoorMeasures

COUNT = 4000


def drawn(seed: int, count: int = COUNT) -> tuple[np.ndarray, np.ndarray]:
    """Shares of which the first speaks for a door, the second against it, and the others say nothing."""
    rng = np.random.default_rng(seed)
    shares = rng.uniform(size=(count, len(SHARES)))
    odds = -2.0 + 4.0 * shares[:, 0] - 1.5 * shares[:, 1]
    return shares, rng.uniform(size=count) < 1 / (1 + np.exp(-odds))


def test_weights_are_found_and_none_is_below_zero():
    shares, true = drawn(1)
    weights = fit(shares, true, penalty=1e-6)
    assert weights[1] == pytest.approx(4.0, abs=0.4)
    assert (weights[1:] >= 0).all()
    assert weights[2] == 0.0


def test_a_penalty_makes_the_weights_smaller():
    shares, true = drawn(2)
    assert fit(shares, true, penalty=0.1)[1] < 0.5 * fit(shares, true, penalty=1e-6)[1]


def test_a_survey_is_judged_by_the_others_and_what_leads_nowhere_is_limited():
    surveys = [(*drawn(seed, 300), [True] * 300) for seed in range(6)]
    upside_down = (surveys[0][0], ~surveys[0][1], [False] * 300)
    judged = cross_validated([upside_down, *surveys[1:]])
    assert len(judged) == 1800
    wrong = judged[:300]
    assert max(p for p, _ in wrong) == DoorMeasures.limited(1.0, leads_on=False) < 0.5
    said = np.array([p for p, _ in wrong])
    right = np.array([r for _, r in wrong])
    assert said[right].mean() < said[~right].mean()  # it had no say in its own weights
