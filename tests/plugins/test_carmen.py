"""CARMEN logs: scans of a simulated room come back; the real logs agree with what others made of them."""

from __future__ import annotations

import gzip

import numpy as np
import pytest

from tests.plugins.plugin_files import opened, refusal, shared, survives, whole
from tests.readers.reader_clouds import Remembering

SIZE = (8.0, 5.0)
POSES = [(2 + 0.1 * k, 2.5, 0.3 * k) for k in range(20)]


def cast(pose, angles):
    """Ranges from a pose to the walls of a box room."""
    x, y, theta = pose
    dx, dy = np.cos(theta + angles), np.sin(theta + angles)
    dx, dy = (np.where(np.abs(d) < 1e-12, 1e-12, d) for d in (dx, dy))
    tx = np.where(dx > 0, SIZE[0] - x, -x) / dx
    ty = np.where(dy > 0, SIZE[1] - y, -y) / dy
    return np.minimum(tx, ty)


def flaser(k, pose, beams, lost=()):
    angles = -np.pi / 2 + np.arange(beams) * np.pi / (beams - beams % 2)
    r = cast(pose, angles)
    r[list(lost)] = 81.83
    x, y, theta = pose
    words = " ".join(f"{v:.6f}" for v in r)
    return f"FLASER {beams} {words} {x} {y} {theta} 0 0 0 {10 + k}.5 robot {k}\n"


def robotlaser(k, pose, beams=100, lost=()):
    angles = -1.2 + np.arange(beams) * 0.02
    r = cast(pose, angles)
    r[list(lost)] = 30.0
    x, y, theta = pose
    words = " ".join(f"{v:.6f}" for v in r)
    tail = f"{x} {y} {theta} 9 9 9 0 0 0.1 0.1 0 {10 + k}.5 robot {k}"
    return f"ROBOTLASER1 0 -1.2 2.0 0.02 30.0 0.01 0 {beams} {words} 2 7 7 {tail}\n"


def write_log(path, line=flaser, **how):
    text = "# message formats defined: PARAM SYNC ODOM FLASER RLASER TRUEPOS\nPARAM a_name 0.0 nohost 0\n"
    for k, pose in enumerate(POSES):
        text += f"ODOM 0 0 {k} 0 0 0 {k} robot {k}\n" + line(k, pose, **how)
    data = text.encode()
    path.write_bytes(gzip.compress(data) if path.suffix == ".gz" else data)
    return path


def wall_distance(points):
    x, y = points[:, 0], points[:, 1]
    return np.abs(np.min([x, SIZE[0] - x, y, SIZE[1] - y], axis=0)).max()


@pytest.mark.parametrize("name", ["a.log", "a.log.gz", "misnamed.txt"])
@pytest.mark.parametrize(
    ("line", "how"),
    [(flaser, {"beams": 180}), (flaser, {"beams": 181}), (flaser, {"beams": 361}), (robotlaser, {})],
)
def test_what_is_simulated_comes_back(tmp_path, name, line, how):
    survey = opened(write_log(tmp_path / name, line, **how))
    points, ids = whole(survey)
    beams = how.get("beams", 100)
    assert survey.format == "CARMEN"
    assert wall_distance(points) < 1e-5
    assert (points[:, 2] == 0).all()
    assert len(points) >= len(POSES) * beams - 2  # the longest reading of all may stand for none
    np.testing.assert_allclose(survey.trajectory.origins[:, :2], [p[:2] for p in POSES])
    np.testing.assert_allclose(survey.trajectory.stamps, 10.5 + np.arange(len(POSES)))
    assert survey.scans_ordered
    assert ids.max() == len(POSES) - 1


@pytest.mark.parametrize(("line", "how"), [(flaser, {"beams": 180}), (robotlaser, {})])
def test_readings_without_a_return(tmp_path, line, how):
    points, _ = whole(opened(write_log(tmp_path / "a.log", line, lost=range(3, 13), **how)))
    assert wall_distance(points) < 1e-5
    assert len(points) == len(POSES) * (how.get("beams", 100) - 10)


def test_readings_that_are_no_numbers(tmp_path):
    path = write_log(tmp_path / "a.log", robotlaser, lost=[4])
    path.write_text(path.read_text().replace(" 30.000000 ", " inf "))
    points, _ = whole(opened(path))
    assert wall_distance(points) < 1e-5
    assert len(points) >= len(POSES) * 99 - 1


@pytest.mark.parametrize("name", ["intel", "seattle", "aces"])
def test_the_real_logs_agree_with_their_clouds(name):
    from scipy.spatial import cKDTree

    survey = opened(shared(f"carmen_{name}/{name}-corrected.log.gz"))
    points, ids = whole(survey)
    reference, reference_ids = whole(opened(shared(f"carmen_{name}/points2d.ply")))
    assert survey.trajectory is not None
    assert len(survey.trajectory) == reference_ids.max() + 1
    first = cKDTree(points[ids < 50]).query(reference[reference_ids < 50])[0]
    assert np.quantile(first, 0.9) < 0.15  # the reference spreads 180 readings over a degree more


def test_chunks_are_bounded(tmp_path, monkeypatch):
    import floorcast_plugins.carmen as module

    monkeypatch.setattr(module, "CHUNK_SCANS", 3)
    sizes = [len(c.points) for c in opened(write_log(tmp_path / "a.log", beams=180)).chunks()]
    assert max(sizes) <= 3 * 180
    assert len(sizes) == 7


def test_damaged_scans_are_counted(tmp_path):
    path = write_log(tmp_path / "a.log", beams=180)
    lines = path.read_text().splitlines(keepends=True)
    lines[3] = lines[3].replace("FLASER 180", "FLASER 18000")
    lines[5] = lines[5].replace("FLASER 180 ", "FLASER 180 x")
    path.write_text("".join(lines))
    observer = Remembering()
    survey = opened(path, observer)
    assert len(survey.trajectory) == len(POSES) - 2
    assert any(text.startswith("2 lines") for text in observer.warnings)


def test_no_scans(tmp_path):
    path = tmp_path / "a.log"
    path.write_text("PARAM a 1 host 0\nODOM 0 0 0 0 0 0 1 host 1\n" * 5)
    assert "without scans" in refusal(path)


def test_scans_of_which_nothing_returned(tmp_path):
    path = tmp_path / "a.log"
    path.write_text("PARAM a 1\n" + f"FLASER 180 {'1.0 ' * 180}0 0 0 0 0 0 1.5 robot 1\n" * 9)
    assert "no point with finite coordinates" in refusal(path)


def test_a_bomb_ends(tmp_path, monkeypatch):
    import floorcast_plugins.carmen as module

    monkeypatch.setattr(module, "MAX_BYTES", 1 << 20)
    path = tmp_path / "a.log.gz"
    path.write_bytes(gzip.compress(b"ODOM 0 0 0 0 0 0 1 host 1\n" * 100_000))
    assert "unpacks to more than" in refusal(path)


@pytest.mark.parametrize("name", ["a.log", "a.log.gz"])
def test_damage(tmp_path, name):
    assert survives(write_log(tmp_path / name, beams=91), tmp_path) >= 2
