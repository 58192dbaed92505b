"""The packed library of the frozen program: unpacked once, whole, and linked before the import."""

from __future__ import annotations

import ctypes
import ctypes.util
import shutil
import sys
from pathlib import Path

import pytest

from floorplan_core import open3d_import
from floorplan_core.errors import OutputError
from floorplan_core.open3d_import import PACKED, link_packed

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the library is packed on Linux only")


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package folder with one packed library: a copy of one that this interpreter has loaded."""
    loaded = {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if ".so" in line}
    library = min((Path(p) for p in loaded if Path(p).is_file()), key=lambda p: p.stat().st_size)
    folder = tmp_path / "open3d"
    folder.mkdir()
    zstd = open3d_import._zstd()
    (folder / f"{library.name}{PACKED}").write_bytes(zstd.compress(library.read_bytes()))
    shutil.copy(library, tmp_path / "original")
    return folder


def test_it_is_unpacked_once(package, tmp_path):
    (library,) = link_packed(package, tmp_path / "cache")
    assert library.read_bytes() == (tmp_path / "original").read_bytes()
    assert ctypes.CDLL(str(library))
    written = library.stat().st_mtime_ns
    assert link_packed(package, tmp_path / "cache") == [library]
    assert library.stat().st_mtime_ns == written
    assert [p.name for p in library.parent.iterdir()] == [library.name]


def test_without_packed_libraries_nothing_happens(tmp_path):
    assert link_packed(tmp_path, tmp_path / "cache") == []
    assert not (tmp_path / "cache").exists()


def test_no_room_is_a_sentence(package, tmp_path):
    (tmp_path / "cache").write_text("a file where the folder should be")
    with pytest.raises(OutputError, match=r"cannot be unpacked into .*free 250 MB"):
        link_packed(package, tmp_path / "cache")
