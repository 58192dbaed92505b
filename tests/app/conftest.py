"""What the tests of the application share: workbenches without a window."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from floorcast_app.workbench import Workbench
from tests.app.pump import MOST_SECONDS, SAMPLE, make_workbench, settle


@pytest.fixture
def workbench() -> Iterator[Workbench]:
    """An empty workbench."""
    made = make_workbench()
    yield made
    made.cancel()
    assert made.jobs.wait(MOST_SECONDS)


@pytest.fixture(scope="module")
def sample_workbench() -> Iterator[Workbench]:
    """A workbench with the bundled survey, planned. Shared by the module's tests: undo what you change."""
    made = make_workbench()
    made.open_survey(SAMPLE)
    settle(made)
    assert made.plan is not None, made.ui.told  # type: ignore[attr-defined]
    yield made
    made.cancel()
    assert made.jobs.wait(MOST_SECONDS)
