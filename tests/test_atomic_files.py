"""Files appear together, whole, or not at all."""

from __future__ import annotations

import errno
import os
import signal
from pathlib import Path

import pytest

from floorplan_core import files
from floorplan_core.cli.signals import interrupts_cancel
from floorplan_core.errors import OutputError
from floorplan_core.files import (
    STAGING_PREFIX,
    output_error,
    output_file,
    output_folder,
    uninterrupted,
    write_text,
    writing,
)
from floorplan_core.process_ids import is_running


def tree(folder: Path) -> dict[str, str]:
    return {str(p.relative_to(folder)): p.read_text() for p in folder.rglob("*") if p.is_file()}


def test_all_files_appear_at_the_end_of_the_block(tmp_path: Path) -> None:
    out = tmp_path / "deep" / "out"
    with output_folder(out) as staging:
        (staging / "a.txt").write_text("a")
        (staging / "stages").mkdir()
        (staging / "stages" / "b.txt").write_text("b")
        assert tree(out) == {
            f"{staging.name}/a.txt": "a",
            f"{staging.name}/stages/b.txt": "b",
        }  # nothing is visible under its own name yet
    assert tree(out) == {"a.txt": "a", "stages/b.txt": "b"}
    assert sorted(p.name for p in out.iterdir()) == ["a.txt", "stages"]


@pytest.mark.parametrize("error", [ValueError("no"), KeyboardInterrupt(), SystemExit(143)])
def test_an_error_leaves_the_folder_as_it_was(tmp_path: Path, error: BaseException) -> None:
    (tmp_path / "a.txt").write_text("before")
    with pytest.raises(type(error)), output_folder(tmp_path) as staging:
        (staging / "a.txt").write_text("after")
        (staging / "b.txt").write_text("half")
        raise error
    assert tree(tmp_path) == {"a.txt": "before"}
    assert os.listdir(tmp_path) == ["a.txt"]


def test_folders_made_for_nothing_are_removed_but_never_somebody_elses_files(tmp_path: Path) -> None:
    with pytest.raises(ValueError), output_folder(tmp_path / "x" / "y"):
        raise ValueError
    assert os.listdir(tmp_path) == []
    with pytest.raises(ValueError), output_folder(tmp_path / "x" / "y"):
        (tmp_path / "x" / "theirs.txt").write_text("keep")
        raise ValueError
    assert tree(tmp_path) == {"x/theirs.txt": "keep"}


def test_a_failed_move_puts_the_earlier_files_back(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("before")
    (tmp_path / "c.txt").mkdir()  # a folder where the third file should go
    with pytest.raises(OutputError, match="folder of this name"), output_folder(tmp_path) as staging:
        for name in ("a.txt", "b.txt", "c.txt"):
            (staging / name).write_text("after")
    assert tree(tmp_path) == {"a.txt": "before"}
    assert sorted(os.listdir(tmp_path)) == ["a.txt", "c.txt"]


@pytest.mark.parametrize(
    ("number", "words"),
    [
        (errno.ENOSPC, "no space left"),
        (errno.EDQUOT, "quota"),
        (errno.EACCES, "permission denied"),
        (errno.EROFS, "read-only"),
        (errno.ENOTDIR, "a file, not a folder"),
        (errno.ENAMETOOLONG, "too long"),
        (errno.ELOOP, "symbolic links"),
    ],
)
def test_every_failure_is_one_sentence_that_names_the_target(number: int, words: str) -> None:
    with pytest.raises(OutputError) as caught, writing(Path("here/plan.svg")):
        raise OSError(number, os.strerror(number))
    text = str(caught.value)
    assert "here/plan.svg" in text and words in text
    assert text.endswith(".") and "\n" not in text and text.count(". ") == 0


def test_full_disk_while_writing_one_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "plan.geojson"
    target.write_text("before")

    def full(self: Path, *args: object, **kwargs: object) -> int:
        with self.open("w") as half:
            half.write("ha")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(OutputError, match=r"plan\.geojson: there is no space left"):
        write_text(target, "after")
    monkeypatch.undo()
    assert tree(tmp_path) == {"plan.geojson": "before"}


def test_a_file_in_the_way_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("I am a file")
    with pytest.raises(OutputError, match="folder is wanted"), output_folder(tmp_path / "out"):
        raise AssertionError("the block must not begin")
    with pytest.raises(OutputError, match="a file, not a folder"), output_folder(tmp_path / "out" / "deep"):
        raise AssertionError("the block must not begin")


def test_one_file_where_a_folder_has_its_name(tmp_path: Path) -> None:
    (tmp_path / "plan.svg").mkdir()
    with pytest.raises(OutputError, match="folder of this name"), output_file(tmp_path / "plan.svg"):
        raise AssertionError("the block must not begin")


def test_the_temporary_file_has_the_final_name(tmp_path: Path) -> None:
    with output_file(tmp_path / "planes.png") as temporary:
        assert temporary.name == "planes.png"
        temporary.write_text("x")
    assert tree(tmp_path) == {"planes.png": "x"}


def test_a_sentence_names_the_file_and_not_where_it_is_made(tmp_path: Path) -> None:
    o = tmp_path / "o"
    with (
        pytest.raises(OutputError, match=r"Cannot write .*/o/plan\.svg: there is"),
        output_folder(o) as staging,
    ):
        (staging / "a.json").write_text("new")
        (staging / "plan.svg").write_text("new")
        (o / "plan.svg").mkdir()
    assert [p.name for p in o.iterdir()] == ["plan.svg"]
    staged = tmp_path / f"{STAGING_PREFIX}12-x_y" / "plan.svg"
    assert f"Cannot write {tmp_path}/plan.svg: " in str(output_error(OSError(errno.EFBIG, ""), staged))


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_waits_until_the_files_are_in_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    replace = files._replace

    def interrupted_move(new: Path, target: Path, keep: Path) -> None:
        replace(new, target, keep)
        os.kill(os.getpid(), number)

    monkeypatch.setattr(files, "_replace", interrupted_move)
    with (
        pytest.raises(KeyboardInterrupt),
        interrupts_cancel() as token,
        output_folder(tmp_path) as staging,
    ):
        (staging / "a.txt").write_text("a")
        (staging / "b.txt").write_text("b")
    assert token.cancelled
    assert tree(tmp_path) == {"a.txt": "a", "b.txt": "b"}  # both, and no temporary folder


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_while_the_folder_is_made_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    make = files.tempfile.mkdtemp

    def interrupted_make(**how: str) -> str:
        os.kill(os.getpid(), number)
        return str(make(**how))

    monkeypatch.setattr(files.tempfile, "mkdtemp", interrupted_make)
    with pytest.raises(KeyboardInterrupt), interrupts_cancel(), output_folder(tmp_path / "x" / "y"):
        raise AssertionError("the block must not begin")
    assert os.listdir(tmp_path) == []


def test_parents_that_were_made_go_again_where_the_folder_cannot_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(self: Path, mode: int = 0o777, parents: bool = False, exist_ok: bool = False) -> None:
        os.mkdir(tmp_path / "x")
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)
    with pytest.raises(OutputError, match="no space left"), output_folder(tmp_path / "x" / "y"):
        raise AssertionError("the block must not begin")
    assert os.listdir(tmp_path) == []


def test_held_back_signals_are_delivered_once_and_the_handler_returns() -> None:
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt), uninterrupted():
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is before


def test_what_a_killed_program_left_is_removed_but_nothing_of_one_that_may_run(tmp_path: Path) -> None:
    dead = next(pid for pid in range(2**22, 2, -1) if not is_running(pid))
    old, young, running = (
        tmp_path / f"{STAGING_PREFIX}{pid}-{name}"
        for pid, name in ((dead, "old"), (dead, "young"), (os.getpid(), "old"))
    )
    for folder in (old, young, running):
        folder.mkdir()
        (folder / "plan.svg").write_text("half")
    for folder in (old, running):
        os.utime(folder, (0, 0))
    write_text(tmp_path / "plan.svg", "whole")
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([young.name, running.name, "plan.svg"])
