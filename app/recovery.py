"""After a crash nothing is lost: the document is kept on the disk, and offered at the next start. No Qt.

Each running program holds a lock on a file of its own in the user's state folder; beside it lies its
autosave, a project file, whenever closing would lose something. A lock that nobody holds any more belongs to
a program that crashed: its autosave is what can be recovered. Files are written by a thread of their own, so
that no disk makes the window wait.
"""

from __future__ import annotations

import json
import os
import threading
import time
import uuid
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from floorplan_core.errors import FloorPlanError
from floorplan_core.files import STAGING_PREFIX
from floorplan_core.process_ids import is_running
from floorplan_core.project_file import SUFFIX, load, save, write_whole

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench
    from floorplan_core.project_file import Project

FOLDER_VARIABLE = "FLOORCAST_STATE"  # another place for the state folder
_LOCK, _NOTE = ".lock", ".json"


@dataclass(frozen=True)
class Recoverable:
    """The document of a program that crashed."""

    autosave: Path
    title: str  # the name of the project or of the survey
    project: Path | None  # where it had been saved; None: nowhere
    when: float  # seconds since the epoch, of the last change that was kept


class Recovery:
    """Keeps the workbench's document as long as closing would lose something."""

    def __init__(self, workbench: Workbench, folder: Path | None = None) -> None:
        self._workbench = workbench
        self._folder = folder or state_folder()
        self._name = f"{os.getpid()}-{uuid.uuid4().hex[:8]}"
        self._lock: IO[str] | None = None
        self._view_moved = False
        self._writer = _Writer()
        workbench.document.changed.connect(lambda before, after: self.keep())
        workbench.document.saved_changed.connect(self.keep)
        workbench.view.changed.connect(lambda before, after: self._note_view())

    @property
    def autosave(self) -> Path:
        """Where this program keeps its document."""
        return self._folder / f"{self._name}{SUFFIX}"

    def keep(self) -> None:
        """Keep the document as it is now; at each change. What was saved needs no keeping."""
        self._view_moved = False
        if not self._workbench.has_edits:
            self._writer.hand_over(lambda: _remove(self.autosave))
            return
        form, note = self._workbench.saved_form(), self._note()
        self._writer.hand_over(lambda: self._write(form, note))

    def tick(self) -> None:
        """To be called now and then: keeps what is no edit, like the view."""
        if self._view_moved:
            self.keep()

    def flush(self) -> None:
        """Wait until all is on the disk."""
        self._writer.flush()

    def close(self) -> None:
        """The program ends in good order: nothing is left to recover."""
        self._writer.stop()
        _remove(self.autosave)
        if self._lock is not None:
            self._lock.close()
            self._lock = None
            self.autosave.with_suffix(_LOCK).unlink(missing_ok=True)

    def _note_view(self) -> None:
        self._view_moved = True

    def _note(self) -> dict[str, Any]:
        survey, project = self._workbench.state.survey, self._workbench.project
        title = project.stem if project else survey.path.name if survey else "Untitled"
        return {"title": title, "project": None if project is None else str(project), "when": time.time()}

    def _write(self, form: Project, note: dict[str, Any]) -> None:
        self._hold()
        save(self.autosave, form, take_digest=False)  # at every change: a large folder takes a while
        write_whole(self.autosave.with_suffix(_NOTE), json.dumps(note).encode())

    def _hold(self) -> None:
        """Take the lock, once there is something to lock."""
        if self._lock is None:
            self._folder.mkdir(parents=True, exist_ok=True)
            self._lock = self.autosave.with_suffix(_LOCK).open("a+", encoding="utf-8")
            _try_lock(self._lock)
            self._lock.write(str(os.getpid()))
            self._lock.flush()


def recoverable(folder: Path | None = None) -> list[Recoverable]:
    """What programs that crashed left behind, newest first."""
    folder = folder or state_folder()
    _forget_beginnings(folder)
    found = [_described(path) for path in folder.glob(f"*{SUFFIX}")]
    return sorted((r for r in found if r is not None), key=lambda r: -r.when)


def restore(workbench: Workbench, item: Recoverable) -> None:
    """Go on with a document that was left behind; it counts as not saved.

    :raises InputError: where it cannot be read; it is still there then.
    """
    workbench.open_loaded(load(item.autosave), item.project, f"Recover {item.title}", saved=False)


def discard(item: Recoverable) -> None:
    """Forget a document that was left behind."""
    _remove(item.autosave)
    item.autosave.with_suffix(_LOCK).unlink(missing_ok=True)


def state_folder() -> Path:
    """The user's folder for what a program keeps from one start to the next."""
    given = os.environ.get(FOLDER_VARIABLE)
    if given:
        return Path(given)
    import platformdirs

    return Path(platformdirs.user_state_dir("floorcast", appauthor=False)) / "recovery"


def _described(path: Path) -> Recoverable | None:
    """What lies at ``path``; None where its program still runs, or nothing can be read."""
    if _is_held(path.with_suffix(_LOCK)):
        return None
    try:
        note = json.loads(path.with_suffix(_NOTE).read_text(encoding="utf-8"))
        project = None if note["project"] is None else Path(note["project"])
        return Recoverable(path, str(note["title"]), project, float(note["when"]))
    except (OSError, ValueError, KeyError, TypeError):
        try:
            return Recoverable(path, path.stem, None, path.stat().st_mtime)
        except OSError:
            return None


def _remove(autosave: Path) -> None:
    parts = autosave.parent.glob(f"{STAGING_PREFIX}{autosave.stem}*")  # of a save that was never done
    for path in (autosave, autosave.with_suffix(_NOTE), *parts):
        path.unlink(missing_ok=True)


def _forget_beginnings(folder: Path) -> None:
    """Remove what programs left that were killed before they had kept anything."""
    for lock in folder.glob(f"*{_LOCK}"):
        autosave = lock.with_suffix(SUFFIX)
        try:
            pid = lock.read_text(encoding="utf-8").strip()
            if pid.isdecimal() and not is_running(int(pid)) and not autosave.exists():
                _remove(autosave)
                lock.unlink(missing_ok=True)
        except (OSError, ValueError):
            continue


def _is_held(lock: Path) -> bool:
    """True where a running program has the lock: the system frees it when a program dies."""
    try:
        with lock.open("r+", encoding="utf-8") as handle:
            free = _try_lock(handle)
            if free is None:
                text = handle.read().strip()
                return text.isdecimal() and is_running(int(text))
            return not free
    except OSError:
        return False


def _try_lock(handle: IO[str]) -> bool | None:
    """True: locked for this program now; False: another one has it; None: this system has no locks."""
    try:
        import fcntl
    except ImportError:
        return None
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


class _Writer:
    """Does the latest of the tasks handed over, in a thread; tasks that were overtaken are left out."""

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._task: Any = None
        self._busy = self._stopped = False
        self._thread: threading.Thread | None = None

    def hand_over(self, task: Any) -> None:
        with self._condition:
            if self._stopped:
                return
            self._task = task
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, daemon=True, name="autosave")
                self._thread.start()
            self._condition.notify_all()

    def flush(self) -> None:
        with self._condition:
            self._condition.wait_for(lambda: self._task is None and not self._busy)

    def stop(self) -> None:
        """Drop what waits, and let the thread end."""
        with self._condition:
            self._task, self._stopped = None, True
            self._condition.notify_all()
        if self._thread is not None:
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._task is not None or self._stopped)
                if self._stopped:
                    return
                task, self._task, self._busy = self._task, None, True
            try:
                task()
            except (OSError, FloorPlanError):
                pass  # a full disk must not take the program down; the next change tries again
            finally:
                with self._condition:
                    self._busy = False
                    self._condition.notify_all()
