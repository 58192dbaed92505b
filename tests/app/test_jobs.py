"""Jobs run beside the window: results, failures and cancelling arrive in the main thread, once."""

from __future__ import annotations

import threading

import pytest

from floorcast_app.jobs import Jobs, Progress
from floorplan_core.errors import Cancelled, FloorPlanError, InputError
from floorplan_core.observer import Observer
from tests.app.pump import Pump


@pytest.fixture
def pump() -> Pump:
    return Pump()


@pytest.fixture
def jobs(pump: Pump) -> Jobs:
    return Jobs(pump.post)


def ended(jobs: Jobs) -> list[Exception | None]:
    errors: list[Exception | None] = []
    jobs.ended.connect(errors.append)
    return errors


def test_a_result_arrives_in_the_main_thread(pump: Pump, jobs: Jobs) -> None:
    threads: list[threading.Thread] = []
    errors = ended(jobs)
    jobs.start("work", lambda observer: 42, lambda result: threads.append(threading.current_thread()))
    assert jobs.running
    pump.run_until(lambda: not jobs.running, 10)
    assert threads == [threading.main_thread()] and errors == [None]


def test_progress_and_stages_are_told(pump: Pump, jobs: Jobs) -> None:
    told: list[Progress] = []
    stages: list[str] = []
    jobs.progressed.connect(told.append)
    jobs.stage_done.connect(lambda stage, seconds, result: stages.append(stage))

    def work(observer: Observer) -> None:
        observer.stage_started("read", 100)
        observer.progress("read", 50)
        observer.stage_finished("read", 0.1)

    jobs.start("work", work, lambda result: None)
    pump.run_until(lambda: not jobs.running, 10)
    assert told[0] == Progress("read", 0, 100) and told[1].done == 50
    assert told[1].seconds_left is not None and stages == ["read"]


@pytest.mark.parametrize(
    "error, said",
    [
        (InputError("No such file."), "No such file."),
        (MemoryError(), "Not enough memory"),
        (ValueError("odd"), "ValueError: odd"),
    ],
)
def test_a_failure_is_one_sentence(pump: Pump, jobs: Jobs, error: Exception, said: str) -> None:
    errors = ended(jobs)

    def work(observer: Observer) -> None:
        raise error

    jobs.start("work", work, lambda result: pytest.fail("there is no result"))
    pump.run_until(lambda: not jobs.running, 10)
    assert isinstance(errors[0], FloorPlanError) and said in str(errors[0])


def test_cancel_ends_the_job_at_once_and_nothing_of_it_arrives_later(pump: Pump, jobs: Jobs) -> None:
    errors = ended(jobs)
    go_on, stopped = threading.Event(), threading.Event()

    def work(observer: Observer) -> None:
        go_on.wait(10)
        try:
            observer.check_cancelled()
        finally:
            stopped.set()

    jobs.start("work", work, lambda result: pytest.fail("it was cancelled"))
    jobs.cancel()
    assert not jobs.running and isinstance(errors[0], Cancelled)  # before the thread has noticed
    go_on.set()
    assert stopped.wait(10)
    with pytest.raises(AssertionError):
        pump.run_until(lambda: len(errors) > 1, 0.2)


def test_a_new_job_takes_the_place_of_the_running_one(pump: Pump, jobs: Jobs) -> None:
    order: list[str] = []

    def slow(observer: Observer) -> None:
        while True:
            observer.check_cancelled()

    jobs.start("slow", slow, lambda result: order.append("slow"))
    jobs.start("fast", lambda observer: order.append("work"), lambda result: order.append("fast"))
    pump.run_until(lambda: not jobs.running, 10)
    assert order == ["work", "fast"]
    assert jobs.wait(10)


def test_a_job_after_a_cancelled_one_waits_until_that_is_gone(pump: Pump, jobs: Jobs) -> None:
    order: list[str] = []
    go_on = threading.Event()

    def slow(observer: Observer) -> None:
        go_on.wait(10)
        order.append("slow is gone")

    jobs.start("slow", slow, lambda result: None)
    jobs.cancel()
    jobs.start("next", lambda observer: order.append("next"), lambda result: None)
    go_on.set()
    pump.run_until(lambda: not jobs.running, 10)
    assert order == ["slow is gone", "next"]
