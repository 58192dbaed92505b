"""A ROS recording (rosbags): ROS 1 bags, ROS 2 folders, single MCAP and SQLite files; without ROS."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from floorcast_plugins._bounded import bound_rosbags
from floorplan_core.api import damaged, import_library

PACKAGE = "rosbags"
SQLITE, MCAP, ROS1 = b"SQLite format 3\x00", b"\x89MCAP", b"#ROSBAG V"


def is_recording(path: Path, head: bytes) -> bool:
    """True for the first bytes of a recording, or for a folder of ROS 2."""
    if not head:
        return path.is_dir() and (path / "metadata.yaml").is_file() and _holds_storage(path)
    return head.startswith((MCAP, ROS1)) or (head.startswith(SQLITE) and path.suffix.lower() == ".db3")


def _holds_storage(folder: Path) -> bool:
    with (folder / "metadata.yaml").open("rb") as handle:
        return b"rosbag2_bagfile_information" in handle.read(4096)


@contextmanager
def opened(path: Path, types: Any = None) -> Iterator[Any]:
    """rosbags' reader; what it raises over the recording is one sentence.

    ``types``: the ``typestore`` of an earlier reader of the same recording, so that the definitions of its
    messages are compiled once.
    """
    import_library("rosbags.highlevel", PACKAGE, "ROS bags")
    bound_rosbags()
    with damaged(path.name, "ROS recording", _advice(path)), _reader(path, types) as reader:
        yield reader


def _advice(path: Path) -> str:
    """What mends a recording that was cut off, where its recorder crashed or still writes."""
    if path.is_dir():
        return ""
    with path.open("rb") as handle:
        head = handle.read(len(SQLITE))
    known = ((ROS1, "rosbag reindex"), (MCAP, "mcap recover"), (SQLITE, "sqlite3's .recover"))
    tools = [tool for start, tool in known if head.startswith(start)]
    return f"; {tools[0]} mends one that was cut off" if tools else ""


def _reader(path: Path, types: Any) -> Any:
    """By content: rosbags itself goes by the suffix, and wants the folder of a file of ROS 2."""
    from rosbags.highlevel import AnyReader
    from rosbags.rosbag1 import Reader as Reader1
    from rosbags.rosbag2 import Reader as Reader2
    from rosbags.typesys import Stores, get_typestore

    class ByContent(AnyReader):
        """rosbags' own, over a reader that is chosen already."""

        def __init__(self, reader: Any, is2: bool) -> None:
            self.paths, self.is2, self.stack, self.connections = [path], is2, None, []
            self.default_typestore = get_typestore(Stores.ROS2_HUMBLE if is2 else Stores.ROS1_NOETIC)
            self.typestore = get_typestore(Stores.EMPTY)
            self.readers = [reader]

        def _open(self) -> None:
            if types is None:
                super()._open()
                return
            for reader in self.readers:
                self.stack.enter_context(reader)
            self.connections = [c for reader in self.readers for c in reader.connections]
            self.typestore = types

    if path.is_dir():
        return ByContent(Reader2(path), True)
    with path.open("rb") as handle:
        head = handle.read(len(SQLITE))
    if head.startswith(ROS1):
        return ByContent(Reader1(path), False)
    return ByContent(_SingleFile(path, head.startswith(MCAP)), True)


class _SingleFile:
    """One storage file of ROS 2 without the folder and its metadata."""

    def __init__(self, path: Path, mcap: bool) -> None:
        from rosbags.rosbag2.storage_mcap import McapReader
        from rosbags.rosbag2.storage_sqlite3 import Sqlite3Reader

        self._storage: Any = McapReader(path) if mcap else Sqlite3Reader(path)

    @property
    def connections(self) -> Any:
        """Topics with their definitions."""
        return self._storage.connections

    def __enter__(self) -> _SingleFile:
        self._storage.open()
        return self

    def __exit__(self, *_: object) -> None:
        self._storage.close()
