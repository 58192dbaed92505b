"""Exporting is a job: the window stays free, and what is cancelled leaves no file."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from floorcast_app.workbench import Workbench
from floorplan_core.errors import Cancelled, UsageError
from floorplan_core.plugins import default_registry
from tests.app.pump import settle


def test_the_file_is_there_when_the_job_is_done(sample_workbench: Workbench, tmp_path: Path) -> None:
    stages: list[str] = []
    sample_workbench.jobs.progressed.connect(lambda progress: stages.append(progress.stage))
    sample_workbench.run("file.export", path=tmp_path / "plan.svg")
    assert sample_workbench.jobs.running
    settle(sample_workbench)
    assert (tmp_path / "plan.svg").read_text().startswith("<?xml")
    assert "export" in stages
    assert sample_workbench.ui.told[-1] == ("info", "Exported plan.svg.")  # type: ignore[attr-defined]


def test_what_is_cancelled_is_not_written(
    sample_workbench: Workbench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target, writing, go_on = tmp_path / "plan.svg", threading.Event(), threading.Event()
    exporter = default_registry().exporter(target)
    write = type(exporter).write

    def slowly(self: object, plan: object, path: Path) -> None:
        write(self, plan, path)  # type: ignore[arg-type]
        writing.set()
        assert go_on.wait(60)

    ended: list[Exception | None] = []
    sample_workbench.jobs.ended.connect(ended.append)
    monkeypatch.setattr(type(exporter), "write", slowly)
    sample_workbench.run("file.export", path=target)
    assert writing.wait(60)
    sample_workbench.run("plan.cancel")
    assert not sample_workbench.jobs.running and isinstance(ended[-1], Cancelled)  # at once
    go_on.set()
    assert sample_workbench.jobs.wait(60)
    sample_workbench.pump.run_until(  # type: ignore[attr-defined]
        lambda: ("warning", "plan.svg was not written.") in sample_workbench.ui.told  # type: ignore[attr-defined]
    )
    assert list(tmp_path.iterdir()) == []


def test_a_plan_that_is_being_made_is_not_exported(sample_workbench: Workbench, tmp_path: Path) -> None:
    sample_workbench.run("plan.again")
    with pytest.raises(UsageError, match="not ready yet"):
        sample_workbench.run("file.export", path=tmp_path / "plan.svg")
    settle(sample_workbench)
