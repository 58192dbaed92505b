"""Colour and intensity reach the application from every format that carries them, point by point."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.model import PointChunk
from floorplan_core.observer import Observer
from floorplan_core.plugins import default_registry
from floorplan_core.readers import open_survey
from floorplan_core.readers.colours import as_rgb, find_colours, unpack_rgb

COUNT = 500


@pytest.fixture
def cloud() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of a box of 5 x 4 x 2.5 m, with colours and intensities that tell the points apart."""
    rng = np.random.default_rng(3)
    xyz = rng.uniform(0.0, (5.0, 4.0, 2.5), (COUNT, 3)).astype(np.float32)
    return xyz, rng.integers(0, 256, (COUNT, 3)).astype(np.uint8), np.arange(COUNT, dtype=np.float32)


def read(path: Path, colours: bool = True) -> PointChunk:
    """All points of a small file as one chunk."""
    config = InputConfig(unit="m", up="z")
    survey = open_survey(path, None, config, Observer(), default_registry(), colours)
    (chunk,) = survey.chunks()
    return chunk


def both_ways(path: Path) -> PointChunk:
    """The chunk with its colours; without them it has the same points."""
    chunk, bare = read(path), read(path, colours=False)
    assert bare.rgb is None and bare.intensity is None
    np.testing.assert_array_equal(bare.points, chunk.points)
    return chunk


def test_binary_ply(tmp_path: Path, cloud: tuple[np.ndarray, ...]) -> None:
    xyz, rgb, echo = cloud
    kind = [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
    rows = np.empty(COUNT, dtype=[*kind, ("intensity", "<f4")])
    for k, name in enumerate("xyz"):
        rows[name] = xyz[:, k]
    for k, name in enumerate(("red", "green", "blue")):
        rows[name] = rgb[:, k]
    rows["intensity"] = echo
    words = {"<f4": "float", "u1": "uchar"}
    names = "".join(f"property {words[t]} {n}\n" for n, t in [*kind, ("intensity", "<f4")])
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\n{names}end_header\n"
    path = tmp_path / "cloud.ply"
    path.write_bytes(head.encode() + rows.tobytes())
    chunk = both_ways(path)
    np.testing.assert_array_equal(chunk.rgb, rgb)
    np.testing.assert_array_equal(chunk.intensity, echo)


def test_points_that_are_left_out_take_their_colours_along(
    tmp_path: Path, cloud: tuple[np.ndarray, ...]
) -> None:
    xyz, rgb, _ = cloud
    xyz[7] = np.nan
    rows = np.empty(COUNT, dtype=[("xyz", "<f4", 3), ("rgb", "u1", 3)])
    rows["xyz"], rows["rgb"] = xyz, rgb
    names = "".join(f"property float {n}\n" for n in "xyz")
    names += "".join(f"property uchar {n}\n" for n in ("red", "green", "blue"))
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\n{names}end_header\n"
    path = tmp_path / "cloud.ply"
    path.write_bytes(head.encode() + rows.tobytes())
    chunk = read(path)
    assert len(chunk.points) == COUNT - 1
    np.testing.assert_array_equal(chunk.rgb, np.delete(rgb, 7, axis=0))


def test_binary_pcd_with_packed_colours(tmp_path: Path, cloud: tuple[np.ndarray, ...]) -> None:
    xyz, rgb, echo = cloud
    wide = rgb.astype(np.uint32)
    rows = np.empty(COUNT, dtype=[("xyz", "<f4", 3), ("rgb", "<u4"), ("intensity", "<f4")])
    rows["xyz"], rows["intensity"] = xyz, echo
    rows["rgb"] = wide[:, 0] << 16 | wide[:, 1] << 8 | wide[:, 2]
    head = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb intensity\nSIZE 4 4 4 4 4\nTYPE F F F F F\n"
        f"COUNT 1 1 1 1 1\nWIDTH {COUNT}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {COUNT}\nDATA binary\n"
    )
    path = tmp_path / "cloud.pcd"
    path.write_bytes(head.encode() + rows.tobytes())
    chunk = both_ways(path)
    np.testing.assert_array_equal(chunk.rgb, rgb)
    np.testing.assert_array_equal(chunk.intensity, echo)


@pytest.mark.parametrize("name", ["cloud.las", "cloud.laz"])
def test_las_with_colours_of_16_bits(tmp_path: Path, cloud: tuple[np.ndarray, ...], name: str) -> None:
    laspy = pytest.importorskip("laspy")
    xyz, rgb, echo = cloud
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales = np.full(3, 0.001)
    las = laspy.LasData(header)
    las.x, las.y, las.z = xyz.T.astype(np.float64)
    las.red, las.green, las.blue = rgb.T.astype(np.uint16) * 257
    las.intensity = echo.astype(np.uint16)
    las.write(str(tmp_path / name))
    chunk = both_ways(tmp_path / name)
    np.testing.assert_array_equal(chunk.rgb, rgb)
    np.testing.assert_array_equal(chunk.intensity, echo)


def test_e57_with_colours(tmp_path: Path, cloud: tuple[np.ndarray, ...]) -> None:
    pye57 = pytest.importorskip("pye57")
    xyz, rgb, echo = cloud
    path = tmp_path / "cloud.e57"
    file = pye57.E57(str(path), mode="w")
    data = {f"cartesian{n}": xyz[:, k].astype(np.float64) for k, n in enumerate("XYZ")}
    data |= {f"color{n}": rgb[:, k] for k, n in enumerate(("Red", "Green", "Blue"))}
    file.write_scan_raw({**data, "intensity": echo})
    file.close()
    chunk = both_ways(path)
    np.testing.assert_array_equal(chunk.rgb, rgb)
    np.testing.assert_allclose(chunk.intensity, echo)


def test_a_file_without_colours_has_none(tmp_path: Path, cloud: tuple[np.ndarray, ...]) -> None:
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\n"
    head += "".join(f"property float {n}\n" for n in "xyz") + "end_header\n"
    path = tmp_path / "cloud.ply"
    path.write_bytes(head.encode() + cloud[0].tobytes())
    chunk = read(path)
    assert chunk.rgb is None and chunk.intensity is None


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        (np.array([[0, 128, 255]], dtype=np.uint8), [0, 128, 255]),
        (np.array([[0, 32896, 65535]], dtype=np.uint16), [0, 128, 255]),
        (np.array([[0, 128, 255]], dtype=np.uint16), [0, 128, 255]),
        (np.array([[0.0, 0.5, 1.0]]), [0, 128, 255]),
        (np.array([[0.0, np.nan, 255.0]]), [0, 0, 255]),
    ],
)
def test_channels_of_every_kind(values: np.ndarray, expected: list[int]) -> None:
    assert as_rgb(values).tolist() == [expected]


def test_names_are_found_however_they_are_written() -> None:
    assert find_colours(["X", "Y", "Z", "Red", "Green", "Blue", "Intensity"]).rgb == ("Red", "Green", "Blue")
    assert find_colours(["x", "y", "z", "rgb"]).rgb == ()
    assert find_colours(["x", "y", "z", "rgb"], packed=True).rgb == ("rgb",)
    assert unpack_rgb(np.array([1.0])) is None
