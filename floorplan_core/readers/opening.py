"""Open a survey: look at what the path really is, find the reader by content, say clearly what is wrong."""

from __future__ import annotations

import stat
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from floorplan_core.config import InputConfig
from floorplan_core.errors import FloorPlanError, InputError
from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import Reader, ReadOptions
from floorplan_core.readers.ahead import RelayedObserver, read_ahead
from floorplan_core.readers.identify import identify
from floorplan_core.readers.joining import join_surveys, open_alike
from floorplan_core.readers.source import CHUNK_POINTS
from floorplan_core.readers.trajectory import looks_like_trajectory

if TYPE_CHECKING:
    from floorplan_core.plugins import PluginRegistry

HEAD_BYTES = 4096


def builtin_readers() -> tuple[Reader, ...]:
    """The readers of the formats that need nothing but numpy."""
    from floorplan_core.readers.npz import NpzReader
    from floorplan_core.readers.pcd import PcdReader
    from floorplan_core.readers.ply import PlyReader
    from floorplan_core.readers.ptx import PtxReader
    from floorplan_core.readers.scans import ScanFolderReader
    from floorplan_core.readers.text import TextReader

    return (PlyReader(), PcdReader(), NpzReader(), ScanFolderReader(), PtxReader(), TextReader())


def open_survey(
    path: Path | str | Sequence[Path | str],
    trajectory: Path | str | None = None,
    config: InputConfig | None = None,
    observer: Observer | None = None,
    registry: PluginRegistry | None = None,
    colours: bool = True,
) -> Reconstruction:
    """Open a file or folder with the reader that knows its content best; several of them as one survey.

    ``trajectory`` names the poses where they do not lie beside the cloud. Without ``colours`` those and
    intensities are not read where that saves time: a plan needs none. Raises :class:`InputError` with
    one sentence for anything that cannot be read or is not what it claims.
    """
    paths = [Path(path)] if isinstance(path, str | Path) else [Path(p) for p in path]
    given = None if trajectory is None else Path(trajectory)
    if given is not None:
        check_is_file(given, "trajectory")
    observer = RelayedObserver(observer or Observer())
    readers = registry.readers if registry is not None and registry.readers else builtin_readers()
    files = [file for p in expand_patterns(paths) for file in clouds_at(p, readers)]

    def open_one(number: int, settings: InputConfig) -> Reconstruction:
        return _open_file(files[number], ReadOptions(settings, given, colours), observer, readers)

    if len(files) == 1:
        opened = _ahead(open_one(0, config or InputConfig()), observer)
    else:
        surveys = open_alike(len(files), config or InputConfig(), open_one)
        opened = join_surveys(surveys, given is not None, observer)
    if len(paths) == 1 and paths[0].is_dir():
        opened = replace(opened, name=paths[0].resolve().name)  # says more than points.ply
    said = tuple(map(printable, opened.assumptions))
    return replace(opened, name=printable(opened.name), assumptions=said)


def printable(text: str) -> str:
    """``text`` as every file can hold it: names of files may be no UTF-8, and may hold line ends."""
    return " ".join(text.encode("utf-8", "replace").decode("utf-8").splitlines())


def _ahead(survey: Reconstruction, observer: Observer) -> Reconstruction:
    """The same survey, whose chunks are read while those before are used; a single chunk needs no thread."""
    if survey.point_count is not None and survey.point_count <= CHUNK_POINTS:
        return survey
    return replace(survey, chunks=lambda: (chunk for _, chunk in read_ahead([survey.chunks], observer)))


def _open_file(
    path: Path, options: ReadOptions, observer: Observer, readers: Sequence[Reader]
) -> Reconstruction:
    """One file, or a folder that is one survey."""
    reader = choose_reader(path, read_head(path), readers)
    try:
        opened = reader.open(path, options, observer)
    except FloorPlanError:
        raise
    except OSError as error:
        raise InputError(f"Cannot read {path.name}: {error.strerror or error}.") from error
    except (ValueError, MemoryError, OverflowError) as error:
        raise InputError(f"{path.name} is damaged ({reader.name}: {str(error)[:120]}).") from error
    return replace(opened, assumptions=(*_mislabelled(path, reader, readers), *opened.assumptions))


def expand_patterns(paths: Sequence[Path]) -> list[Path]:
    """Paths with ``*``, ``?`` or ``[...]`` become the files that fit, by name; others stay as they are."""
    expanded: list[Path] = []
    for path in paths:
        if not set("*?[") & set(str(path)) or path.exists():
            expanded.append(path)
            continue
        from glob import glob

        found = sorted(glob(str(path)))
        if not found:
            raise InputError(f"No file fits the pattern {path}.")
        expanded += [Path(f) for f in found]
    if not expanded:
        raise InputError("No input was named.")
    return expanded


def clouds_at(path: Path, readers: Sequence[Reader]) -> list[Path]:
    """``path`` itself, or the point clouds in it where it is a folder of such."""
    head = read_head(path)
    return (
        [path]
        if head or any(reader.sniff(path, head) > 0 for reader in readers)
        else find_clouds(path, readers)
    )


def choose_reader(path: Path, head: bytes, readers: Sequence[Reader]) -> Reader:
    """The reader that is surest; the first of them where two are. :class:`InputError` where none is."""
    scores = [reader.sniff(path, head) for reader in readers]
    best = max(range(len(readers)), key=lambda k: scores[k], default=-1)
    if best < 0 or scores[best] <= 0:
        raise InputError(_why_not(path, head, readers))
    return readers[best]


def find_clouds(folder: Path, readers: Sequence[Reader]) -> list[Path]:
    """The point clouds in a folder, parts of one survey; :class:`InputError` where they are no such."""
    suffixes = {suffix for reader in readers for suffix in reader.suffixes}
    try:
        files = [f for f in sorted(folder.iterdir()) if f.suffix.lower() in suffixes and f.is_file()]
    except OSError as error:
        raise InputError(f"Cannot read the folder {folder.name}: {error.strerror or error}.") from error
    clouds = [f for f in files if not looks_like_trajectory(f) and _is_readable(f, readers)]
    named = [f for f in clouds if f.stem == "points"]
    if len(clouds) == 1 or len(named) == 1:
        return named or clouds
    name = folder.name or str(folder)
    if not clouds:
        raise InputError(
            f"The folder {name} holds no scans (numbered point clouds like 000000.ply) and no point cloud."
        )
    if _are_versions(clouds):
        listed = ", ".join(f.name for f in clouds[:5]) + (", …" if len(clouds) > 5 else "")
        raise InputError(
            f"The folder {name} holds {len(clouds)} versions of a point cloud ({listed}); name one of them."
        )
    return clouds


def _are_versions(clouds: Sequence[Path]) -> bool:
    """True where the names say: one cloud in several formats (a.las, a.e57), or points2d and points3d."""
    stems = [f.stem.lower() for f in clouds]
    return len(set(stems)) < len(stems) or all(stem.startswith("points") for stem in stems)


def _is_readable(path: Path, readers: Sequence[Reader]) -> bool:
    try:
        head = read_head(path)
    except InputError:
        return False
    return any(reader.sniff(path, head) > 0 for reader in readers)


def read_head(path: Path) -> bytes:
    """The first bytes of a file, b"" for a folder; :class:`InputError` for what is neither."""
    name = path.name or str(path)
    if check_is_file(path, "input", folder=True):
        return b""
    try:
        with path.open("rb") as handle:
            head = handle.read(HEAD_BYTES)
    except OSError as error:
        raise InputError(f"Cannot read {name}: {error.strerror or error}.") from error
    if not head:
        raise InputError(f"{name} is empty.")
    return head


def check_is_file(path: Path, role: str, folder: bool = False) -> bool:
    """True for a folder (where one may be), False for a file; :class:`InputError` for anything else."""
    name = path.name or str(path)
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        what = "is a link to something that does not exist" if path.is_symlink() else "does not exist"
        raise InputError(f"The {role} {path} {what}.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"Cannot read the {role} {name}: {reason}.") from error
    if stat.S_ISDIR(mode) and folder:
        return True
    if not stat.S_ISREG(mode):
        raise InputError(f"The {role} {name} is {_kind(mode)}, not a file.")
    return False


def _kind(mode: int) -> str:
    kinds = (
        (stat.S_ISDIR, "a folder"),
        (stat.S_ISFIFO, "a pipe"),
        (stat.S_ISSOCK, "a socket"),
        (stat.S_ISCHR, "a device"),
        (stat.S_ISBLK, "a device"),
    )
    return next((name for test, name in kinds if test(mode)), "something else")


def _why_not(path: Path, head: bytes, readers: Sequence[Reader]) -> str:
    known = ", ".join(reader.name for reader in readers)
    what = identify(head, path)
    if what:
        return f"{path.name} is {what}; readable are: {known}."
    claims = [r.name for r in readers if path.suffix.lower() in r.suffixes]
    if claims:
        return f"{path.name} claims to be {claims[0]} but its content is not; it may be damaged or misnamed."
    return f"{path.name} is not a point cloud that Floorcast knows; readable are: {known}."


def _mislabelled(path: Path, reader: Reader, readers: Sequence[Reader]) -> tuple[str, ...]:
    suffix = path.suffix.lower()
    if path.is_dir() or suffix in reader.suffixes:
        return ()
    named = [other for other in readers if suffix in other.suffixes]
    if not named or any(other.sniff(path, read_head(path)) > 0 for other in named):  # a mesh in a PLY
        return ()
    return (
        f"{path.name} is named like a {named[0].name} file but holds {reader.name}; it was read as that.",
    )
