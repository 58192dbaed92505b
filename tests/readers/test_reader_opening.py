"""Whatever a path may be: the right reader by content, or one clear sentence."""

from __future__ import annotations

import os
import socket

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import Cancelled, InputError
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.plugins import Reader
from floorplan_core.readers import builtin_readers, open_survey
from tests.readers.reader_clouds import Remembering, all_points, room, write_pcd, write_ply, xyz_columns

AS_IT_IS = InputConfig(unit="m", up="z")


@pytest.fixture
def cloud():
    return room(np.random.default_rng(20), density=10)


def refused(path, **options):
    with pytest.raises(InputError) as caught:
        open_survey(path, **options)
    text = str(caught.value)
    assert caught.value.exit_status == 3
    assert "\n" not in text
    assert text.endswith(".")
    return text


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("a.ply", b"", "a.ply is empty"),
        ("a.ply", b"\xff\xd8\xff\xe0\x00\x10JFIF" + b"\x00" * 99, "a JPEG picture, not a point cloud"),
        ("a.jpg", b"\xff\xd8\xff\xe0\x00\x10JFIF" + b"\x00" * 99, "a JPEG picture, not a point cloud"),
        ("a.ply", b"\n<!DOCTYPE html><html>404</html>", "a web page"),
        ("a.pcd", b"%PDF-1.7\n", "a PDF document"),
        ("a.las", b"LASF" + b"\x00" * 400, "a LAS or LAZ file, for which no reader"),
        ("a.ply", b"\x00\x01\x02\x03" * 40, "claims to be PLY but its content is not"),
        ("a.xyz", b"\x00\x01\x02\x03" * 40, "claims to be XYZ but its content is not"),
        ("a.foo", b"\x00\x01\x02\x03" * 40, "not a point cloud that Floorcast knows"),
        ("a.zip", b"PK\x03\x04" + b"\x00" * 40, "ZIP archive"),
        ("a.geojson", b'{"type": "FeatureCollection"}', "a JSON document"),
        ("a.pkl", b"\x80\x04\x95" + b"\x00" * 40, "pickled"),
        ("a.pkl", b"\x80\x05\x95" + b"\x00" * 40, "pickled"),
        ("a.txt", "1 2 3\n4 5 6\n7 8 9\n".encode("utf-16"), "text in UTF-16"),
        ("a.tar", b"a.ply".ljust(257, b"\x00") + b"ustar\x00" + b"\x00" * 249, "a tar archive"),
        ("a.ply", b"version https://git-lfs.github.com/spec/v1\n", "the pointer of Git LFS"),
        ("000000.bin", b"\x00\x00\x80\x3f" * 40, "name the folder of the scans"),
        ("a.rcp", b"\x00\x01\x02\x03" * 40, "a project of ReCap"),
        ("a.ifc", b"ISO-10303-21;\nHEADER;\n", "a truth for the command evaluate"),
    ],
)
def test_what_it_is_instead(tmp_path, name, content, says):
    (tmp_path / name).write_bytes(content)
    assert says in refused(tmp_path / name)


def test_things_that_are_no_files(tmp_path):
    os.mkfifo(tmp_path / "pipe.ply")
    (tmp_path / "loop.ply").symlink_to(tmp_path / "loop.ply")
    (tmp_path / "lost.ply").symlink_to(tmp_path / "nowhere.ply")
    server = socket.socket(socket.AF_UNIX)
    folder = os.getcwd()
    os.chdir(tmp_path)  # socket addresses are short
    try:
        server.bind("s.ply")
    finally:
        os.chdir(folder)
    assert "a pipe" in refused(tmp_path / "pipe.ply")
    assert "a socket" in refused(tmp_path / "s.ply")
    assert "symbolic links" in refused(tmp_path / "loop.ply")
    assert "does not exist" in refused(tmp_path / "lost.ply")
    assert "does not exist" in refused(tmp_path / "missing.ply")
    assert "a device" in refused("/dev/null")
    assert "trajectory" in refused_trajectory(tmp_path)
    server.close()


def test_a_folder_with_links_to_itself_pipes_and_devices(tmp_path, cloud):
    folder = tmp_path / "run"
    folder.mkdir()
    write_ply(folder / "a.ply", "ascii", xyz_columns(cloud, scan_id=np.zeros(len(cloud), "i4")))
    (folder / "self").symlink_to(folder)
    (folder / "b.ply").symlink_to(folder / "b.ply")
    (folder / "c.ply").symlink_to("/dev/zero")
    os.mkfifo(folder / "d.ply")
    os.mkfifo(folder / "trajectory.tum")
    (folder / "trajectory.txt").symlink_to("/dev/zero")
    np.testing.assert_allclose(all_points(open_survey(folder, config=AS_IT_IS))[0], cloud, atol=1e-5)


def refused_trajectory(tmp_path):
    write_ply(tmp_path / "a.ply", "ascii", xyz_columns(np.zeros((3, 3))))
    return refused(tmp_path / "a.ply", trajectory=tmp_path / "pipe.ply")


def test_unreadable(tmp_path, cloud, monkeypatch):
    path = write_ply(tmp_path / "a.ply", "ascii", xyz_columns(cloud))
    real = type(path).open

    def denied(self, *args, **kwargs):
        if self.name == "a.ply":
            raise PermissionError(13, "Permission denied")
        return real(self, *args, **kwargs)

    monkeypatch.setattr(type(path), "open", denied)
    assert "Permission denied" in refused(path)


def test_read_by_content_not_by_name(tmp_path, cloud):
    path = write_pcd(tmp_path / "really_pcd.ply", "binary", xyz_columns(cloud))
    survey = open_survey(path, config=AS_IT_IS)
    assert survey.format == "PCD"
    assert any("holds PCD" in text for text in survey.assumptions)
    np.testing.assert_allclose(all_points(survey)[0], cloud, atol=1e-5)


def test_points_that_are_not_finite_are_counted_once(tmp_path, cloud):
    cloud[::10] = np.nan
    cloud[1::10, 1] = np.inf
    lost = len(cloud[::10]) + len(cloud[1::10])
    ids = np.zeros(len(cloud), "i4")
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud, scan_id=ids))
    seen = Remembering()
    survey = open_survey(path, config=AS_IT_IS, observer=seen)
    for _ in range(2):
        points, found = all_points(survey)
        assert len(points) == len(found) == len(cloud) - lost
        assert np.isfinite(points).all()
    assert len([w for w in seen.warnings if f"{lost:,} of the {len(cloud):,} points" in w]) == 1


def test_no_finite_point_at_all(tmp_path):
    path = write_ply(tmp_path / "a.ply", "ascii", xyz_columns(np.full((9, 3), np.nan)))
    assert "no point with finite coordinates" in refused(path)


def test_cancelled_between_chunks(tmp_path, cloud):
    token = CancelToken()
    path = write_ply(tmp_path / "a.ply", "ascii", xyz_columns(cloud))
    survey = open_survey(path, observer=Observer(token))
    token.cancel()
    with pytest.raises(Cancelled):
        next(survey.chunks())


def test_a_file_that_shrinks_while_it_is_read(tmp_path, cloud):
    path = write_ply(tmp_path / "a.ply", "binary_little_endian", xyz_columns(cloud))
    survey = open_survey(path, config=AS_IT_IS)
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(InputError, match="became shorter"):
        all_points(survey)


def test_the_built_in_readers_follow_the_protocol():
    for reader in builtin_readers():
        assert isinstance(reader, Reader)
        assert reader.name
        assert reader.description


def test_a_registry_brings_other_readers(tmp_path):
    class Shout:
        name = "SHOUT"
        suffixes = (".shout",)
        description = "for this test"

        def sniff(self, path, head):
            return float(head.startswith(b"HEY"))

        def open(self, path, options, observer):
            raise ValueError("not so loud")

    class Registry:
        readers = (Shout(),)

    path = tmp_path / "a.shout"
    path.write_bytes(b"HEY you")
    assert "damaged (SHOUT: not so loud)" in refused(path, registry=Registry())
    assert "not a point cloud" in refused(path)


@pytest.mark.parametrize("name", [b"two\nlines.ply", b"no utf-8 \xff\xfe.ply"])
def test_names_that_are_no_text(tmp_path, cloud, name):
    """What is said of a survey goes into files of text, and an error is one line."""
    path = tmp_path / os.fsdecode(name)
    survey = open_survey(write_ply(path, "ascii", xyz_columns(cloud)), config=AS_IT_IS)
    said = "".join([survey.name, *survey.assumptions])
    assert said.encode("utf-8") and "\n" not in said
    path.write_bytes(path.read_bytes()[:300])
    assert "lines.ply" in refused(path) or b"utf" in name
