"""Plans and stage results survive a round trip without loss; nothing damaged is read."""

from __future__ import annotations

import dataclasses
import io
import json
import math
import pickle
import tracemalloc
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from floorplan_core import intermediates
from floorplan_core.config import Config
from floorplan_core.errors import InputError
from floorplan_core.model import (
    CandidateSet,
    Door,
    Facing,
    FloorPlan,
    LayoutPlane,
    LayoutSegment,
    OccupancyGrid,
    Reconstruction,
    Region,
    RegionSide,
    WallProfile,
)
from tests import factories


def same(a: Any, b: Any) -> bool:
    """Equal in type and value, NaN equal to NaN, arrays by bits."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if dataclasses.is_dataclass(a):
        return all(same(getattr(a, f.name), getattr(b, f.name)) for f in dataclasses.fields(a))
    if isinstance(a, tuple | list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict):
        return list(a) == list(b) and all(same(a[k], b[k]) for k in a)
    if isinstance(a, float | np.floating) and math.isnan(a):
        return math.isnan(b)
    if hasattr(a, "geom_type"):
        return shapely.to_wkb(a) == shapely.to_wkb(b)
    return bool(a == b)


def round_trip(value: Any, folder: Path) -> Any:
    path = folder / "x.floorplan"
    intermediates.save(value, path)
    return intermediates.load(path, object)


@pytest.mark.parametrize("make", [factories.small_flat, factories.l_corridor])
def test_a_plan_survives_exactly(make: Any, tmp_path: Path) -> None:
    plan = make(shift=(4.5e6, 5.1e6, 100.0))
    back = round_trip(plan, tmp_path)
    assert same(plan, back)
    assert isinstance(back, FloorPlan) and back.regions[0].area == plan.regions[0].area
    assert intermediates.dumps(back) == intermediates.dumps(plan)


floats = st.floats(allow_nan=True, allow_infinity=True)
words = st.text(max_size=8)
arrays = hnp.arrays(
    st.sampled_from([np.float64, np.float32, np.int64, np.int32, np.int16, np.bool_, np.dtype(">f8")]),
    hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
)
pairs = hnp.arrays(np.float64, st.tuples(st.integers(0, 3), st.just(2)))
row = hnp.arrays(np.float64, st.integers(0, 4))
facings = st.sampled_from(Facing)
boxes = st.builds(
    lambda x, y, w, h: shapely.box(x, y, x + w, y + h),
    *[st.floats(-1e6, 1e6)] * 2,
    *[st.floats(0.1, 100)] * 2,
)
i64 = [hnp.arrays(np.int64, 2)] * 2
cells = [hnp.arrays(np.uint8, (2, 3)), hnp.arrays(np.bool_, (2, 3))]
ends = [st.tuples(floats, floats)] * 2
names = st.tuples(words)
many = [floats] * 6
profiles = st.builds(WallProfile, floats, floats, row, row, row)
sides = st.builds(RegionSide, *ends, words, floats, st.booleans())
some = st.none() | floats
rectangles = st.none() | hnp.arrays(np.int64, st.integers(0, 4))
ints = [st.integers()] * 2
settings = st.builds(lambda a: Config().with_values({"voxels.size": str(a)}), st.floats(0.02, 1))
plane_parts = [
    words,
    facings,
    floats,
    names,
    floats,
    floats,
    st.booleans(),
    st.none() | profiles,
    pairs,
    pairs,
]
region_parts = [words, words, boxes, words, *ints, floats, st.tuples(sides), names, some, floats, rectangles]
segment_parts = [words, facings, *many, st.integers(), floats, floats, words, st.booleans(), names]
objects = st.one_of(
    settings,
    st.builds(LayoutSegment, *segment_parts),
    st.builds(LayoutPlane, *plane_parts),
    st.builds(Door, words, names, st.integers(0, 1), floats, floats, floats, height=some),
    st.builds(Region, *region_parts),
    st.builds(OccupancyGrid, hnp.arrays(np.float64, 2), floats, *cells, floats),
    st.builds(CandidateSet, row, row, row, row, hnp.arrays(np.int32, (2, 6)), st.integers()),
)
leaves = st.one_of(st.none(), st.booleans(), st.integers(), floats, words, arrays, facings, boxes, objects)
values = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.lists(inner, max_size=3).map(tuple),
        st.dictionaries(words, inner, max_size=3),
    ),
    max_leaves=8,
)


@given(values)
def test_anything_made_of_data_survives_exactly(value: Any) -> None:
    again = intermediates.loads(intermediates.dumps(value))
    native = value.astype(value.dtype.newbyteorder("<")) if isinstance(value, np.ndarray) else value
    assert same(native, again) or contains_big_endian(value)
    assert intermediates.dumps(again) == intermediates.dumps(value)


def contains_big_endian(value: Any) -> bool:
    """Arrays come back little-endian: equal in value, not in bytes (compared through the second dump)."""
    if isinstance(value, np.ndarray):
        return value.dtype.str.startswith(">")
    if isinstance(value, tuple | list):
        return any(map(contains_big_endian, value))
    return isinstance(value, dict) and any(map(contains_big_endian, value.values()))


@pytest.mark.parametrize(
    "value",
    [
        Reconstruction("x", lambda: iter(())),
        np.array(["text"]),
        np.array([object()]),
        object(),
        {1, 2},
        len,
    ],
)
def test_what_is_not_data_is_refused(value: object) -> None:
    with pytest.raises(TypeError, match="cannot be saved"):
        intermediates.dumps(value)


def refused(data: bytes, folder: Path, expected: type = FloorPlan) -> str:
    path = folder / "bad.floorplan"
    path.write_bytes(data)
    with pytest.raises(InputError) as caught:
        intermediates.load(path, expected)
    text = str(caught.value)
    assert "bad.floorplan" in text and "\n" not in text
    return text


def altered(change: Any, **pools: bytes) -> bytes:
    """A saved plan with ``change`` applied to its tree and members replaced by ``pools``."""
    source = zipfile.ZipFile(io.BytesIO(intermediates.dumps(factories.small_flat())))
    members = {name: source.read(name) for name in source.namelist()}
    tree = json.loads(members["tree.json"])
    members["tree.json"] = json.dumps(change(tree) or tree).encode()
    members.update({f"{name}.npy": data for name, data in pools.items()})
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return buffer.getvalue()


def set_field(tree: dict[str, Any], name: str, value: Any) -> None:
    root = tree["root"]
    root[root.index(name) + 1] = value


def test_the_altering_helper_itself_gives_a_readable_plan(tmp_path: Path) -> None:
    path = tmp_path / "same.floorplan"
    path.write_bytes(altered(lambda tree: None))
    assert isinstance(intermediates.load(path, FloorPlan), FloorPlan)


DAMAGES: dict[str, Any] = {
    "another kind of zip": lambda t: {"format": "other"},
    "its version is 99": lambda t: t.update(version=99),
    "an unknown tag": lambda t: t.update(root=["q", 1]),
    "an unknown 'Popen'": lambda t: t.update(root=["o", "Popen", "args", "id"]),
    "FloorPlan.doors is a str": lambda t: set_field(t, "doors", "none"),
    "FloorPlan.point_count is a float": lambda t: set_field(t, "point_count", 1.5),
    "FloorPlan.trajectory is a ndarray": lambda t: set_field(t, "trajectory", ["a", "b1", 0, [1]]),
    "FloorPlan comes from another version": lambda t: t["root"].extend(["colour", 1]),
    "its FloorPlan comes from another version": lambda t: t.update(
        root=[v for i, v in enumerate(t["root"]) if i not in (1 + 19, 2 + 19)]
    ),
    "an array is missing": lambda t: set_field(t, "trajectory", ["a", "f8", 10**12, [10**12, 2]]),
    "the place of an array": lambda t: set_field(t, "trajectory", ["a", "f8", -1, [1, 2]]),
    "a polygon is damaged": lambda t: t.update(root=["g", "0102zz"]),
}


def test_a_file_of_an_earlier_version_lacks_what_has_a_default(tmp_path: Path) -> None:
    """Plans that were saved before corrections came are read: nothing in them was corrected."""

    def without_corrections(tree: dict[str, Any]) -> None:
        root = tree["root"]
        for name in ("corrected", "machine"):
            at = root.index(name)
            del root[at : at + 2]

    path = tmp_path / "old.floorplan"
    path.write_bytes(altered(without_corrections))
    assert intermediates.load(path, FloorPlan).corrected == ()


@pytest.mark.parametrize("words", DAMAGES)
def test_a_tree_that_makes_no_sense_is_refused(words: str, tmp_path: Path) -> None:
    assert words in refused(altered(DAMAGES[words]), tmp_path)


def test_arrays_that_lie_about_their_size_are_refused_before_any_memory_is_taken(tmp_path: Path) -> None:
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<f8", "fortran_order": False, "shape": (10**13,)})
    assert "shorter or longer" in refused(altered(lambda t: None, f8=header.getvalue()), tmp_path)


def test_pickled_arrays_are_refused(tmp_path: Path) -> None:
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "|O", "fortran_order": False, "shape": (1,)})
    data = header.getvalue() + pickle.dumps([print])
    refused(altered(lambda t: None, f8=data), tmp_path)


def test_another_object_than_the_wanted_one(tmp_path: Path) -> None:
    assert "holds a Config, where a FloorPlan is wanted" in refused(intermediates.dumps(Config()), tmp_path)


def test_a_tree_that_is_nested_too_deeply(tmp_path: Path) -> None:
    def deep(tree: dict[str, Any]) -> None:
        tree["root"] = 0
        for _ in range(900):
            tree["root"] = ["l", tree["root"]]

    refused(altered(deep), tmp_path)


@given(st.binary(max_size=200))
def test_random_bytes_are_refused(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    refused(data, tmp_path_factory.getbasetemp())


@given(st.integers(0, 10**6), st.integers(1, 255))
def test_a_damaged_byte_is_found_or_harmless(
    tmp_path_factory: pytest.TempPathFactory, place: int, change: int
) -> None:
    data = bytearray(PLAN_BYTES)
    data[place % len(data)] ^= change
    path = tmp_path_factory.getbasetemp() / "damaged.floorplan"
    path.write_bytes(data)
    try:
        assert isinstance(intermediates.load(path, FloorPlan), FloorPlan)  # a byte that carries nothing
    except InputError as error:
        assert "damaged.floorplan" in str(error)


PLAN_BYTES = intermediates.dumps(factories.small_flat())


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
def test_truncated_files_are_refused(share: float, tmp_path: Path) -> None:
    refused(PLAN_BYTES[: int(share * len(PLAN_BYTES))], tmp_path)


def test_arrays_are_held_once_while_they_are_saved_and_loaded(tmp_path: Path) -> None:
    arrays, path = tuple(np.zeros(2**20) for _ in range(4)), tmp_path / "large.floorplan"
    size = sum(a.nbytes for a in arrays)
    tracemalloc.start()
    try:
        intermediates.save(arrays, path)
        assert tracemalloc.get_traced_memory()[1] < size / 4
        assert len(intermediates.load(path, tuple)) == 4
        assert size < tracemalloc.get_traced_memory()[1] < 1.5 * size
    finally:
        tracemalloc.stop()


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"Cannot read none\.floorplan: no such file"):
        intermediates.load(tmp_path / "none.floorplan", FloorPlan)
