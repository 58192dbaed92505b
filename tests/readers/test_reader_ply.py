"""PLY: what is written comes back, whatever the order, type and neighbours of the coordinates."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from tests.readers.reader_clouds import all_points, ply_header, room, write_ply, xyz_columns

AS_IT_IS = InputConfig(unit="m", up="z")
FORMS = ("ascii", "binary_little_endian", "binary_big_endian")


@pytest.fixture
def cloud():
    return room(np.random.default_rng(1), density=15)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_round_trip(tmp_path, cloud, form, dtype):
    path = write_ply(tmp_path / "a.ply", form, xyz_columns(cloud, dtype))
    survey = open_survey(path, config=AS_IT_IS)
    points, ids = all_points(survey)
    assert ids is None
    assert survey.point_count == len(cloud)
    np.testing.assert_allclose(points, cloud, atol=1e-5)


@pytest.mark.parametrize("form", FORMS)
def test_any_order_and_more_properties(tmp_path, cloud, form):
    n = len(cloud)
    columns = {
        "red": np.arange(n, dtype="u1"),
        "z": cloud[:, 2].astype("f4"),
        "Scan_ID": (np.arange(n) // 10).astype("u2"),
        "x": cloud[:, 0].astype("f8"),
        "nx": np.zeros(n, "f4"),
        "y": cloud[:, 1].astype("f4"),
    }
    points, ids = all_points(open_survey(write_ply(tmp_path / "a.ply", form, columns), config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    np.testing.assert_array_equal(ids, np.arange(n) // 10)


@pytest.mark.parametrize("sides", [(3, 3, 3), (3, 4, 3)])
@pytest.mark.parametrize("form", FORMS)
def test_faces_before_and_after_the_points(tmp_path, cloud, form, sides):
    order = ">" if form == "binary_big_endian" else "<"
    if form == "ascii":
        faces = "".join(f"{n} {' '.join(['0'] * n)} 7\n" for n in sides).encode()
    else:
        faces = b"".join(
            np.array([n], "u1").tobytes() + np.zeros(n, order + "i4").tobytes() + b"\x07" for n in sides
        )
    properties = ["list uchar int vertex_indices", "uchar flag"]
    path = write_ply(
        tmp_path / "mesh.ply",
        form,
        xyz_columns(cloud),
        before=faces,
        before_elements=[("face", len(sides), properties)],
        after=b"junk that is none of our business",
    )
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-5)


def test_lists_of_one_length_inside_the_points(tmp_path, cloud):
    n = len(cloud)
    head = ply_header(
        "binary_little_endian",
        [("vertex", n, ["list uchar float normal", "float x", "float y", "float z"])],
    )
    rows = np.empty(n, dtype=[("n", "u1"), ("normal", "<f4", 3), ("p", "<f4", 3)])
    rows["n"], rows["normal"], rows["p"] = 3, 0, cloud
    path = tmp_path / "lists.ply"
    path.write_bytes(head + rows.tobytes())
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-5)


@pytest.mark.parametrize("form", FORMS)
def test_truncated_says_how_many_are_there(tmp_path, cloud, form):
    path = write_ply(tmp_path / "cut.ply", form, xyz_columns(cloud))
    data = path.read_bytes()
    path.write_bytes(data[: len(data) * 2 // 3])
    with pytest.raises(InputError, match=rf"truncated.*promises {len(cloud):,} points.*[1-9][\d,]* of them"):
        open_survey(path)


@pytest.mark.parametrize("form", FORMS)
def test_absurd_count(tmp_path, form):
    path = tmp_path / "huge.ply"
    properties = ["float x", "float y", "float z"]
    path.write_bytes(ply_header(form, [("vertex", 10**12, properties)]) + b"\n1 2 3\n" * 100)
    with pytest.raises(InputError, match="truncated: its header promises 1,000,000,000,000 points"):
        open_survey(path)


@pytest.mark.parametrize(
    ("head", "says"),
    [
        (b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n", "does not end"),
        (b"ply\nformat binary_middle_endian 1.0\nend_header\n", "line 2"),
        (b"ply\nelement vertex 0\nend_header\n", "no 'format' line"),
        (b"ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "line 3"),
        (b"ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3"),
        (b"ply\nformat ascii 1.0\nelement vertex -5\nend_header\n", "line 3"),
        (b"ply\nformat ascii 1.0\nelement face 1\nproperty int x\nend_header\n1\n", "without vertices"),
        (b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "0 points"),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float u\nend_header\n1\n", "no coordinates"),
        (b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nend_header\n1\n", "no properties"),
    ],
)
def test_headers_that_lie(tmp_path, head, says):
    path = tmp_path / "bad.ply"
    path.write_bytes(head)
    with pytest.raises(InputError, match=says):
        open_survey(path)


def test_chunks_are_bounded_and_repeatable(tmp_path, monkeypatch):
    from floorplan_core.readers import records

    monkeypatch.setattr(records, "CHUNK_POINTS", 1000)
    cloud = room(np.random.default_rng(2), density=30)
    ids = np.sort(np.arange(len(cloud)) % 7).astype("i4")
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud, scan_id=ids))
    survey = open_survey(path, config=AS_IT_IS)
    sizes = [len(c.points) for c in survey.chunks()]
    assert max(sizes) <= 1000
    assert sum(sizes) == len(cloud)
    first, second = all_points(survey), all_points(survey)
    np.testing.assert_array_equal(first[0], second[0])
    np.testing.assert_array_equal(first[1], ids)


def test_a_header_longer_than_one_read(tmp_path, cloud):
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud))
    comment = b"comment " + b"x" * 200 + b"\n"
    path.write_bytes(path.read_bytes().replace(b"element vertex", comment * 100 + b"element vertex"))
    assert len(all_points(open_survey(path, config=AS_IT_IS))[0]) == len(cloud)
