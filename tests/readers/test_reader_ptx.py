"""PTX: scans with poses, in the frame of the file; directions without an echo; headers that lie."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.plugins.plugin_files import opened, refusal, whole
from tests.readers.reader_clouds import room

STATIONS = ((2.0, 1.5, 1.4), (6.0, 3.5, 1.5))


def numbers(values) -> str:
    return " ".join(f"{v:.6f}" for v in values)


def scan_text(points, T, position=None, lost=3, columns=4) -> str:
    """One scan: ``points`` (N, 3) of the common frame, seen by a scanner whose pose is ``T``."""
    local = (points - T[:3, 3]) @ T[:3, :3]
    rows = np.zeros((len(local) + lost, columns))
    rows[: len(local), :3] = local
    rows[:, 3:] = 0.5
    position = T[:3, 3] if position is None else position
    head = [str(1), str(len(rows)), numbers(position), *(numbers(axis) for axis in T[:3, :3].T)]
    head += [numbers(row) for row in T.T]  # of a matrix that moves row vectors
    return "\n".join([*head, *(numbers(row) for row in rows)]) + "\n"


def station(k):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("z", 40.0 * k + 10, degrees=True).as_matrix()
    T[:3, 3] = STATIONS[k]
    return T


@pytest.fixture
def parts():
    return np.array_split(room(np.random.default_rng(1), density=20), 2)


def write(path, *texts):
    path.write_text("".join(texts))
    return path


def test_scans_come_back_from_where_their_scanners_stood(tmp_path, parts):
    path = write(tmp_path / "a.ptx", *(scan_text(p, station(k)) for k, p in enumerate(parts)))
    survey = opened(path)
    points, ids = whole(survey)
    assert survey.format == "PTX" and survey.scans == 2 and survey.scans_ordered
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-5)
    np.testing.assert_array_equal(ids, np.repeat([0, 1], [len(p) for p in parts]))
    np.testing.assert_allclose(survey.trajectory.origins, STATIONS, atol=1e-6)


@pytest.mark.parametrize("columns", [3, 4, 7])
def test_content_counts_and_colours_are_left(tmp_path, parts, columns):
    path = write(tmp_path / "misnamed.txt", scan_text(parts[0], station(0), columns=columns))
    points, _ = whole(opened(path))
    np.testing.assert_allclose(points, parts[0], atol=1e-5)


def test_a_matrix_alone_places_the_scanner(tmp_path, parts):
    path = write(tmp_path / "a.ptx", scan_text(parts[1], station(1), position=(0, 0, 0)))
    np.testing.assert_allclose(opened(path).trajectory.origins, STATIONS[1:], atol=1e-6)


def test_points_that_were_moved_already_keep_their_scanner(tmp_path, parts):
    text = scan_text(parts[0], np.eye(4), position=STATIONS[0])
    survey = opened(write(tmp_path / "a.ptx", text))
    np.testing.assert_allclose(survey.trajectory.origins, STATIONS[:1], atol=1e-6)
    np.testing.assert_allclose(whole(survey)[0], parts[0], atol=1e-5)


def test_a_merged_cloud_has_no_viewpoint(tmp_path, parts):
    survey = opened(write(tmp_path / "a.ptx", *(scan_text(p, np.eye(4)) for p in parts)))
    points, ids = whole(survey)
    assert survey.trajectory is None and ids is None
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-5)


def test_scanners_far_from_what_they_saw_are_none(tmp_path, parts):
    texts = [scan_text(p, np.eye(4), position=(500.0 + k, 0, 0)) for k, p in enumerate(parts)]
    survey = opened(write(tmp_path / "a.ptx", *texts))
    points, ids = whole(survey)
    assert survey.trajectory is None and ids is None
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-5)


def test_a_cut_file_gives_what_it_holds(tmp_path, parts):
    text = scan_text(parts[0], station(0)) + scan_text(parts[1], station(1))
    path = write(tmp_path / "a.ptx", text[: -len(text) // 4])
    survey = opened(path)
    assert any("announces" in sentence for sentence in survey.assumptions)
    assert len(parts[0]) < len(whole(survey)[0]) < len(parts[0]) + len(parts[1])


def test_a_header_that_lies_is_named(tmp_path, parts):
    text = scan_text(parts[0], station(0)).replace("1\n", "2\n", 1)  # twice as many: into the next header
    path = write(tmp_path / "a.ptx", text, scan_text(parts[1], station(1)))
    assert "no header of scan 2" in refusal(path)


def test_no_point_at_all(tmp_path):
    path = write(tmp_path / "a.ptx", scan_text(np.zeros((0, 3)), np.eye(4), lost=0))
    assert "without points" in refusal(path)
