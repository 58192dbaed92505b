"""``.floorcast``: what a person decided about a survey, without the survey itself.

A zip with ``project.json`` (inputs by reference, settings, corrections, checks, view) and, where there is
one, ``thumbnail.png``. An input is referenced by its path relative to the project, if it lies beside or below
it, and by its absolute path; moved together, or alone, it is found again. Saving replaces the file in one
step; killed at any moment, the disk holds the old project or the new one. Reading executes nothing, writes
nothing and refuses what is damaged with one sentence.
"""

from __future__ import annotations

import io
import json
import os
import struct
import zipfile
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from floorplan_core.config import Config
from floorplan_core.corrections_json import from_json, number, point, text, to_json
from floorplan_core.digest import digest
from floorplan_core.errors import InputError, UsageError
from floorplan_core.files import STAGING_PREFIX, output_error
from floorplan_core.model.corrections import Correction, Point
from floorplan_core.process_ids import is_running

__all__ = ["SUFFIX", "Project", "digest", "load", "read_thumbnail", "save"]

SUFFIX = ".floorcast"
FORMAT, VERSION = "floorcast project", 1
_TREE, _THUMBNAIL = "project.json", "thumbnail.png"
_EPOCH = (1980, 1, 1, 0, 0, 0)  # no time stamps: the same project gives the same bytes
_MOST_BYTES = {_TREE: 2**27, _THUMBNAIL: 2**24}  # larger members are bombs
_LONGEST_PATH = 4096
_MOST_STOREYS = 1000  # no building has more
_DAMAGE = (
    ValueError,
    KeyError,
    EOFError,
    OverflowError,
    NotImplementedError,
    RecursionError,
    RuntimeError,
    struct.error,
    zipfile.BadZipFile,
    zlib.error,
)

Json = dict[str, Any]
Survey = tuple[Path, Path | None, str]  # input, trajectory, digest of the input ("": not known)
StoreyEdits = tuple[int, tuple[Correction, ...], tuple[Json, ...]]  # storey, its corrections, its checks


@dataclass(frozen=True)
class Project:
    """Everything that a project file holds, and what was found wrong when it was read."""

    survey: Survey | None = None
    config: Config = field(default_factory=Config)
    corrections: tuple[Correction, ...] = ()
    # Each with id, start, end (metres, local frame), measured (metres or None) and note:
    checks: tuple[Json, ...] = ()
    view: Json = field(default_factory=dict)  # how things are looked at; any JSON values
    # World metres of what corrections and checks are relative to; None: of the survey's own local frame
    origin: Point | None = None
    names: tuple[tuple[str, str, str], ...] = ()  # of regions: see PlanningSession.names
    storey: int = 0  # the one that is shown, which corrections and checks belong to; 0 is the lowest
    elsewhere: tuple[StoreyEdits, ...] = ()  # of the other storeys
    missing: tuple[Path, ...] = ()  # inputs that are not where they were
    notes: tuple[str, ...] = ()  # sentences: what is not as it was saved


def save(path: Path, project: Project, thumbnail: bytes | None = None, take_digest: bool = True) -> None:
    """Write ``project`` to ``path``, whole or not at all.

    :param thumbnail: a small PNG of the plan, for the list of recent projects.
    :param take_digest: look at the input as it is now; False: keep the digest that is known.
    :raises OutputError: where it cannot be written; what was there stays.
    """
    path = Path(os.path.realpath(path))  # through a link: the file, not the link, is replaced
    tree = json.dumps(_tree(project, path.parent, take_digest), ensure_ascii=False, allow_nan=False, indent=1)
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        _add(archive, _TREE, tree.encode())
        if thumbnail:
            _add(archive, _THUMBNAIL, thumbnail)
    write_whole(path, buffer.getvalue())


def load(path: Path) -> Project:
    """Read a project; what has moved or changed since is said in ``missing`` and ``notes``.

    :raises InputError: where the file is no project, or a damaged one.
    """
    try:
        tree = json.loads(_member(path, _TREE), parse_constant=_no_constant)
        if not isinstance(tree, dict) or tree.get("format") != FORMAT:
            raise ValueError("it is another kind of file")
        if tree.get("version") != VERSION:
            raise ValueError(f"its version is {str(tree.get('version'))[:20]}, this program reads {VERSION}")
        return _project(tree, Path(os.path.abspath(path)).parent)
    except InputError as error:
        raise InputError(f"{path.name} is a damaged project: {error}") from error
    except (UsageError, TypeError, *_DAMAGE) as error:
        why = " ".join(str(error).split())[:200] or type(error).__name__
        raise InputError(f"{path.name} is not an undamaged Floorcast project ({why}).") from error
    except OSError as error:
        raise InputError(f"Cannot read {path}: {(error.strerror or str(error)).lower()}.") from error


def read_thumbnail(path: Path) -> bytes | None:
    """The PNG in a project file; None where it has none or cannot be read."""
    try:
        return _member(path, _THUMBNAIL)
    except (OSError, *_DAMAGE):
        return None


# ---- writing ------------------------------------------------------------------------------------------


def write_whole(path: Path, data: bytes) -> None:
    """Put ``data`` on the disk under a hidden name, then rename: a crash leaves the old file or the new one.

    :raises OutputError: where that fails; the old file stays.
    """
    part = path.with_name(f"{STAGING_PREFIX}{path.name}-{os.getpid()}.part")
    try:
        _forget_parts(path)
        with part.open("wb") as handle:
            handle.write(data)
            handle.flush()
            os.fsync(handle.fileno())
        os.replace(part, path)
        _sync_folder(path.parent)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise output_error(error, path) from error


def _forget_parts(path: Path) -> None:
    """Remove what earlier programs left that were killed while they saved this file."""
    for part in path.parent.glob(f"{STAGING_PREFIX}{path.name}-*.part"):
        pid = part.name.removesuffix(".part").rpartition("-")[2]
        if pid.isdecimal() and not is_running(int(pid)):
            part.unlink(missing_ok=True)


def _sync_folder(folder: Path) -> None:
    """Make the new name last through a power cut, where the system can."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _add(archive: zipfile.ZipFile, name: str, data: bytes) -> None:
    archive.writestr(zipfile.ZipInfo(name, _EPOCH), data, zipfile.ZIP_DEFLATED)


def _tree(project: Project, folder: Path, take_digest: bool) -> Json:
    from floorplan_core import __version__

    return {
        "format": FORMAT,
        "version": VERSION,
        "program": __version__,
        "survey": None if project.survey is None else _survey_json(project.survey, folder, take_digest),
        "origin": None if project.origin is None else list(project.origin),
        "names": [list(n) for n in project.names],
        "config": project.config.model_dump(mode="json"),
        "corrections": to_json(project.corrections),
        "checks": [dict(c) for c in project.checks],
        "storey": project.storey,
        "storeys": [
            {"storey": number, "corrections": to_json(said), "checks": [dict(c) for c in checks]}
            for number, said, checks in project.elsewhere
        ],
        "view": project.view,
    }


def _survey_json(survey: Survey, folder: Path, take_digest: bool) -> Json:
    path, trajectory, known = survey
    return {
        **_path_json(path, folder),
        "trajectory": None if trajectory is None else _path_json(trajectory, folder),
        "digest": (digest(path) if take_digest else "") or known,
    }


def _path_json(path: Path, folder: Path) -> Json:
    absolute = Path(os.path.abspath(path))
    near = absolute.is_relative_to(folder) or absolute.is_relative_to(folder.parent)
    return {
        "absolute": str(absolute),
        "relative": Path(os.path.relpath(absolute, folder)).as_posix() if near else None,
    }


# ---- reading ------------------------------------------------------------------------------------------


def _member(path: Path, name: str) -> bytes:
    with zipfile.ZipFile(path) as archive:
        try:
            size = archive.getinfo(name).file_size
        except KeyError:
            raise ValueError(f"it has no {name}") from None
        if size > _MOST_BYTES[name]:
            raise ValueError(f"{name} claims {size} bytes")
        return archive.read(name)


def _no_constant(name: str) -> float:
    raise ValueError(f"it holds {name}")


def _project(tree: Json, folder: Path) -> Project:
    survey, missing, notes = _survey(tree.get("survey"), folder)
    config, unknown = _config(tree.get("config", {}))
    view = tree.get("view", {})
    if not isinstance(view, dict):
        raise ValueError("its view is not a table")
    origin = tree.get("origin")
    return Project(
        survey,
        config,
        from_json(tree.get("corrections", [])),
        _checks(tree.get("checks", [])),
        view,
        None if origin is None else point(origin),
        _names(tree.get("names", [])),
        _storey(tree.get("storey", 0)),
        _elsewhere(tree.get("storeys", [])),
        missing,
        (*notes, *unknown),
    )


def _survey(data: Any, folder: Path) -> tuple[Survey | None, tuple[Path, ...], tuple[str, ...]]:
    """The inputs where they are now, those that are gone, and what else is to say."""
    if data is None:
        return None, (), ()
    if not isinstance(data, dict) or not isinstance(data.get("digest", ""), str):
        raise ValueError("its survey is damaged")
    path = _found(data, folder)
    trajectory = None if data.get("trajectory") is None else _found(data["trajectory"], folder)
    missing = tuple(p for p in (path, trajectory) if p is not None and not p.exists())
    known = data.get("digest", "")
    changed = known and path not in missing and digest(path) != known
    note = (f"{path.name} is not the same as when this project was saved; check the corrections.",)
    return (path, trajectory, known), missing, note if changed else ()


def _found(data: Any, folder: Path) -> Path:
    """Beside the project, or where it was; where it was if it is nowhere."""
    if not isinstance(data, dict):
        raise ValueError("a path is damaged")
    absolute = Path(_checked_path(data.get("absolute")))
    if data.get("relative") is not None:
        beside = Path(os.path.normpath(folder / _checked_path(data["relative"])))
        if beside.exists():
            return beside
    return absolute


def _checked_path(data: Any) -> str:
    if not isinstance(data, str) or not 0 < len(data) <= _LONGEST_PATH or "\0" in data:
        raise ValueError("a path is damaged")
    return data


def _config(data: Any) -> tuple[Config, tuple[str, ...]]:
    """The settings; those that this version does not know are left out, and named."""
    if not isinstance(data, dict) or not all(isinstance(v, dict) for v in data.values()):
        raise ValueError("its settings are damaged")
    known = Config().model_dump()
    kept = {
        s: {n: v for n, v in values.items() if n in known.get(s, {})}
        for s, values in data.items()
        if s in known
    }
    gone = [f"{s}.{n}" for s, values in data.items() for n in values if n not in known.get(s, {})]
    names = ", ".join(gone[:5]) + (", …" if len(gone) > 5 else "")
    note = (f"This version of Floorcast has no setting {names}; the project goes on without.",)
    return Config.from_dict(kept), note if gone else ()


def _checks(data: Any) -> tuple[Json, ...]:
    if not isinstance(data, Sequence) or isinstance(data, str):
        raise ValueError("its checks are not a list")
    return tuple(_check(c) for c in data)


def _storey(data: Any) -> int:
    if not isinstance(data, int) or isinstance(data, bool) or not 0 <= data < _MOST_STOREYS:
        raise ValueError("a storey is not a number from 0")
    return data


def _elsewhere(data: Any) -> tuple[StoreyEdits, ...]:
    if not isinstance(data, list) or not all(isinstance(entry, dict) for entry in data):
        raise ValueError("its storeys are not a list")
    found = {
        _storey(entry.get("storey")): (
            from_json(entry.get("corrections", [])),
            _checks(entry.get("checks", [])),
        )
        for entry in data
    }
    return tuple((number, *found[number]) for number in sorted(found))


def _check(data: Any) -> Json:
    if not isinstance(data, dict):
        raise ValueError("a check is damaged")
    measured = data.get("measured")
    return {
        "id": text(data["id"]),
        "start": point(data["start"]),
        "end": point(data["end"]),
        "measured": None if measured is None else number(measured),
        "note": text(data.get("note", "")),
    }


def _names(data: Any) -> tuple[tuple[str, str, str], ...]:
    if not isinstance(data, list) or not all(isinstance(n, list) and len(n) == 3 for n in data):
        raise ValueError("its names of regions are damaged")
    if not all(isinstance(outline, str) for *_, outline in data):
        raise ValueError("the outline of a region is damaged")
    return tuple((text(ident), text(name), outline) for ident, name, outline in data)
