"""Our own reading of E57 records gives what libE57 gives, for values of any width, and notices damage."""

from __future__ import annotations

import numpy as np
import pye57
import pytest
from pye57 import libe57

from floorcast_plugins import _e57_packets as packets
from floorcast_plugins._e57_scans import (
    _read_by_library,
    _wanted,
    check_file,
    list_scans,
    opened_image,
    read_scan,
)
from tests.plugins.e57_files import write_fields
from tests.plugins.plugin_files import refusal

MOST = 1 << 53  # up to which doubles are exact
COUNT = 20_011  # neither whole bytes nor whole buffers


def integers(rng, bits):
    """Integers that need ``bits`` bits above a minimum, with both ends among them."""
    low = -int(rng.integers(0, 1 << bits))
    high = low + (1 << bits) - 1
    values = rng.integers(max(low, -MOST), min(high, MOST), COUNT, endpoint=True)
    return low, high, values.astype(np.float64)  # what libE57's binding takes 64 bits as


def scan_of(path):
    (scan,) = list_scans(path, check_file(path))
    return scan


def by_library(path, scan):
    """All wanted columns, as libE57 has them."""
    names = _wanted(scan)
    with opened_image(path) as image:
        parts = [
            {n: c.astype("f8") for n, c in read.items()}
            for read in _read_by_library(path, image, scan, names, 4096)
        ]
    return {name: np.concatenate([p[name] for p in parts]) for name in names}


@pytest.mark.parametrize("bits", [0, 1, 3, 8, 13, 20, 31, 32, 33, 57, 60, 63])
def test_integers_of_any_width(tmp_path, bits):
    rng = np.random.default_rng(bits)
    low, high, values = integers(rng, bits)
    scaled = np.linspace(-50, 50, COUNT)
    path = write_fields(
        tmp_path / "a.e57",
        {
            "cartesianX": (lambda f: libe57.ScaledIntegerNode(f, 0, -(10**6), 10**6, 1e-4, 0.25), scaled),
            "cartesianY": (lambda f: libe57.FloatNode(f, 0.0, libe57.E57_SINGLE), rng.normal(size=COUNT)),
            "cartesianZ": (lambda f: libe57.FloatNode(f, 0.0, libe57.E57_DOUBLE), rng.normal(size=COUNT)),
            "timeStamp": (lambda f: libe57.IntegerNode(f, low, low, high), values),
        },
    )
    scan, names = scan_of(path), ["cartesianX", "cartesianY", "cartesianZ", "timeStamp"]
    assert scan.records is not None
    assert scan.records.fields["timeStamp"].bits == bits
    wanted = by_library(path, scan)
    chunks = list(packets.read_columns(path, scan.records, names, 3000))
    assert max(len(points) for points, _ in chunks) <= 3000
    found = [*np.concatenate([p for p, _ in chunks]).T, np.concatenate([r[0] for _, r in chunks])]
    for name, column in zip(names, found, strict=True):
        np.testing.assert_array_equal(column, wanted[name], err_msg=name)


def cartesian(tmp_path, extra=None):
    rng = np.random.default_rng(7)
    path = tmp_path / "a.e57"
    columns = {f"cartesian{a}": rng.uniform(0, 5, COUNT) for a in "XYZ"} | (extra or {})
    with pye57.E57(str(path), "w") as file:
        file.write_scan_raw(columns)
    return path


def test_invalid_points_and_colours(tmp_path):
    rng = np.random.default_rng(8)
    invalid = rng.integers(0, 3, COUNT).astype("i1")
    seen = {f"color{c}": rng.integers(0, 255, COUNT).astype("u1") for c in ("Red", "Green", "Blue")}
    path = cartesian(tmp_path, {"cartesianInvalidState": invalid, **seen})
    scan = scan_of(path)
    assert scan.records is not None
    wanted = by_library(path, scan)
    chunks = list(read_scan(path, scan, 4000))
    assert len(chunks) == 6
    points = np.column_stack([wanted[f"cartesian{a}"] for a in "XYZ"])[invalid == 0]
    np.testing.assert_array_equal(np.concatenate([c.points for c in chunks]), points)
    np.testing.assert_array_equal(
        np.concatenate([c.rgb for c in chunks])[:, 1], seen["colorGreen"][invalid == 0]
    )


def test_a_wrong_checksum_is_damage(tmp_path):
    path = cartesian(tmp_path)
    data = bytearray(path.read_bytes())
    data[50 * packets.PAGE + 500] ^= 1
    path.write_bytes(bytes(data))
    assert "page 50 has a wrong checksum" in refusal(path)


def test_what_cannot_be_followed_is_read_by_the_library(tmp_path, monkeypatch):
    """Half way, where the kernels give up; nothing comes twice and nothing is lost."""
    path = cartesian(tmp_path)
    scan = scan_of(path)
    whole = np.concatenate([c.points for c in read_scan(path, scan)])
    original = packets.read_columns

    def half(*given):
        for k, columns in enumerate(original(*given)):
            if k == 2:
                raise packets.UnusualStreams
            yield columns

    monkeypatch.setattr("floorcast_plugins._e57_scans.read_columns", half)
    parts = [c.points for c in read_scan(path, scan, 3000)]
    assert len(parts) > 3
    np.testing.assert_array_equal(np.concatenate(parts), whole)


def test_points_that_do_not_exist(tmp_path):
    path = cartesian(tmp_path)
    scan = scan_of(path)
    more = packets.Records(scan.records.place, COUNT + 5000, scan.records.streams, scan.records.fields)
    from floorplan_core.errors import InputError

    names = ["cartesianX", "cartesianY", "cartesianZ"]
    with pytest.raises(InputError, match=r"of the 25,011 points of a scan do not exist"):
        list(packets.read_columns(path, more, names, 4096))
