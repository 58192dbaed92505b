"""``floorcast gui --script``: sessions without a display, by the command."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from floorcast_app.script import ScriptedApplication
from floorplan_core.errors import UsageError
from tests.app.pump import SAMPLE
from tests.app.windows import open_window


def gui(script: Path, **more: str) -> subprocess.CompletedProcess[str]:
    env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    env |= more
    return subprocess.run(
        [sys.executable, "-m", "floorplan_core.cli.main", "gui", "--script", str(script)],
        env=env,
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
    )


def test_a_python_session_opens_edits_pictures_and_exports(tmp_path: Path) -> None:
    session = tmp_path / "session.py"
    session.write_text(
        f"""
app.run("file.open", path={str(SAMPLE)!r})
app.run("correct.rename", region=app.workbench.plan.regions[0].id, name="Foyer")
app.picture({str(tmp_path / "plan.png")!r}, pane="floor_plan", width=800, height=600)
app.run("file.export", path={str(tmp_path / "plan.geojson")!r})
app.run("file.save", path={str(tmp_path / "survey.floorcast")!r})
assert not app.workbench.document.dirty
app.run("file.open", path={str(tmp_path / "survey.floorcast")!r})
assert "Foyer" in [region.name for region in app.workbench.plan.regions]
"""
    )
    done = gui(session)
    assert done.returncode == 0, done.stderr
    names = [
        f["properties"].get("name") for f in json.loads((tmp_path / "plan.geojson").read_text())["features"]
    ]
    assert "Foyer" in names
    assert (tmp_path / "plan.png").stat().st_size > 5000


def test_nothing_is_left_among_the_temporary_files(tmp_path: Path) -> None:
    session, scratch = tmp_path / "session.py", tmp_path / "scratch"
    session.write_text(f"app.run('file.open', path={str(SAMPLE)!r})")
    scratch.mkdir()
    done = gui(session, TMPDIR=str(scratch))
    assert done.returncode == 0, done.stderr
    assert list(scratch.iterdir()) == []


def test_helper_processes_do_not_run_the_script_again(tmp_path: Path) -> None:
    session = tmp_path / "session.py"
    session.write_text(
        """
import multiprocessing
process = multiprocessing.get_context("spawn").Process(target=print, args=("helped",))
process.start()
process.join()
assert app and __name__ == "__main__" and process.exitcode == 0
"""
    )
    done = gui(session)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["helped"]


def test_a_recorded_list_of_actions(tmp_path: Path) -> None:
    session = tmp_path / "session.json"
    actions = [
        {"action": "file.open", "path": str(SAMPLE)},
        {"action": "plan.set", "name": "doors.max_width", "value": 1.1},
        {"action": "file.export", "path": str(tmp_path / "plan.svg")},
    ]
    session.write_text(json.dumps(actions))
    done = gui(session)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "plan.svg").read_text().startswith("<?xml")


def test_what_goes_wrong_is_one_sentence_and_a_status(tmp_path: Path) -> None:
    for name, text, status, said in (
        ("a.py", "app.run('file.open', path='nowhere.ply')", 3, "does not exist"),
        ("b.py", "app.run('file.explode')", 2, "no action"),
        ("c.py", "1 / 0", 2, "ZeroDivisionError"),
        ("d.json", "{", 3, "not a list of actions"),
        ("e.py", "app.run('file.export', path='plan.svg')", 2, "not possible now"),
        ("f.py", "app.run('file.open', colour='red')", 2, "colour"),
    ):
        script = tmp_path / name
        script.write_text(text)
        done = gui(script)
        assert done.returncode == status, (name, done.stderr)
        assert said in done.stderr and "Traceback" not in done.stderr, (name, done.stderr)
    assert gui(tmp_path / "missing.py").returncode == 3


def test_a_script_clicks_at_places_of_the_plan() -> None:
    with open_window(1200, 800) as window:
        app = ScriptedApplication(window)
        app.run("file.open_sample")
        app.run("view.fit")
        region = max(app.workbench.plan.regions, key=lambda r: r.area)
        inside = region.polygon.representative_point()
        app.click("floor_plan", inside.x, inside.y)
        assert [(i.kind, i.id) for i in app.workbench.selection.items] == [("region", region.id)]
        with pytest.raises(UsageError, match="Nothing can be clicked by coordinates in the pane 'history'"):
            app.click("history", 0.0, 0.0)
