"""Reading grid maps: thresholds, orientation, bare images, and every way in which a map can be wrong."""

from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from floorplan_core.errors import InputError, UsageError
from floorplan_core.model import FREE, OCCUPIED, UNOBSERVED
from floorplan_core.readers.grid_map import is_grid_map, read_grid_map
from tests.grid_map.map_drawings import office, write_image, write_yaml
from tests.plugins.plugin_files import peak_memory


def picture(path: Path, rows: list[list[int]], mode: str = "L") -> Path:
    values = np.array(rows, dtype=np.uint16 if mode.startswith("I") else np.uint8)
    Image.fromarray(values).save(path)
    return path


def sheet(folder: Path, text: str, rows: list[list[int]]) -> Path:
    picture(folder / "m.pgm", rows)
    path = folder / "m.yaml"
    path.write_text(f"image: m.pgm\nresolution: 0.05\norigin: [1, 2, 0.5]\n{text}", encoding="utf-8")
    return path


def test_ros_map_comes_back_as_drawn(tmp_path: Path) -> None:
    drawn = office()
    read = read_grid_map(write_yaml(drawn, tmp_path))
    np.testing.assert_array_equal(read.states, drawn.states)
    assert (read.resolution, read.origin, read.yaw) == (0.05, (-1.0, -1.0), 0.0)
    assert read.name == "map.yaml" and not read.assumptions


def test_thresholds_are_those_of_the_yaml(tmp_path: Path) -> None:
    # occupancy (255 - v) / 255 of 255, 204, 127 and 0 is 0, 0.2, 0.502 and 1
    path = sheet(tmp_path, "occupied_thresh: 0.5\nfree_thresh: 0.25", [[255, 204, 127, 0]])
    assert read_grid_map(path).states.tolist() == [[FREE, FREE, OCCUPIED, OCCUPIED]]
    path = sheet(tmp_path, "occupied_thresh: 0.65\nfree_thresh: 0.196", [[255, 204, 127, 0]])
    assert read_grid_map(path).states.tolist() == [[FREE, UNOBSERVED, UNOBSERVED, OCCUPIED]]


def test_negate_swaps_black_and_white(tmp_path: Path) -> None:
    path = sheet(tmp_path, "negate: 1", [[255, 0]])
    assert read_grid_map(path).states.tolist() == [[OCCUPIED, FREE]]


def test_first_row_of_the_picture_is_the_top(tmp_path: Path) -> None:
    path = sheet(tmp_path, "", [[254, 254], [0, 254]])
    assert read_grid_map(path).states.tolist() == [[OCCUPIED, FREE], [FREE, FREE]]
    assert read_grid_map(path).origin == (1.0, 2.0) and read_grid_map(path).yaw == 0.5


def test_transparent_is_unknown_in_mode_scale(tmp_path: Path) -> None:
    Image.fromarray(np.array([[[254, 254, 254, 255], [254, 254, 254, 0]]], np.uint8)).save(tmp_path / "m.png")
    path = tmp_path / "m.yaml"
    path.write_text("image: m.png\nresolution: 0.1\norigin: [0, 0, 0]\nmode: scale\n", encoding="utf-8")
    assert read_grid_map(path).states.tolist() == [[FREE, UNOBSERVED]]


def test_bare_image_free_is_white_only(tmp_path: Path) -> None:
    path = picture(tmp_path / "m.png", [[255, 250, 249, 211, 205, 100, 0]])
    read = read_grid_map(path, 0.05)
    assert read.states.tolist() == [[FREE, FREE, OCCUPIED, OCCUPIED, UNOBSERVED, OCCUPIED, OCCUPIED]]
    assert len(read.assumptions) == 1 and "bare image" in read.assumptions[0]


def test_sixteen_bits(tmp_path: Path) -> None:
    path = picture(tmp_path / "m.png", [[65535, 0]], "I")
    assert read_grid_map(path, 0.05).states.tolist() == [[FREE, OCCUPIED]]


def test_bare_image_needs_a_resolution(tmp_path: Path) -> None:
    path = write_image(office(), tmp_path / "m.png")
    with pytest.raises(UsageError, match=r"--resolution 0\.05"):
        read_grid_map(path)


@pytest.mark.parametrize("value", [0.0, -0.05, 50.0, float("nan"), float("inf")])
def test_resolution_that_is_no_length(tmp_path: Path, value: float) -> None:
    with pytest.raises(InputError, match="resolution"):
        read_grid_map(picture(tmp_path / "m.png", [[255]]), value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("image: gone.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n", "gone.pgm does not exist"),
        ("image: m.yaml\nresolution: 0.05\norigin: [0, 0, 0]\n", "cannot be read as a picture"),
        ("image: m.pgm\nresolution: wide\norigin: [0, 0, 0]\n", "damaged map YAML"),
        ("image: m.pgm\nresolution: 0.05\norigin: [0, 0]\n", "damaged map YAML"),
        ("image: m.pgm\nresolution: 0.05\norigin: [0, .nan, 0]\n", "finite"),
        ("resolution: 0.05\n", "does not say image"),
        ("- 1\n- 2\n", "does not say image and resolution"),
        ("image: [\n", "does not say image"),
        ("image: ../m.pgm\nresolution: 0.05\n", "outside its own folder"),
        ("image: /dev/zero\nresolution: 0.05\n", "zero does not exist beside"),
        ("image: link.pgm\nresolution: 0.05\n", "outside its own folder"),
        ("image: pipe.pgm\nresolution: 0.05\n", "pipe.pgm does not exist beside"),
        ("image: m.pgm\nresolution: 1" + "0" * 400, "damaged map YAML"),
        ("image: m.pgm\nresolution: 1" + "0" * 9000, "does not say image"),
        ("image: [m.pgm]\nresolution: 0.05\n", "no name of a file"),
        ("a: &a [m]\nimage: [*a, *a]\nresolution: 0.05\n", "does not say image"),  # laughs
        ("image: m.pgm\nresolution: 0.05\norigin: " + "[" * 5000 + "]" * 5000, "does not say image"),
        ("image: m.pgm\nresolution: 2001-99-99\n", "does not say image"),
        ("image: !!python/object/apply:os.getcwd []\nresolution: 0.05\n", "does not say image"),
        ("image: m.pgm\nresolution: 0.05\n#" + "x" * (1 << 20), "does not say image"),
    ],
)
def test_damaged_yaml_is_one_sentence(tmp_path: Path, text: str, words: str) -> None:
    for folder in (tmp_path, tmp_path / "map"):
        folder.mkdir(exist_ok=True)
        picture(folder / "m.pgm", [[254]])
    (tmp_path / "map" / "link.pgm").symlink_to(tmp_path / "m.pgm")
    os.mkfifo(tmp_path / "map" / "pipe.pgm")
    (tmp_path / "map" / "m.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words) as caught:
        read_grid_map(tmp_path / "map" / "m.yaml")
    assert "\n" not in str(caught.value)


def test_a_map_saved_elsewhere_under_its_whole_path(tmp_path: Path) -> None:
    picture(tmp_path / "m.pgm", [[254]])
    (tmp_path / "m.yaml").write_text("image: /home/robot/maps/m.pgm\nresolution: 0.05\n", encoding="utf-8")
    assert read_grid_map(tmp_path / "m.yaml").states.tolist() == [[FREE]]


def png_of_zeros(path: Path, width: int, height: int) -> Path:
    """A tiny file of many black pixels."""

    def part(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    packer = zlib.compressobj(9)
    rows = b"".join(packer.compress(bytes(1 + width)) for _ in range(min(height, 10_000))) + packer.flush()
    head = struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + part(b"IDAT", rows) + part(b"IEND", b""))
    return path


@pytest.mark.parametrize("side", [10_001, 14_000, 100_000])
def test_a_picture_of_too_many_pixels_is_refused_before_it_is_unpacked(
    tmp_path: Path, side: int, recwarn: pytest.WarningsRecorder
) -> None:
    path = png_of_zeros(tmp_path / "m.png", side, side)
    before = peak_memory(reset=True)
    with pytest.raises(InputError, match=r"m\.png has more than 100,000,000 pixels"):
        read_grid_map(path, 0.05)
    assert peak_memory() - before < 50 << 20
    assert not recwarn.list


@pytest.mark.parametrize("mode", ["L", "RGBA"])
def test_a_large_picture_takes_little_more_than_its_cells(tmp_path: Path, mode: str) -> None:
    side = 3000
    Image.new(mode, (side, side), 254 if mode == "L" else (254, 254, 254, 255)).save(tmp_path / "m.png")
    before = peak_memory(reset=True)
    assert (read_grid_map(tmp_path / "m.png", 0.05).states == FREE).all()
    assert peak_memory() - before < 12 * side**2


def test_damaged_picture(tmp_path: Path) -> None:
    whole = write_image(office(), tmp_path / "m.png").read_bytes()
    (tmp_path / "cut.png").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputError, match=r"cut\.png cannot be read"):
        read_grid_map(tmp_path / "cut.png", 0.05)


def test_what_is_a_grid_map(tmp_path: Path) -> None:
    assert is_grid_map(write_yaml(office(), tmp_path))
    assert is_grid_map(tmp_path / "map.pgm")
    settings = tmp_path / "settings.yaml"
    settings.write_text("doors: {max_width: 1.2}\n", encoding="utf-8")
    assert not is_grid_map(settings)
    assert not is_grid_map(tmp_path / "cloud.ply") and not is_grid_map(tmp_path)
