"""What a crash left behind is offered at the next start: recovered, or discarded."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QMainWindow

from floorcast_app.panels.recovery_banner import RecoveryBanner
from floorcast_app.recovery import recoverable
from tests.app.pump import SAMPLE, make_workbench

CRASH = f"""
import os, signal
from tests.app.pump import make_workbench
from floorcast_app.recovery import Recovery
from floorcast_app.state import Check
workbench = make_workbench()
recovery = Recovery(workbench)
from pathlib import Path
from dataclasses import replace
from floorcast_app.state import SurveyRef
workbench.jobs.start = lambda *a: None
workbench.open_survey(Path({str(SAMPLE)!r}))
workbench.change("Check", checks=(Check("c1", (0.0, 0.0), (2.0, 0.0), 1.99),))
recovery.flush()
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture
def after_a_crash(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A state folder in which a program that was killed left its document."""
    monkeypatch.setenv("FLOORCAST_STATE", str(tmp_path))
    root = Path(__file__).resolve().parents[3]
    done = subprocess.run([sys.executable, "-c", CRASH], cwd=root, env=dict(os.environ), check=False)
    assert done.returncode == -signal.SIGKILL
    assert [r.title for r in recoverable()] == ["sample_survey"]
    return tmp_path


def banner(window: QMainWindow) -> RecoveryBanner:
    workbench = make_workbench()
    workbench.jobs.start = lambda *a: None  # type: ignore[method-assign]
    made = RecoveryBanner(workbench, window)
    made.offer()
    return made


def test_it_is_recovered(qapp: QApplication, after_a_crash: Path) -> None:
    window = QMainWindow()
    window.show()
    offered = banner(window)
    assert offered.isVisible() and "sample_survey" in offered.text.text()
    offered._restore(recoverable()[0])
    state = offered._workbench.state
    assert state.checks[0].measured == 1.99 and state.survey is not None
    assert offered._workbench.has_edits  # it is not saved, and says so
    offered.end()
    assert recoverable() == []


def test_it_is_discarded(qapp: QApplication, after_a_crash: Path) -> None:
    window = QMainWindow()
    window.show()
    offered = banner(window)
    offered._discard(recoverable()[0])
    assert recoverable() == [] and not offered.isVisible()
    offered.end()
