"""The packed libraries of the frozen program: unpacked once, whole, and linked before the import."""

from __future__ import annotations

import ctypes
import io
import shutil
import sys
import tarfile
from pathlib import Path

import pytest

from floorplan_core import packed_libraries
from floorplan_core.errors import OutputError
from floorplan_core.packed_libraries import PACKED, LinkBeforeImport, link_packed

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="libraries are packed on Linux only")
NAME = "things-0123456789ab"


@pytest.fixture
def packed(tmp_path: Path) -> Path:
    """One packed library: a copy of one that this interpreter has loaded."""
    loaded = {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if ".so" in line}
    library = min((Path(p) for p in loaded if Path(p).is_file()), key=lambda p: p.stat().st_size)
    folder = tmp_path / "packed"
    folder.mkdir()
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode="w") as tar:
        tar.add(library.resolve(), arcname=library.name)
    shutil.copy(library, tmp_path / "original")
    file = folder / f"{NAME}{PACKED}"
    file.write_bytes(packed_libraries._zstd().compress(content.getvalue()))
    return file


def test_they_are_unpacked_once(packed: Path, tmp_path: Path) -> None:
    (library,) = link_packed(packed, tmp_path / "cache")
    assert library.read_bytes() == (tmp_path / "original").read_bytes()
    assert ctypes.CDLL(str(library))
    written = library.stat().st_mtime_ns
    assert link_packed(packed, tmp_path / "cache") == [library]
    assert library.stat().st_mtime_ns == written
    assert [p.name for p in (tmp_path / "cache").iterdir()] == [NAME]  # nothing half done beside it


def test_no_room_is_a_sentence(packed: Path, tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file where the folder should be")
    with pytest.raises(OutputError, match=r"cannot be unpacked into .*free 400 MB"):
        link_packed(packed, tmp_path / "cache")


def test_a_failed_unpacking_leaves_nothing(packed: Path, tmp_path: Path, monkeypatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(packed_libraries.os, "replace", full)
    with pytest.raises(OutputError, match="No space left"):
        link_packed(packed, tmp_path / "cache")
    assert list((tmp_path / "cache").iterdir()) == []


def test_libraries_are_linked_when_their_package_is_imported(
    packed: Path, tmp_path: Path, monkeypatch
) -> None:
    cache = tmp_path / "cache"
    monkeypatch.setattr(packed_libraries, "user_cache", lambda: cache)
    finder = LinkBeforeImport(packed.parent)
    assert finder.find_spec("another", None) is None
    assert not cache.exists()
    assert finder.find_spec("things", None) is None
    assert (cache / NAME).is_dir()
    shutil.rmtree(cache)
    assert finder.find_spec("things", None) is None  # a package that imports itself once more
    assert not cache.exists()


def test_a_packed_extension_is_found_when_its_package_asks_again(tmp_path: Path, monkeypatch) -> None:
    import cv2  # its package imports itself, and expects the extension

    extension = next(Path(cv2.__file__).parent.glob("cv2.*.so"))
    (tmp_path / "cache" / "cv2-0123456789ab").mkdir(parents=True)
    (tmp_path / "cache" / "cv2-0123456789ab" / extension.name).touch()
    (tmp_path / f"cv2-0123456789ab{PACKED}").touch()
    monkeypatch.setattr(packed_libraries, "user_cache", lambda: tmp_path / "cache")
    finder = LinkBeforeImport(tmp_path)
    assert finder.find_spec("cv2", None) is None
    found = finder.find_spec("cv2", None)
    assert found is not None and found.origin == str(tmp_path / "cache" / "cv2-0123456789ab" / extension.name)
    assert finder.find_spec("cv2", None) is None


def test_where_nothing_is_packed_nothing_happens(tmp_path: Path) -> None:
    assert LinkBeforeImport(tmp_path / "packed").find_spec("things", None) is None
