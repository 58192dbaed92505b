"""Project files: everything comes back, whatever moved, and nothing that is damaged or killed does harm."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from floorplan_core import corrections_json
from floorplan_core.config import Config
from floorplan_core.errors import InputError, OutputError
from floorplan_core.model import corrections as c
from floorplan_core.project_file import Project, digest, load, read_thumbnail, save

AT = c.PlaneAt((1.25, -2.5), (0.6, 0.8))
EVERY = (
    c.HidePlane(AT),
    c.KeepPlane(AT),
    c.MovePlane(AT, (1.5, 2.0)),
    c.AddWall((0.0, 0.0), (3.0, 0.0), 0.12),
    c.AcceptDoor((1.0, 2.0)),
    c.RejectDoor((1.0, 2.0)),
    c.AddDoor((0.0, 0.0), (0.9, 0.0), "opening"),
    c.ResizeDoor((1.0, 2.0), (0.5, 2.0), (1.4, 2.0)),
    c.LabelRegion((1.0, 2.0), "kitchen"),
    c.NameRegion((1.0, 2.0), "Büro 5"),
    c.MergeRegions(((1.0, 2.0), (3.0, 4.0), (5.0, 6.0))),
    c.SplitRegion((0.0, 0.0), (0.0, 5.0)),
)
CHECK = {"id": "c1", "start": (0.0, 1.0), "end": (2.0, 1.0), "measured": 2.004, "note": "door to door"}


@pytest.fixture
def survey(tmp_path: Path) -> Path:
    path = tmp_path / "site" / "points.ply"
    path.parent.mkdir()
    path.write_bytes(bytes(range(256)) * 5000)
    return path


def _project(survey: Path) -> Project:
    config = Config().with_values({"doors.max_width": "1.4", "regions.min_area": "1.0"})
    return Project(
        (survey, None, ""),
        config,
        EVERY,
        (CHECK,),
        {"look": {"span": 12.5}, "layers": ["points"]},
        (3.5e5, 5.6e6),
        (("r1", "1", "00ff"),),
    )


def test_everything_comes_back(survey):
    """Every kind of correction, the settings, the checks and the view; the digest is of the file."""
    path = survey.with_name("house.floorcast")
    save(path, _project(survey), b"\x89PNG picture")
    back = load(path)
    assert back == replace(_project(survey), survey=(survey, None, digest(survey)))
    assert read_thumbnail(path) == b"\x89PNG picture"
    assert [type(x) for x in back.corrections] == [type(x) for x in EVERY]


def test_every_kind_of_correction_is_covered():
    assert {type(x).__name__ for x in EVERY} == set(corrections_json._kinds())


def test_same_project_same_bytes(survey):
    one, two = survey.with_name("a.floorcast"), survey.with_name("b.floorcast")
    save(one, _project(survey))
    save(two, _project(survey))
    assert one.read_bytes() == two.read_bytes()


def test_moved_together(survey, tmp_path):
    """A folder with project and survey that moves, or comes from another machine, opens as before."""
    save(survey.with_name("house.floorcast"), _project(survey))
    moved = tmp_path / "elsewhere"
    survey.parent.rename(moved)
    back = load(moved / "house.floorcast")
    assert back.survey is not None
    assert back.survey[0] == moved / "points.ply"
    assert back.missing == back.notes == ()


def test_project_moved_alone(survey, tmp_path):
    save(survey.with_name("house.floorcast"), _project(survey))
    (tmp_path / "mail").mkdir()
    alone = survey.with_name("house.floorcast").rename(tmp_path / "mail" / "house.floorcast")
    back = load(alone)
    assert back.survey is not None
    assert back.survey[0] == survey
    assert back.missing == ()


def test_missing_and_changed_inputs_are_said(survey):
    """A survey that is gone is no error: all else is there. One that changed is pointed out."""
    path = survey.with_name("house.floorcast")
    save(path, replace(_project(survey), survey=(survey, survey.with_name("trajectory.tum"), "")))
    assert load(path).missing == (survey.with_name("trajectory.tum"),)
    survey.write_bytes(survey.read_bytes()[:-1] + b"!")
    back = load(path)
    assert len(back.notes) == 1
    assert "points.ply is not the same" in back.notes[0]
    survey.unlink()
    back = load(path)
    assert survey in back.missing
    assert back.corrections == EVERY


def test_digest_sees_a_change_anywhere_that_it_looks(tmp_path):
    """Size, first and last byte; files of a folder by name, size and content; hidden ones do not count."""
    file = tmp_path / "scan.bin"
    seen = set()
    for content in (b"", b"a" * 10, b"a" * 11, b"b" + b"a" * 10, b"a" * 900_000, b"a" * 899_999 + b"c"):
        file.write_bytes(content)
        seen.add(digest(file))
    assert len(seen) == 6
    assert digest(tmp_path / "none") == ""
    whole = digest(tmp_path)
    (tmp_path / ".DS_Store").write_bytes(b"x")
    assert digest(tmp_path) == whole
    (tmp_path / "more.bin").write_bytes(b"")
    assert digest(tmp_path) != whole


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_a_pipe_as_input_does_not_wait(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert digest(tmp_path / "pipe") == ""


def _with_tree(path: Path, change: object) -> None:
    """Rewrite the project with its tree changed by ``change(tree)``."""
    with zipfile.ZipFile(path) as archive:
        tree = json.loads(archive.read("project.json"))
    changed = change(tree)  # type: ignore[operator]
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("project.json", changed if isinstance(changed, str) else json.dumps(tree))


BAD = {
    "another version": lambda t: t.update(version=99),
    "another format": lambda t: t.update(format="x"),
    "no table": lambda t: "[]",
    "not JSON": lambda t: "{",
    "a number that is none": lambda t: t["corrections"][0]["plane"].update(at=[float("nan"), 0]),
    "a huge number": lambda t: t["corrections"][3].update(thickness=1e300),
    "an unknown correction": lambda t: t["corrections"].append({"correction": "Explode"}),
    "a field too many": lambda t: t["corrections"][4].update(run="rm"),
    "a field too few": lambda t: t["corrections"][4].pop("at"),
    "a text for a place": lambda t: t["corrections"][4].update(at="here"),
    "corrections that are no list": lambda t: t.update(corrections={}),
    "a setting out of bounds": lambda t: t["config"]["doors"].update(bin=-1),
    "settings that are a list": lambda t: t.update(config=[1]),
    "a view that is a list": lambda t: t.update(view=[1]),
    "names that are no texts": lambda t: t.update(names=[["r1", 1, "00"]]),
    "an origin of three numbers": lambda t: t.update(origin=[1, 2, 3]),
    "a check without a start": lambda t: t["checks"][0].pop("start"),
    "a path with a zero byte": lambda t: t["survey"].update(absolute="/a\0b"),
    "a path that is a number": lambda t: t["survey"].update(absolute=5),
    "a survey that is a text": lambda t: t.update(survey="/etc"),
    "deep nesting": lambda t: "[" * 100_000,
}


@pytest.mark.parametrize("what", BAD)
def test_damage_is_one_sentence(survey, what):
    path = survey.with_name("bad.floorcast")
    save(path, _project(survey))
    _with_tree(path, BAD[what])
    with pytest.raises(InputError) as caught:
        load(path)
    assert "bad.floorcast" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_settings_of_another_version_are_left_out(survey):
    path = survey.with_name("new.floorcast")
    save(path, _project(survey))
    _with_tree(path, lambda t: t["config"].update(future={"magic": 1}))
    back = load(path)
    assert back.config == _project(survey).config
    assert "future.magic" in back.notes[0]


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_any_damaged_byte_is_refused_or_read(survey, data):
    """Whatever is flipped or cut: an InputError or a project, never another exception."""
    path = survey.with_name("flip.floorcast")
    save(path, _project(survey))
    content = bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(bytes(content[: data.draw(st.sampled_from([at, len(content)]))]))
    try:
        assert isinstance(load(path), Project)
    except InputError as error:
        assert "flip.floorcast" in str(error)


def test_a_failed_save_keeps_the_old_file(survey, monkeypatch):
    path = survey.with_name("house.floorcast")
    save(path, _project(survey))
    before = path.read_bytes()

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match="no space left"):
        save(path, Project())
    assert path.read_bytes() == before
    assert [p.name for p in sorted(survey.parent.iterdir())] == ["house.floorcast", "points.ply"]


def test_a_link_stays_a_link(survey, tmp_path):
    real, link = survey.with_name("real.floorcast"), tmp_path / "link.floorcast"
    save(real, Project())
    link.symlink_to(real)
    save(link, _project(survey))
    assert link.is_symlink()
    assert load(real).corrections == EVERY


SAVER = """
import sys
from pathlib import Path
from floorplan_core.config import Config
from floorplan_core.model.corrections import NameRegion
from floorplan_core.project_file import Project, save
k = 0
while True:
    k += 1
    said = tuple(NameRegion((float(k), 0.0), str(n)) for n in range(3000))
    save(Path(sys.argv[1]), Project(None, Config(), said))
    print(k, flush=True)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="this system cannot kill without warning")
def test_killed_while_saving_loses_nothing(tmp_path):
    """A program that saves again and again is killed at random moments: there is always a whole project."""
    path, rng = tmp_path / "house.floorcast", random.Random(4)
    for _ in range(6):
        process = subprocess.Popen(
            [sys.executable, "-c", SAVER, str(path)], stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        saved = int(process.stdout.readline())
        time.sleep(0.05 * rng.random())
        process.kill()
        saved = max([saved, *(int(line) for line in process.stdout.read().split())])
        process.wait()
        back = load(path)
        assert len(back.corrections) == 3000
        first = back.corrections[0]
        assert isinstance(first, c.NameRegion)
        assert first.at[0] >= saved  # what was reported as saved is there
    save(path, Project())
    assert [p.name for p in tmp_path.iterdir()] == ["house.floorcast"]  # what was left over is gone
