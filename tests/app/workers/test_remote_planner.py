"""A planner in a process of its own plans what one in this process plans; where it dies, the window lives."""

from __future__ import annotations

import gc
import os
import pickle
import signal
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from floorcast_app.point_store import PointStore
from floorcast_app.run_replay import ShownStorey
from floorcast_app.workbench import Workbench
from floorcast_app.workers.planner import LocalPlanner
from floorcast_app.workers.remote_planner import RemotePlanner
from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, FloorPlanError, InputError
from floorplan_core.model import LayoutPlane, OccupancyGrid
from floorplan_core.observer import CancelToken, Observer
from tests.app.pump import SAMPLE, Pump, settle


class Ear(Observer):
    """Hears all; gives up when it hears ``until``."""

    def __init__(self, until: str = "") -> None:
        super().__init__(CancelToken())
        self.heard: list[tuple[Any, ...]] = []
        self._until = until

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self.heard.append(("started", stage, total))
        if stage == self._until:
            self.cancel.cancel()

    def progress(self, stage: str, done: int) -> None:
        self.heard.append(("progress", stage, done))

    def stage_finished(self, stage: str, seconds: float, result: object = None) -> None:
        self.heard.append(("finished", stage, result))


@pytest.fixture(scope="module")
def planner() -> Iterator[RemotePlanner]:
    made = RemotePlanner()
    yield made
    made.close()


def opened(planner: Any, path: Path = SAMPLE) -> tuple[Any, PointStore]:
    """A session with its points."""
    session, store = planner.open(path, None, Config(), (), Observer()), PointStore()
    planner.read(session, store, Observer())
    return session, store


@pytest.fixture(scope="module")
def far(planner: RemotePlanner) -> tuple[Any, PointStore]:
    return opened(planner)


@pytest.fixture(scope="module")
def near() -> tuple[Any, PointStore]:
    return opened(LocalPlanner())


def test_it_plans_the_same(far: tuple[Any, PointStore], near: tuple[Any, PointStore]) -> None:
    here = near[0].plan(Config(), (), Observer())
    there = far[0].plan(Config(), (), Observer())
    assert there.regions and len(here.regions) == len(there.regions)
    for a, b in zip(here.regions, there.regions, strict=True):
        assert (a.id, a.name, a.area) == (b.id, b.name, b.area)
        assert a.polygon.equals_exact(b.polygon, 0.0)
    assert pickle.dumps(here.grid) == pickle.dumps(there.grid)
    assert [p.offset for p in here.planes] == [p.offset for p in there.planes]
    assert far[0].names == near[0].names
    assert far[0].origin == near[0].origin
    assert len(far[0].storeys(Config())) == len(near[0].storeys(Config())) == 1
    assert far[0].reconstruction.assumptions == near[0].reconstruction.assumptions
    assert list(far[0].reconstruction.chunks()) == []  # points stay where they were read


def test_the_panes_get_the_same_points(far: tuple[Any, PointStore], near: tuple[Any, PointStore]) -> None:
    here, there = near[1].snapshot(), far[1].snapshot()
    assert len(here.xyz) > 10_000
    np.testing.assert_array_equal(here.xyz, there.xyz)


def test_what_stages_find_is_told_for_the_first_plan_only(planner: RemotePlanner) -> None:
    session = planner.open(SAMPLE, None, Config(), (), Observer())
    ear = Ear()
    session.read(PointStore(), ear)
    assert any(h[:2] == ("started", "read") and h[2] > 10_000 for h in ear.heard)
    assert any(h[:2] == ("progress", "read") and h[2] > 0 for h in ear.heard)
    session.plan(Config(), (), ear)
    found = [h[2] for h in ear.heard if h[0] == "finished" and h[2] is not None]
    assert any(isinstance(result, OccupancyGrid) for result in found)
    assert any(isinstance(result, tuple) and isinstance(result[0], LayoutPlane) for result in found)
    again = Ear()
    wider = Config().model_copy(update={"doors": Config().doors.model_copy(update={"max_width": 1.2})})
    session.plan(wider, (), again)
    assert again.heard and all(h[2] is None for h in again.heard if h[0] == "finished")


def test_only_settings_of_reading_make_it_read_again(far: tuple[Any, PointStore]) -> None:
    config = Config()
    assert not far[0].must_read_again(
        config.model_copy(update={"doors": config.doors.model_copy(update={"max_width": 1.3})})
    )
    assert far[0].must_read_again(
        config.model_copy(update={"input": config.input.model_copy(update={"unit": "cm"})})
    )


@pytest.mark.parametrize("until", ["read", "planes"])
def test_giving_up_is_told_and_the_next_request_is_answered(until: str) -> None:
    planner = RemotePlanner()
    try:
        session, ear = planner.open(SAMPLE, None, Config(), (), Observer()), Ear(until)
        with pytest.raises(Cancelled):
            session.read(PointStore(), ear)
            session.plan(Config(), (), ear)
        if until == "read":  # a survey that was not read to its end may be lost with its process
            session = planner.open(SAMPLE, None, Config(), (), Observer())
        session.read(PointStore(), Observer())
        assert session.plan(Config(), (), Observer()).regions
    finally:
        planner.close()


def test_errors_keep_their_class_and_sentence(planner: RemotePlanner, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"nothing\.ply"):
        planner.open(tmp_path / "nothing.ply", None, Config(), (), Observer())


def test_trouble_here_ends_the_request_and_no_more() -> None:
    class Full(PointStore):
        def put(self, part: object, every: int) -> None:
            raise MemoryError("no room")

    planner = RemotePlanner()
    try:
        session = planner.open(SAMPLE, None, Config(), (), Observer())
        with pytest.raises(MemoryError):
            planner.read(session, Full(), Observer())
        assert len(opened(planner)[1]) > 10_000
    finally:
        planner.close()


def test_a_bug_there_is_one_sentence_here(planner: RemotePlanner) -> None:
    session, _ = opened(planner)
    with pytest.raises(FloorPlanError, match=r"Floorcast failed in this job \(AttributeError"):
        session.plan("no settings", (), Observer())  # type: ignore[arg-type]


def test_a_run_is_replayed(far: tuple[Any, PointStore], planner: RemotePlanner) -> None:
    session = far[0]
    whole = session.plan(Config(), (), Observer())
    moments: list[Any] = []
    shown = ShownStorey.of(whole, session.reconstruction, True)
    planner.replay(session, Config(), 60.0, shown, Observer(), moments.append)
    assert moments and moments[-1].plan is not None
    assert [m.time for m in moments] == sorted(m.time for m in moments)


def test_sessions_that_nobody_holds_are_forgotten(planner: RemotePlanner) -> None:
    session = planner.open(SAMPLE, None, Config(), (), Observer())
    number = session._number
    del session
    gc.collect()
    assert number in planner._dropped
    planner.open(SAMPLE, None, Config(), (), Observer())
    assert number not in planner._dropped


def killed(planner: RemotePlanner) -> None:
    """The process dies, as it does where memory runs out."""
    life = planner._life
    assert life is not None and life.process.pid is not None
    os.kill(life.process.pid, signal.SIGKILL)
    life.process.join(10)


def test_a_process_that_dies_is_one_sentence_and_the_survey_is_read_again() -> None:
    pump = Pump()
    workbench = Workbench(pump.post, RemotePlanner())
    workbench.pump = pump  # type: ignore[attr-defined]
    errors: list[Exception | None] = []
    workbench.jobs.ended.connect(errors.append)
    try:
        workbench.open_survey(SAMPLE)
        settle(workbench)
        assert workbench.plan is not None and workbench.session is not None and workbench.session.ready
        before = [r.name for r in workbench.plan.regions]
        killed(workbench.planner)  # type: ignore[arg-type]
        workbench.run("plan.set", name="doors.max_width", value=1.3)
        settle(workbench)
        if errors[-1] is not None:  # it was asked before anybody knew
            assert "ended unexpectedly" in str(errors[-1])
            workbench.run("plan.set", name="doors.max_width", value=1.4)
            settle(workbench)
        assert errors[-1] is None and [r.name for r in workbench.plan.regions] == before
    finally:
        workbench.planner.close()


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="processes cannot be stopped here")
@pytest.mark.parametrize("step", ["read", "plan"])
def test_a_step_that_does_not_hear_ends_with_its_process_and_the_next_survey_is_opened(step: str) -> None:
    planner = RemotePlanner()

    class Stuck(Observer):
        """Gives up a step that hears nothing any more, as while a kernel is compiled."""

        def stage_started(self, stage: str, total: int | None = None) -> None:
            assert planner._life is not None and planner._life.process.pid is not None
            os.kill(planner._life.process.pid, signal.SIGSTOP)
            self.cancel.cancel()
            if step == "plan":
                planner.forget()  # the survey is closed

    try:
        session, store = planner.open(SAMPLE, None, Config(), (), Observer()), PointStore()
        life = planner._life
        if step == "plan":
            session.read(store, Observer())
        with pytest.raises(Cancelled):
            session.plan(Config(), (), Stuck()) if step == "plan" else session.read(store, Stuck())
        assert life is not None and not life.process.is_alive()
        assert not session.ready
        assert planner._life is not life and planner._life is not None and planner._life.process.is_alive()
        assert opened(planner)[0].plan(Config(), (), Observer()).regions
    finally:
        planner.close()


def test_closing_in_the_middle_of_a_job_leaves_no_process() -> None:
    planner = RemotePlanner()
    failures: list[BaseException] = []
    reading = threading.Event()

    class Early(Observer):
        def stage_started(self, stage: str, total: int | None = None) -> None:
            reading.set()

    def work() -> None:
        try:
            session = planner.open(SAMPLE, None, Config(), (), Early())
            while True:
                session.read(PointStore(), Early())
                session.plan(Config(), (), Early())
        except FloorPlanError as error:
            failures.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    assert reading.wait(60)
    life = planner._life
    planner.close()
    thread.join(60)
    assert not thread.is_alive() and isinstance(failures[0], Cancelled)
    assert life is not None and not life.process.is_alive()
