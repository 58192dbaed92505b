"""The document survives a crash; a program that ends well, or still runs, leaves nothing to recover."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from floorcast_app.recovery import Recovery, discard, recoverable, restore
from floorcast_app.state import Check
from floorplan_core.model.corrections import NameRegion
from tests.app.pump import SAMPLE, make_workbench, settle

CHECK = Check("c1", (0.0, 0.0), (1.0, 0.0), 1.002)

CRASHER = """
import os, signal, sys
from dataclasses import replace
from pathlib import Path
from floorcast_app.recovery import Recovery
from floorcast_app.state import Check, DocumentState
from floorcast_app.jobs import immediately
from floorcast_app.workbench import Workbench
from floorplan_core.model.corrections import NameRegion

workbench = Workbench(lambda function: None)
workbench.read_and_plan = lambda: None
workbench.replan = lambda: None
recovery = Recovery(workbench, Path(sys.argv[1]))
workbench.open_survey(Path(sys.argv[2]))
for k in range(20):
    workbench.correct("Rename", NameRegion((float(k), 0.0), f"room {k}"))
workbench.change("Add check", checks=(Check("c1", (0.0, 0.0), (1.0, 0.0), 1.002),))
recovery.flush()
print("kept", flush=True)
if sys.argv[3] == "crash":
    os.kill(os.getpid(), signal.SIGKILL)
elif sys.argv[3] == "wait":
    sys.stdin.read()
recovery.close()
"""


def _run(folder: Path, how: str) -> subprocess.Popen[str]:
    process = subprocess.Popen(
        [sys.executable, "-c", CRASHER, str(folder), str(SAMPLE), how],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "kept\n"
    return process


@pytest.fixture
def quiet():
    """A workbench that plans nothing: only its document counts here."""
    workbench = make_workbench()
    workbench.read_and_plan = lambda: None  # type: ignore[method-assign]
    workbench.replan = lambda: None  # type: ignore[method-assign]
    return workbench


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill without warning")
def test_after_a_crash_the_document_is_offered(tmp_path, quiet):
    """All of it comes back, as not saved; once discarded it is gone."""
    _run(tmp_path, "crash").wait()
    (item,) = recoverable(tmp_path)
    assert item.title == SAMPLE.name
    assert item.project is None
    restore(quiet, item)
    assert [c.name for c in quiet.state.corrections if isinstance(c, NameRegion)] == [
        f"room {k}" for k in range(20)
    ]
    assert quiet.state.checks == (CHECK,)
    assert quiet.state.survey is not None
    assert quiet.state.survey.path == SAMPLE
    assert quiet.document.dirty
    discard(item)
    assert list(tmp_path.iterdir()) == []


def test_a_program_that_runs_or_ended_well_is_not_offered(tmp_path):
    process = _run(tmp_path, "wait")
    assert recoverable(tmp_path) == []
    process.communicate("")
    assert process.returncode == 0
    assert recoverable(tmp_path) == []
    assert list(tmp_path.iterdir()) == []


def test_saving_ends_the_need(tmp_path, quiet):
    """A saved document is not kept twice; the next change is kept again, and knows its project."""
    recovery = Recovery(quiet, tmp_path / "state")
    quiet.open_survey(SAMPLE)
    recovery.flush()
    assert not recovery.autosave.exists()  # opening alone is nothing to lose
    quiet.change("Add check", checks=(CHECK,))
    recovery.flush()
    assert recovery.autosave.exists()
    quiet.save_project(tmp_path / "house.floorcast")
    recovery.flush()
    assert not recovery.autosave.exists()
    quiet.change("Remove check", checks=())
    recovery.flush()
    assert recovery.autosave.exists()
    assert recoverable(tmp_path / "state") == []  # its program runs: this one
    recovery._lock.close()  # as if it had died
    (item,) = recoverable(tmp_path / "state")
    assert item.project == tmp_path / "house.floorcast"
    recovery.close()


def test_the_view_is_kept_at_the_next_tick(tmp_path, quiet):
    recovery = Recovery(quiet, tmp_path)
    quiet.open_survey(SAMPLE)
    quiet.change("Add check", checks=(CHECK,))
    recovery.flush()
    before = recovery.autosave.read_bytes()
    quiet.view.set(span=7.25)
    recovery.flush()
    assert recovery.autosave.read_bytes() == before
    recovery.tick()
    recovery.flush()
    assert recovery.autosave.read_bytes() != before
    recovery.close()


def test_damaged_leftovers_do_no_harm(tmp_path):
    """A note that is damaged costs the title only; a project that is, the offer to restore it."""
    (tmp_path / "1-a.floorcast").write_bytes(b"no zip")
    (tmp_path / "1-a.json").write_text("{", encoding="utf-8")
    (item,) = recoverable(tmp_path)
    assert item.title == "1-a"
    discard(item)
    assert recoverable(tmp_path) == []
    assert recoverable(tmp_path / "nowhere") == []


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="folders are not read-only for everybody")
def test_a_folder_that_cannot_be_written_takes_nothing_down(tmp_path, quiet):
    tmp_path.chmod(0o500)
    recovery = Recovery(quiet, tmp_path / "state")
    quiet.open_survey(SAMPLE)
    quiet.change("Add check", checks=(CHECK,))
    recovery.flush()
    recovery.close()
    tmp_path.chmod(0o700)


def test_restored_documents_are_planned_with_their_corrections(tmp_path):
    """The whole way: edit, lose, restore, and the plan has the name that was given."""
    first = make_workbench()
    recovery = Recovery(first, tmp_path)
    first.open_survey(SAMPLE)
    settle(first)
    assert first.plan is not None
    first.run("correct.rename", region=first.plan.regions[0].id, name="Lobby")
    settle(first)
    recovery.flush()
    recovery._lock.close()
    second = make_workbench()
    restore(second, recoverable(tmp_path)[0])
    settle(second)
    assert second.plan is not None
    assert "Lobby" in [r.name for r in second.plan.regions]
    assert second.state.corrections == first.state.corrections
    recovery.close()
