"""LAS and LAZ: what laspy writes comes back; damage is one sentence."""

from __future__ import annotations

import struct

import laspy
import numpy as np
import pytest
from laspy.vlrs.known import GeoKeyDirectoryVlr, WktCoordinateSystemVlr

from tests.plugins.plugin_files import opened, refusal, survives, whole
from tests.readers.reader_clouds import Remembering, path_in_room, room, write_tum

SHIFT = np.array([448_000.0, 5_412_000.0, 120.0])
WKT = (
    'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",DATUM["x",SPHEROID["y",6378137,298.25]],'
    'UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],UNIT["metre",1]]'
)


@pytest.fixture
def cloud():
    return room(np.random.default_rng(1), density=20)


def write_las(path, points, version="1.4", point_format=6, scale=1e-4, offset=(0, 0, 0), vlrs=(), **columns):
    header = laspy.LasHeader(version=version, point_format=point_format)
    header.scales, header.offsets = np.full(3, scale), np.array(offset, dtype=float)
    if "scan_id" in columns:
        header.add_extra_dim(laspy.ExtraBytesParams("scan_id", np.uint16))
    header.vlrs.extend(vlrs)
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    for name, values in columns.items():
        las[name] = values
    las.write(str(path))
    return path


@pytest.mark.parametrize("suffix", [".las", ".laz"])
@pytest.mark.parametrize(("version", "form"), [("1.2", 0), ("1.2", 3), ("1.3", 1), ("1.4", 6), ("1.4", 7)])
def test_round_trip(tmp_path, cloud, suffix, version, form):
    survey = opened(write_las(tmp_path / f"a{suffix}", cloud, version, form))
    points, ids = whole(survey)
    assert ids is None
    assert survey.format == suffix[1:].upper()
    assert survey.point_count == len(cloud)
    np.testing.assert_allclose(points, cloud, atol=6e-5)


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_utm_and_its_name_are_kept(tmp_path, cloud, suffix):
    path = write_las(tmp_path / f"a{suffix}", cloud + SHIFT, offset=SHIFT, vlrs=[WktCoordinateSystemVlr(WKT)])
    survey = opened(path, unit="auto", up="auto")
    points, _ = whole(survey)
    np.testing.assert_allclose(points + survey.local_frame.shift, cloud + SHIFT, atol=2e-4)
    assert survey.local_frame.crs == WKT
    assert survey.local_frame.unit == "m"
    assert any("WGS 84 / UTM zone 32N" in text for text in survey.assumptions)


def geo_keys(*keys):
    vlr = GeoKeyDirectoryVlr()
    data = struct.pack("<4H", 1, 1, 0, len(keys)) + b"".join(struct.pack("<4H", k, 0, 1, v) for k, v in keys)
    vlr.parse_record_data(data)
    return vlr


def test_geotiff_keys_name_system_and_unit(tmp_path, cloud):
    path = write_las(
        tmp_path / "a.las",
        cloud / (1200 / 3937),
        "1.2",
        1,
        vlrs=[geo_keys((1024, 1), (3072, 2263), (3076, 9003))],
    )
    survey = opened(path, unit="auto", up="auto")
    assert survey.local_frame.crs == "EPSG:2263"
    assert survey.local_frame.unit == "us-ft"
    np.testing.assert_allclose(whole(survey)[0], cloud, atol=1e-4)


def test_degrees_are_refused(tmp_path, cloud):
    path = write_las(tmp_path / "a.las", cloud, "1.2", 1, vlrs=[geo_keys((1024, 2))])
    assert "degrees" in refusal(path)


def test_scan_ids_of_an_extra_dimension(tmp_path, cloud):
    ids = np.sort(np.arange(len(cloud)) % 40)
    write_tum(tmp_path / "trajectory.tum", path_in_room())
    survey = opened(write_las(tmp_path / "a.laz", cloud, scan_id=ids))
    assert survey.trajectory is not None
    np.testing.assert_array_equal(whole(survey)[1], ids)


@pytest.mark.parametrize("clock", [0.0, 1e9, 1e9 + 315_964_800 - 18])
def test_gps_time_finds_the_row_of_the_trajectory(tmp_path, cloud, clock):
    rows = path_in_room()
    start = 300_000_000.0  # adjusted standard GPS time
    truth = np.arange(len(cloud)) % 40
    jitter = np.random.default_rng(2).uniform(-0.2, 0.2, len(cloud))
    path = write_las(tmp_path / "a.las", cloud, gps_time=rows[truth, 0] + start + jitter)
    rows[:, 0] += start + clock
    file = tmp_path / "path.tum"
    file.write_text("\n".join(" ".join(f"{v:.12g}" for v in row) for row in rows))
    survey = opened(path, trajectory=file)
    np.testing.assert_array_equal(whole(survey)[1], truth)
    assert any("joined to the trajectory by time" in text for text in survey.assumptions)


def test_seconds_of_the_week(tmp_path, cloud):
    rows = path_in_room()
    truth = np.arange(len(cloud)) % 40
    path = write_las(tmp_path / "a.las", cloud, gps_time=rows[truth, 0] + 345_678.0)
    adjusted = write_las(
        tmp_path / "b.las", cloud, gps_time=rows[truth, 0] + 345_678.0 + 2200 * 604_800 - 1e9
    )
    rows[:, 0] += 345_678.0
    file = write_tum(tmp_path / "path.tum", rows)
    for cloud_file in (path, adjusted):
        np.testing.assert_array_equal(whole(opened(cloud_file, trajectory=file))[1], truth)


def test_points_without_a_row_are_counted(tmp_path, cloud):
    rows = path_in_room()
    stamps = rows[np.arange(len(cloud)) % 40, 0]
    stamps[:100] += 1000.0
    file = write_tum(tmp_path / "path.tum", rows)
    observer = Remembering()
    points, _ = whole(opened(write_las(tmp_path / "a.las", cloud, gps_time=stamps), observer, file))
    assert len(points) == len(cloud) - 100
    assert any(text.startswith("100 of the") for text in observer.warnings)


def test_times_of_another_survey(tmp_path, cloud):
    path = write_las(tmp_path / "a.las", cloud, gps_time=np.arange(len(cloud)) + 5e6)
    file = write_tum(tmp_path / "path.tum", path_in_room())
    assert "do not meet" in refusal_with(path, file)


def refusal_with(path, file):
    from floorplan_core.errors import InputError

    with pytest.raises(InputError) as caught:
        opened(path, trajectory=file)
    return str(caught.value)


@pytest.mark.parametrize(("version", "form"), [("1.2", 1), ("1.4", 6)])
def test_noise_is_left_out_and_counted(tmp_path, cloud, version, form):
    classes, withheld = np.zeros(len(cloud), dtype=np.uint8), np.zeros(len(cloud), dtype=np.uint8)
    classes[:7], classes[7:10], withheld[10:12] = 7, 18, 1
    observer = Remembering()
    columns = {"classification": classes, "withheld": withheld}
    survey = opened(write_las(tmp_path / "a.laz", cloud, version, form, **columns), observer)
    np.testing.assert_allclose(whole(survey)[0], cloud[12:], atol=6e-5)
    whole(survey)
    assert sum("12 of the" in text and "noise" in text for text in observer.warnings) == 1


@pytest.mark.parametrize("minor", [0, 1])
@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_old_versions(tmp_path, cloud, minor, suffix):
    """Their headers are those of 1.2; what is a bit field or an identity there was reserved."""
    path = write_las(tmp_path / f"a{suffix}", cloud, "1.2", 1)
    data = bytearray(path.read_bytes())
    data[4:24], data[25] = bytes(20), minor
    path.write_bytes(bytes(data))
    np.testing.assert_allclose(whole(opened(path))[0], cloud, atol=1e-4)


def test_a_signature_where_the_first_point_should_be(tmp_path, cloud):
    path = write_las(tmp_path / "a.las", cloud, "1.2", 0)
    data = bytearray(path.read_bytes())
    offset = struct.unpack_from("<I", data, 96)[0]
    data[25] = 0
    path.write_bytes(bytes(data[:offset] + b"\xdd\xcc" + data[offset:]))
    assert "two bytes before it is" in refusal(path)


def test_chunks_are_bounded(tmp_path, cloud, monkeypatch):
    import floorcast_plugins.las as module

    monkeypatch.setattr(module, "CHUNK_POINTS", 500)
    for suffix in (".las", ".laz"):
        sizes = [len(c.points) for c in opened(write_las(tmp_path / f"a{suffix}", cloud)).chunks()]
        assert max(sizes) <= 500
        assert sum(sizes) == len(cloud)


@pytest.mark.parametrize(
    ("at", "form", "value", "says"),
    [
        (247, "<Q", 10**12, "promises 1,000,000,000,000 points"),
        (25, "B", 9, "LAS version 1.9"),
        (104, "B", 60, "point format 60"),
        (105, "<H", 3, "3 bytes each"),
        (100, "<I", 1 << 31, "truncated or damaged"),
        (96, "<I", 1 << 31, "truncated or damaged"),
    ],
)
def test_headers_that_lie(tmp_path, cloud, at, form, value, says):
    path = write_las(tmp_path / "a.las", cloud)
    data = bytearray(path.read_bytes())
    struct.pack_into(form, data, at, value)
    path.write_bytes(bytes(data))
    assert says in refusal(path)


def test_a_chunk_table_that_lies(tmp_path, cloud):
    path = write_las(tmp_path / "a.laz", cloud)
    data = bytearray(path.read_bytes())
    offset = struct.unpack_from("<I", data, 96)[0]
    table = struct.unpack_from("<q", data, offset)[0]
    struct.pack_into("<I", data, table + 4, 0xFFFFFFFF)
    path.write_bytes(bytes(data))
    assert "announces 4,294,967,295 chunks" in refusal(path)


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_damage(tmp_path, suffix):
    cloud = room(np.random.default_rng(3), density=5)
    path = write_las(tmp_path / f"a{suffix}", cloud, vlrs=[WktCoordinateSystemVlr(WKT)])
    assert survives(path, tmp_path) > 20


def test_without_the_library(tmp_path, cloud, monkeypatch):
    import sys

    path = write_las(tmp_path / "a.las", cloud)
    monkeypatch.setitem(sys.modules, "laspy", None)
    assert "pip install 'laspy[lazrs]'" in refusal(path)


def test_only_the_layers_in_use_are_unpacked_and_all_of_those(tmp_path, cloud):
    rng, n = np.random.default_rng(9), len(cloud)
    columns = {
        "gps_time": np.sort(rng.uniform(0, 9, n)),
        "intensity": rng.integers(0, 60_000, n),
        "classification": rng.choice([1, 2, 6, 7, 18], n),
        "withheld": rng.integers(0, 2, n),
        **{name: rng.integers(0, 60_000, n) for name in ("red", "green", "blue")},
        "user_data": rng.integers(0, 250, n),
        "scan_angle": rng.integers(-9000, 9000, n),
    }
    chunks = []
    for name in ("a.las", "a.laz"):
        path = write_las(tmp_path / name, cloud, point_format=7, **columns)
        chunks.append(next(iter(opened(path).chunks())))
    plain, packed = chunks
    kept = ~np.isin(columns["classification"], (7, 18)) & (columns["withheld"] == 0)
    assert len(packed.points) == np.count_nonzero(kept)
    for field in ("points", "stamps", "rgb", "intensity"):
        np.testing.assert_array_equal(getattr(packed, field), getattr(plain, field))
    np.testing.assert_array_equal(packed.stamps, columns["gps_time"][kept])
    np.testing.assert_array_equal(packed.intensity, columns["intensity"][kept])
