"""A survey whose path is bent on purpose comes back; one that is right stays as it is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.cli import main
from floorplan_core.config import Config
from floorplan_core.drift import as_configured, corrected
from floorplan_core.drift.keyframes import MOST_POINTS, cut_path, gather
from floorplan_core.errors import Cancelled, NoPlanError
from floorplan_core.model import PointChunk, Reconstruction, Trajectory
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.readers import open_survey

SAMPLE = Path(__file__).resolve().parents[2] / "resources" / "sample_survey"
CONFIG = Config().with_values({"drift.correct": "true"})


def bent(survey: Reconstruction, largest: float) -> Reconstruction:
    """The survey with a path that wanders off by up to ``largest`` metres, and its points with it."""
    share = np.linspace(0, 1, len(survey.trajectory))
    shift = largest * np.column_stack([np.sin(2.2 * share), share**2 * 0.7, 0.3 * share]) / np.hypot(1, 0.7)

    def chunks():
        for chunk in survey.chunks():
            yield replace(chunk, points=chunk.points + shift[chunk.scan_id])

    poses = survey.trajectory.T_world_sensor.copy()
    poses[:, :3, 3] += shift
    return replace(survey, chunks=chunks, trajectory=Trajectory(survey.trajectory.stamps, poses))


def error(path: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """(M,) metres between two paths, but for where the whole lies."""
    off = path - truth
    return np.linalg.norm(off - off.mean(axis=0), axis=1)


@pytest.fixture(scope="module")
def survey() -> Reconstruction:
    return open_survey(SAMPLE)


@pytest.mark.parametrize("largest", [0.0, 0.5])
def test_a_bent_path_comes_back(survey: Reconstruction, largest: float) -> None:
    run = bent(survey, largest)
    done = corrected(run, CONFIG, Observer())
    truth = survey.trajectory.origins
    assert error(run.trajectory.origins, truth).max() == pytest.approx(0.5 * largest, abs=0.2 * largest)
    assert error(done.trajectory.origins, truth).mean() < 0.04
    assert "The trajectory was corrected by up to" in done.assumptions[-1]


def test_points_move_with_the_scan_that_saw_them(survey: Reconstruction) -> None:
    done = corrected(bent(survey, 0.5), CONFIG, Observer())
    before, after = (next(iter(s.chunks())) for s in (survey, done))
    for row in np.unique(before.scan_id)[::7]:
        mine = before.scan_id == row
        poses = [s.trajectory.T_world_sensor[row] for s in (survey, done)]
        seen = [(c.points[mine] - T[:3, 3]) @ T[:3, :3] for c, T in zip((before, after), poses, strict=True)]
        np.testing.assert_allclose(*seen, atol=2e-3)


def test_it_is_off_unless_asked_for(survey: Reconstruction) -> None:
    assert as_configured(survey, Config(), Observer()) is survey


def test_what_has_no_path_is_one_sentence(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    points = np.random.default_rng(0).uniform(0, 3, (1000, 3))
    cloud = Reconstruction("cloud.ply", lambda: iter([PointChunk(points)]))
    with pytest.raises(NoPlanError, match=r"cloud\.ply has no trajectory"):
        corrected(cloud, CONFIG, Observer())
    np.savetxt(tmp_path / "cloud.xyz", points)
    arguments = [
        "plan",
        str(tmp_path / "cloud.xyz"),
        "--out",
        str(tmp_path / "out"),
        "--set",
        "drift.correct=true",
    ]
    assert main.run(arguments) == 4
    assert "has no trajectory" in capfd.readouterr().err


class _Patience(CancelToken):
    """Says that it was cancelled when it is asked for the ``most``-th time."""

    def __init__(self, most: float) -> None:
        super().__init__()
        self.asked, self.most = 0, most

    @property
    def cancelled(self) -> bool:
        self.asked += 1
        return self.asked >= self.most


def test_it_can_be_cancelled_all_the_way(survey: Reconstruction) -> None:
    config = Config.model_validate({"drift": {"correct": True}})
    patient = _Patience(np.inf)
    corrected(survey, config, Observer(patient))
    reading = sum(1 for _ in survey.chunks())
    assert patient.asked > 4 * reading, "it is asked while the points are read only"
    for most in np.linspace(1, patient.asked, 4).astype(int).tolist():
        token = _Patience(most)
        with pytest.raises(Cancelled):
            corrected(survey, config, Observer(token))
        assert token.asked == most


def test_keyframes_hold_a_bounded_number_of_points() -> None:
    poses = np.tile(np.eye(4), (5, 1, 1))
    poses[:, 0, 3] = [0, 0.4, 0.9, 1.2, 3.5]
    trajectory = Trajectory(np.arange(5.0), poses)
    keyframes = cut_path(trajectory, 1.0)
    assert keyframes.of_scan.tolist() == [0, 0, 0, 1, 2]
    ids = np.repeat(np.arange(5, dtype=np.int32), MOST_POINTS)
    chunk = PointChunk(np.column_stack([ids, ids, ids]).astype(np.float32), ids)
    run = Reconstruction("run", lambda: iter([chunk, chunk]), trajectory=trajectory)
    parts = gather(run, keyframes, Observer())
    assert [sorted(set(p[:, 0].astype(int).tolist())) for p in parts] == [[0, 1, 2], [3], [4]]
    assert all(MOST_POINTS <= len(p) <= 3 * MOST_POINTS for p in parts)
