"""A session reads once and plans many times: only what depends on a change runs, and nothing is lost."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, UsageError
from floorplan_core.exporters.geojson import geojson_text
from floorplan_core.model import corrections as c
from floorplan_core.observer import CancelToken, Observer
from floorplan_core.pipeline import FloorPlanner
from floorplan_core.session import PlanningSession
from floorplan_core.steps import StepMemory
from tests.plan_invariants import assert_valid
from tests.sessions import local, plan, stages_run, two_room_session

SAMPLE = Path(__file__).resolve().parents[1] / "resources" / "sample_survey"
AFTER = {  # a setting, another value, and the first stage that has to run for it
    "segments.window": ("0.4", "segments"),
    "planes.tolerance": ("0.06", "planes"),
    "doors.min_confidence": ("0.7", "planes"),  # wall profiles are cropped where doors are looked for
    "occupancy.min_component": ("0.7", "occupancy"),
    "candidates.tolerance": ("0.14", "candidates"),
    "cover.time_limit": ("30", "cover"),
    "regions.min_area": ("1.5", "regions"),
    "labels.max_room_perimeter": ("10", "labels"),
}


@pytest.fixture(scope="module")
def session() -> Iterator[PlanningSession]:
    made = two_room_session()
    plan(made)
    yield made


@pytest.mark.parametrize("setting", AFTER)
def test_a_setting_reruns_only_what_depends_on_it(session, setting):
    """The first stage that runs is the one that the setting belongs to; back again, the same plan."""
    value, first = AFTER[setting]
    before = geojson_text(plan(session))
    changed = Config().with_values({setting: value})
    made, stages = stages_run(session, changed)
    assert stages[0] == first
    assert made.config == changed
    assert stages_run(session, changed)[1] == []
    assert geojson_text(plan(session)) == before


def test_a_plan_after_detours_is_that_of_a_fresh_session(session):
    """Remembered steps never leak: every setting in turn, against a planner that knows nothing."""
    config = Config()
    for setting, (value, _) in AFTER.items():
        config = config.with_values({setting: value})
        made = plan(session, config=config)
    survey = session.reconstruction
    planner = FloorPlanner(config, source=survey.name, local_frame=survey.local_frame)
    for chunk in survey.chunks():
        planner.integrate_chunk(chunk, survey.trajectory)
    assert geojson_text(made) == geojson_text(planner.plan())
    plan(session)


class _GivesUp(Observer):
    """Cancels when a stage begins."""

    def __init__(self, at: str) -> None:
        super().__init__(CancelToken())
        self.at = at
        self.seen: list[str] = []

    def stage_started(self, stage: str, total: int | None = None) -> None:
        self.seen.append(stage)
        if stage == self.at:
            self.cancel.cancel()

    def progress(self, stage: str, done: int) -> None:
        self.check_cancelled()


def test_what_was_done_before_a_cancel_is_kept(session):
    changed = Config().with_values({"segments.window": "0.42"})
    with pytest.raises(Cancelled):
        session.plan(changed, (), _GivesUp("candidates"))
    _, stages = stages_run(session, changed)
    assert "segments" not in stages
    assert "doors" not in stages
    assert stages[0] in ("candidates", "cover")


def test_reading_can_be_cancelled_and_begun_again():
    made = two_room_session()
    again = PlanningSession(made.reconstruction, Config())
    kept: list[int] = []
    with pytest.raises(Cancelled):
        again.read(_GivesUp("read"), lambda chunk: kept.append(len(chunk.points)))
    assert not again.ready
    with pytest.raises(UsageError, match="not read"):
        plan(again)
    kept.clear()
    again.read(Observer(), lambda chunk: kept.append(len(chunk.points)))
    assert sum(kept) == made.reconstruction.point_count
    assert geojson_text(plan(again)) == geojson_text(plan(made))


@pytest.mark.parametrize("setting", ["input.unit=m", "input.max_range=12", "voxels.size=0.12"])
def test_settings_of_reading_need_another_reading(session, setting):
    name, value = setting.split("=")
    assert session.must_read_again(Config().with_values({name: value}))
    assert not session.must_read_again(Config().with_values({"doors.bin": "0.04"}))


def test_opening_the_bundled_survey_tells_how_far_it_is():
    """All points pass by ``keep``, and the progress ends where they do."""

    class Counts(Observer):
        total, done, stages = 0, 0, ()

        def stage_started(self, stage: str, total: int | None = None) -> None:
            self.stages = (*self.stages, stage)
            self.total = total or self.total if stage == "read" else self.total

        def progress(self, stage: str, done: int) -> None:
            self.done = done if stage == "read" else self.done

    observer, kept = Counts(), []
    session = PlanningSession.open(SAMPLE, None, Config(), observer)
    session.read(observer, lambda chunk: kept.append(len(chunk.points)))
    assert session.ready
    assert sum(kept) == observer.done == observer.total == session.reconstruction.point_count
    assert "read" in observer.stages


def test_a_survey_of_one_storey_says_so(session):
    (storey,) = session.storeys(Config())
    assert storey.number == 0
    with pytest.raises(UsageError, match="no storey 1"):
        session.plan(Config(), (), Observer(), storey=1)


def test_a_grid_map_is_a_session_too(tmp_path):
    """Read at once; labels, names, merges and splits work, and a wall that is none joins its rooms."""
    from PIL import Image

    image = np.full((120, 200), 205, dtype=np.uint8)
    image[10:110, 10:190] = 0
    image[14:106, 14:98] = 254
    image[14:106, 102:186] = 254
    image[50:66, 96:104] = 254  # a door
    Image.fromarray(image).save(tmp_path / "map.png")
    (tmp_path / "map.yaml").write_text("image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\n")
    session = PlanningSession.open(tmp_path / "map.yaml", None, Config(), Observer())
    session.read(Observer())
    assert session.ready
    assert not session.must_read_again(Config().with_values({"input.unit": "ft"}))
    made = plan(session)
    assert len(made.regions) == 2
    inside = [r.polygon.representative_point() for r in made.regions]
    at = [local(made, p.x, p.y) for p in inside]
    assert stages_run(session, Config(), (c.NameRegion(at[0], "Hall"),))[1] == []
    named = plan(session, c.NameRegion(at[0], "Hall"), c.MovePlane(c.PlaneAt(at[0], (1.0, 0.0)), at[1]))
    assert named.regions[0].name == "Hall"
    assert any("not there any more" in text for text in named.warnings)
    merged = plan(session, c.MergeRegions(tuple(at)))
    assert_valid(merged)
    assert len(merged.regions) == 1


def test_memory_compares_settings_by_value_and_data_by_identity():
    memory, data = StepMemory(), np.arange(3)
    memory.keep("step", (Config(), data, (1, "a")), "made")
    assert memory.find("step", (Config(), data, (1, "a"))) == ("made",)
    assert memory.find("step", (Config(), data.copy(), (1, "a"))) is None
    assert memory.find("step", (Config(), data, (1, "b"))) is None
    assert memory.find("other", (Config(), data, (1, "a"))) is None
