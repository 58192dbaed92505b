"""E57: what libE57 writes comes back, in the frame of the file, seen from where the scanner stood."""

from __future__ import annotations

import struct

import numpy as np
import pye57
import pytest
from pye57 import libe57
from scipy.spatial.transform import Rotation

from tests.plugins.e57_files import write_fields
from tests.plugins.plugin_files import opened, refusal, survives, whole
from tests.readers.reader_clouds import room

STATIONS = ((2.0, 1.5, 1.4), (6.0, 3.5, 1.5), (4.0, 2.5, 1.3))


def pose_of(k, shift=(0.0, 0.0, 0.0)):
    """w x y z and translation of a station."""
    x, y, z, w = Rotation.from_euler("z", 40.0 * k, degrees=True).as_quat()
    return np.array([w, x, y, z]), np.array(STATIONS[k]) + shift


def to_scan(points, rotation, translation):
    R = Rotation.from_quat(np.roll(rotation, -1)).as_matrix()
    return (points - translation) @ R


def write_e57(path, parts, shift=(0.0, 0.0, 0.0), posed=True):
    """One scan for each part, in the frame of its station."""
    with pye57.E57(str(path), "w") as file:
        for k, part in enumerate(parts):
            rotation, translation = pose_of(k, shift)
            local = to_scan(part, rotation, translation) if posed else part
            columns = {f"cartesian{a}": local[:, i] for i, a in enumerate("XYZ")}
            columns["intensity"] = np.linspace(0, 1, len(part)).astype("f4")
            how = {"rotation": rotation, "translation": translation} if posed else {}
            file.write_scan_raw(columns, **how)
    return path


def spherical(points, invalid=None):
    """The fields of a scan of ranges and angles as scaled integers and doubles."""
    r = np.linalg.norm(points, axis=1)
    good = (np.zeros(len(points)) if invalid is None else invalid).astype("i1")
    x, y, z = points.T
    return {
        "sphericalRange": (
            lambda f: libe57.ScaledIntegerNode(f, 0, 0, 10**6, 1e-4, 0.0),
            np.round(r / 1e-4) * 1e-4,
        ),
        "sphericalAzimuth": (lambda f: libe57.FloatNode(f, 0.0), np.arctan2(y, x)),
        "sphericalElevation": (lambda f: libe57.FloatNode(f, 0.0), np.arcsin(z / r)),
        "sphericalInvalidState": (lambda f: libe57.IntegerNode(f, 0, 0, 2), good),
    }


def write_spherical(path, points, invalid=None):
    return write_fields(path, spherical(points, invalid))


@pytest.fixture
def parts():
    cloud = room(np.random.default_rng(1), density=40)
    return np.array_split(cloud, 3)


def test_scans_with_poses(tmp_path, parts):
    survey = opened(write_e57(tmp_path / "a.e57", parts))
    points, ids = whole(survey)
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-5)
    np.testing.assert_array_equal(ids, np.repeat([0, 1, 2], [len(p) for p in parts]))
    np.testing.assert_allclose(survey.trajectory.origins, STATIONS, atol=1e-9)
    assert survey.scans_ordered
    assert survey.point_count == sum(map(len, parts))


def test_large_coordinates(tmp_path, parts):
    shift = (448_000.0, 5_412_000.0, 0.0)
    survey = opened(write_e57(tmp_path / "a.e57", [p + shift for p in parts], shift))
    points, _ = whole(survey)
    np.testing.assert_allclose(points + survey.local_frame.shift, np.concatenate(parts) + shift, atol=1e-3)
    np.testing.assert_allclose(survey.trajectory.origins + survey.local_frame.shift - shift, STATIONS)


def test_millimetres_that_should_be_metres(tmp_path, parts):
    """The standard has metres; a building 2.6 km high is one of millimetres all the same, scanners too."""
    with pye57.E57(str(tmp_path / "mm.e57"), "w") as file:
        for k, part in enumerate(parts):
            rotation, translation = pose_of(k)
            local = to_scan(part, rotation, translation) * 1000
            columns = {f"cartesian{a}": local[:, i] for i, a in enumerate("XYZ")}
            file.write_scan_raw(columns, rotation=rotation, translation=translation * 1000)
    survey = opened(tmp_path / "mm.e57", unit="auto")
    np.testing.assert_allclose(whole(survey)[0], np.concatenate(parts), atol=1e-5)
    assert survey.local_frame.unit == "mm"
    assert "E57 files are in metres, but then no building is of this size." in survey.assumptions
    np.testing.assert_allclose(survey.trajectory.origins, STATIONS, atol=1e-6)


def test_a_merged_cloud_has_no_viewpoint(tmp_path, parts):
    survey = opened(write_e57(tmp_path / "a.e57", [np.concatenate(parts)], posed=False))
    points, ids = whole(survey)
    assert ids is None
    assert survey.trajectory is None
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-5)


def test_poses_that_are_no_sensors(tmp_path, parts):
    """Offsets far from the points are a mere change of frame."""
    shift = np.array([300.0, 0.0, 0.0])
    path = tmp_path / "a.e57"
    with pye57.E57(str(path), "w") as file:
        local = np.concatenate(parts) - shift
        file.write_scan_raw(
            {f"cartesian{a}": local[:, i] for i, a in enumerate("XYZ")},
            translation=shift,
            rotation=np.array([1, 0, 0, 0]),
        )
    survey = opened(path)
    points, ids = whole(survey)
    assert ids is None
    assert survey.trajectory is None
    np.testing.assert_allclose(points, np.concatenate(parts), atol=1e-4)


def test_spherical_and_invalid(tmp_path):
    cloud = room(np.random.default_rng(2), density=20) - STATIONS[0]
    invalid = np.zeros(len(cloud))
    invalid[5:25] = 1
    invalid[40:50] = 2
    survey = opened(write_spherical(tmp_path / "a.e57", cloud, invalid))
    points, ids = whole(survey)
    np.testing.assert_allclose(points, cloud[invalid == 0], atol=1e-4)
    assert (ids == 0).all()
    np.testing.assert_allclose(survey.trajectory.origins, [[0, 0, 0]])


def test_chunks_are_bounded(tmp_path, parts, monkeypatch):
    import floorcast_plugins._e57_scans as module

    read_scan = module.read_scan

    def small(path, scan, size=500):
        return read_scan(path, scan, min(size, 500))

    monkeypatch.setattr(module, "read_scan", small)
    survey = opened(write_e57(tmp_path / "a.e57", parts))
    sizes = [len(c.points) for c in survey.chunks()]
    assert max(sizes) <= 500
    assert sum(sizes) == sum(map(len, parts))


def test_truncated(tmp_path, parts):
    path = write_e57(tmp_path / "a.e57", parts)
    path.write_bytes(path.read_bytes()[:20_000])
    assert "truncated or damaged: its header says" in refusal(path)
    assert path.exists()


def test_headers_that_lie(tmp_path, parts):
    path = write_e57(tmp_path / "a.e57", parts)
    data = bytearray(path.read_bytes())
    struct.pack_into("<Q", data, 32, 1 << 60)
    path.write_bytes(bytes(data))
    assert "points outside the file" in refusal(path)


def test_without_points(tmp_path):
    path = tmp_path / "a.e57"
    with pye57.E57(str(path), "w"):
        pass
    assert "without points" in refusal(path)


def test_damage(tmp_path):
    parts = np.array_split(room(np.random.default_rng(3), density=10), 2)
    path = write_e57(tmp_path / "a.e57", parts)
    assert survives(path, tmp_path) > 60


def test_entities_are_refused(tmp_path, parts):
    """A document type of one's own is the way to a billion laughs."""
    path = write_e57(tmp_path / "a.e57", parts)
    data = bytearray(path.read_bytes())
    at = data.index(b"<guid")
    data[at : at + 9] = b"<!DOCTYPE"
    path.write_bytes(bytes(data))
    assert "entities" in refusal(path)
