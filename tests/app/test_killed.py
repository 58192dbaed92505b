"""A program that is killed loses nothing that was saved, and leaves no process behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from floorplan_core.process_ids import is_running
from tests.app import kills

ROOT = Path(__file__).resolve().parents[2]
LONGEST = 60.0  # s until a process notices that its window is gone, on a loaded machine

WINDOW = """
import sys, time
from floorcast_app.workers.remote_planner import RemotePlanner
if __name__ == "__main__":
    planner = RemotePlanner()
    planner.start()
    print(planner._life.process.pid, flush=True)
    time.sleep(600)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="children are forked")
@pytest.mark.parametrize("kind", list(kills.KINDS))
def test_killed_while_it_saves(kind: str, tmp_path: Path) -> None:
    """A few times here; ``python -m tests.app.kills`` does it as often as one likes."""
    command = [sys.executable, "-m", "tests.app.kills", kind, "4", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 wrong" in done.stdout


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="another system kills otherwise")
def test_a_window_that_is_killed_leaves_no_process(tmp_path: Path) -> None:
    script = tmp_path / "window.py"
    script.write_text(WINDOW)
    window = subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True, cwd=ROOT)
    assert window.stdout is not None
    planner = int(window.stdout.readline())
    window.kill()
    window.wait()
    window.stdout.close()
    end = time.monotonic() + LONGEST
    while is_running(planner) and not _is_dead(planner):
        assert time.monotonic() < end, "the planner goes on without its window"
        time.sleep(0.1)


def _is_dead(pid: int) -> bool:
    """True for a process that ended and that nobody waited for yet."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return False
