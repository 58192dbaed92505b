"""The command line's promises that need no plan: help, exit statuses, one sentence for every mistake."""

from __future__ import annotations

import errno
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml

from floorplan_core import __version__
from floorplan_core.cli import app, main
from floorplan_core.cli.failures import explain
from floorplan_core.cli.signals import Terminated
from floorplan_core.config import Config
from floorplan_core.errors import Cancelled, FloorPlanError, InputError, NoPlanError, OutputError, UsageError

COMMANDS = ["plan", "watch", "evaluate", "export", "simulate", "settings", "plugins", "gui"]
HEAVY = ["open3d", "PySide6", "numba", "numpy", "scipy", "cv2", "shapely", "floorcast_plugins"]


BAD_INPUTS = [
    *("missing", "empty.ply", "no_scans", "text.ply", "photo.ply", "truncated.ply", "huge.ply"),
    *("random.xyz", "loop.ply", "pipe.ply", "/dev/null"),
]


def one_sentence(stderr: str) -> str:
    """The one line that the user gets; fails where there is more, or a traceback."""
    lines = stderr.strip().splitlines()
    assert len(lines) == 1 and lines[0].startswith("floorcast: ") and lines[0].endswith("."), stderr
    return lines[0]


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], *([c, "--help"] for c in COMMANDS)])
def test_help_loads_nothing_heavy(arguments: list[str]) -> None:
    code = (
        "import sys; from floorplan_core.cli.main import run; status = run(sys.argv[1:]);"
        f"sys.stderr.write(','.join(m for m in {HEAVY} if m in sys.modules)); sys.exit(status)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.strip()


@pytest.mark.parametrize(
    "arguments",
    [
        ["plan", "survey.ply", "--out", ""],
        ["plan", "", "--out", "x"],
        ["plan", "survey.ply", "--out", "x", "--trajectory", ""],
        ["plan", "survey.ply", "--out", "x", "--config", ""],
        ["watch", "survey.ply", "--out", ""],
        ["simulate", "--out", ""],
        ["export", "plan", "--to", ""],
        ["evaluate", "plan", "truth.json", "--save-truth", ""],
        ["gui", ""],
    ],
)
def test_an_empty_name_is_not_the_current_folder(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main.run(arguments) == 2
    assert "it is empty: name a file or a folder" in one_sentence(capfd.readouterr().err)
    assert not list(tmp_path.iterdir())


def test_help_lists_every_command_and_the_exit_statuses(capfd: pytest.CaptureFixture[str]) -> None:
    assert main.run(["--help"]) == 0
    text = capfd.readouterr().out
    assert all(re.search(rf"\b{command} ", text) for command in COMMANDS)
    assert all(status in text for status in ("0 done", "2 wrong", "3 input", "130 interrupted"))


def test_version(capfd: pytest.CaptureFixture[str]) -> None:
    assert main.run(["--version"]) == 0
    assert capfd.readouterr().out == f"floorcast {__version__}\n"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["bogus"], "No such command 'bogus'"),
        (["plan"], "Missing argument 'INPUT'"),
        (["plan", "x.ply"], "Missing option '--out'"),
        (["plan", "x.ply", "--out", "o", "--colour"], "No such option: --colour"),
        (["plan", "x.ply", "--out", "o", "--set", "doors"], "--set needs STAGE.FIELD=VALUE"),
        (["plan", "x.ply", "--out", "o", "--set", "doors.colour=1"], "no setting 'doors.colour'"),
        (["plan", "x.ply", "--out", "o", "--set", "doors.bin=wide"], "Setting doors.bin"),
        (["plan", "x.ply", "--out", "o", "--config", "none.yaml"], "Cannot read the configuration none.yaml"),
        (["watch", "x.ply", "--out", "o", "--every", "-3"], "'--every'"),
        (["watch", "x.ply", "--out", "o", "--every", "soon"], "should be a valid number"),
        (["export", "x"], "Missing option '--to'"),
        (["settings", "--yaml", "--json"], "exclude each other"),
        (["gui"], "There is no display"),
    ],
)
def test_wrong_use_is_status_2(
    arguments: list[str],
    words: str,
    capfd: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")  # wherever the tests run, no window opens
    assert main.run(arguments) == 2
    assert words in one_sentence(capfd.readouterr().err)
    assert list(tmp_path.iterdir()) == []


def test_without_a_command_the_help_is_shown(capfd: pytest.CaptureFixture[str]) -> None:
    assert main.run([]) == 2
    assert "Commands" in capfd.readouterr().out


def bad_inputs(folder: Path) -> dict[str, Path]:
    (folder / "empty.ply").touch()
    (folder / "no_scans").mkdir()
    (folder / "text.ply").write_text("ply me a river\n")
    (folder / "photo.ply").write_bytes(b"\xff\xd8\xff\xe0" + bytes(100))
    header = "ply\nformat binary_little_endian 1.0\nelement vertex 1000\n"
    header += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n"
    (folder / "truncated.ply").write_bytes(header.encode() + bytes(120))
    huge = header.replace("1000", "1000000000000")
    (folder / "huge.ply").write_bytes(huge.encode() + bytes(120))
    (folder / "random.xyz").write_bytes(bytes(range(256)) * 9)
    (folder / "loop.ply").symlink_to("loop.ply")
    os.mkfifo(folder / "pipe.ply")
    return {name: folder / name for name in BAD_INPUTS}


@pytest.mark.parametrize("command", ["plan", "watch"])
@pytest.mark.parametrize(
    "name",
    BAD_INPUTS,
)
def test_input_that_cannot_be_read_is_status_3(
    command: str, name: str, capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = bad_inputs(tmp_path)[name]
    out = tmp_path / "out"
    assert main.run([command, str(path), "--out", str(out)]) == 3
    assert path.name in one_sentence(capfd.readouterr().err)
    assert not out.exists()


def test_a_file_without_permission_is_status_3(
    capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "locked.ply"
    path.write_bytes(b"ply\n")
    original = Path.open

    def locked(self: Path, *args: object, **kwargs: object) -> object:  # root may read everything: pretend
        if self == path:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return original(self, *args, **kwargs)  # type: ignore[call-overload]

    monkeypatch.setattr(Path, "open", locked)
    assert main.run(["plan", str(path), "--out", str(tmp_path / "out")]) == 3
    sentence = one_sentence(capfd.readouterr().err)
    assert "locked.ply" in sentence and "ermission denied" in sentence


@pytest.mark.parametrize(
    ("out", "words"),
    [
        ("file", "a file of this name where a folder is wanted"),
        ("file/deep", "a file, not a folder"),
        ("x" * 300, "too long"),
        ("/proc/nowhere", "/proc/nowhere"),
    ],
)
def test_an_output_folder_that_cannot_be_made_is_status_3(
    out: str, words: str, capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "cloud.xyz").write_text("0 0 0\n")
    assert main.run(["plan", str(tmp_path / "cloud.xyz"), "--out", str(tmp_path / out)]) == 3
    assert words in one_sentence(capfd.readouterr().err)


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (UsageError("Wrong."), 2, "Wrong."),
        (InputError("Bad file."), 3, "Bad file."),
        (OutputError("No space."), 3, "No space."),
        (NoPlanError("No walls."), 4, "No walls."),
        (Cancelled("Interrupted; nothing was written."), 130, "Interrupted"),
        (KeyboardInterrupt(), 130, "Interrupted"),
        (MemoryError(), 4, "not enough memory"),
        (Terminated(), 143, "Terminated"),
        (OSError(errno.ENOSPC, "No space left on device"), 3, "no space left on the disk"),
        (PermissionError(errno.EACCES, "Permission denied", "x.ply"), 3, "x.ply: Permission denied."),
        (ZeroDivisionError("division by zero\nand more"), 4, "unexpected ZeroDivisionError"),
        (AssertionError(), 4, "unexpected AssertionError"),
    ],
)
@pytest.mark.parametrize("debug", [False, True])
def test_every_exception_is_a_sentence_and_a_status(
    error: BaseException,
    status: int,
    words: str,
    debug: bool,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(*_: object) -> int:
        raise error

    monkeypatch.setattr(main, "_invoke", fail)
    assert main.run(["plan", "--json", *["--debug"][: int(debug)]]) == status
    out, err = capfd.readouterr()
    last = err.strip().splitlines()[-1]
    assert words in (last if debug else one_sentence(err))
    assert ("Traceback" in err) == debug
    assert json.loads(out) == {"ok": False, "error": last.removeprefix("floorcast: "), "status": status}


def test_the_sentence_of_an_unexpected_error_keeps_to_one_line() -> None:
    sentence, status = explain(ValueError("first line\nsecond line"))
    assert "first line" in sentence and "second" not in sentence and "--debug" in sentence
    assert status == FloorPlanError.exit_status


def test_without_memory_for_the_words_there_is_a_sentence(
    capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> tuple[str, int]:
        raise MemoryError

    monkeypatch.setattr("floorplan_core.cli.failures.explain", fail)
    monkeypatch.setattr(main, "_invoke", fail)
    assert main.run(["plan"]) == 4
    assert "not enough memory" in one_sentence(capfd.readouterr().err)
    assert "not enough memory" in explain(ImportError("a.so: failed to map segment from shared object"))[0]


def test_a_closed_pipe_is_no_error() -> None:
    command = f"{sys.executable} -m floorplan_core.cli.main settings | head -n 1; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines()[-1] == "0"
    assert done.stderr == ""


@pytest.mark.skipif(os.name != "posix", reason="closed streams")
@pytest.mark.parametrize(("closed", "arguments", "status"), [(1, ["settings"], 0), (2, ["info", "/nope"], 3)])
def test_a_closed_stream_is_no_error(closed: int, arguments: list[str], status: int) -> None:
    command = [sys.executable, "-m", "floorplan_core.cli.main", *arguments]
    done = subprocess.run(command, preexec_fn=lambda: os.close(closed), capture_output=True, text=True)
    assert done.returncode == status
    assert "Traceback" not in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_an_error_that_cannot_be_written_either_is_one_sentence(floorcast) -> None:
    with open("/dev/full", "w") as full:
        done = floorcast("info", "/nope", "--json", stdout=full)
    assert done.returncode == 3
    assert done.stderr == "floorcast: The input /nope does not exist.\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no /dev/full")
def test_a_full_disk_behind_stdout_is_status_3(floorcast) -> None:
    with open("/dev/full", "w") as full:
        done = floorcast("settings", stdout=full)
    assert done.returncode == 3
    assert "no space left" in one_sentence(done.stderr)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_while_importing(number: int, tmp_path: Path) -> None:
    """The signal comes in the middle of an import: the slow module is a plugin of the user."""
    (tmp_path / "slow.py").write_text(
        f"import pathlib, time\npathlib.Path({str(tmp_path / 'here')!r}).touch()\ntime.sleep(60)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-m", "floorplan_core.cli.main", "plugins"],
        env={**os.environ, "FLOORCAST_PLUGINS": str(tmp_path)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while not (tmp_path / "here").exists():
        assert process.poll() is None, process.communicate()
        time.sleep(0.02)
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == ({signal.SIGINT: 130, signal.SIGTERM: 143}[number], "")
    word = "Interrupted" if number == signal.SIGINT else "Terminated"
    assert err == f"floorcast: {word}; nothing was left half-written.\n"


def test_settings_as_yaml_read_back_to_the_same_settings(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    changed = ["--set", "doors.max_width=1.2", "--set", "frame.yaw_deg=12.5", "--set", "input.up=-y"]
    assert main.run(["settings", "--yaml", *changed]) == 0
    file = tmp_path / "mine.yaml"
    file.write_text(capfd.readouterr().out)
    loaded = Config.load(file)
    assert (loaded.doors.max_width, loaded.frame.yaw_deg, loaded.input.up) == (1.2, 12.5, "-y")
    assert yaml.safe_load(file.read_text()) == loaded.model_dump()
    assert main.run(["settings", "--json", "--config", str(file)]) == 0
    assert json.loads(capfd.readouterr().out)["settings"] == loaded.model_dump()


def test_settings_as_a_table_name_every_setting(capfd: pytest.CaptureFixture[str]) -> None:
    assert main.run(["settings"]) == 0
    text = capfd.readouterr().out
    for stage, fields in Config().model_dump().items():
        assert all(f"{stage}.{field} " in text for field in fields)


def test_plugins_as_table_and_json(capfd: pytest.CaptureFixture[str], plugin_folder: Path) -> None:
    (plugin_folder / "broken.py").write_text("1 / 0")
    assert main.run(["plugins"]) == 0
    text = capfd.readouterr().out
    assert "switched off: ZeroDivisionError" in text and "exporter SVG – A drawing" in text
    assert main.run(["plugins", "--json"]) == 0
    out, err = capfd.readouterr()
    listed = {p["name"]: p for p in json.loads(out)["plugins"]}
    assert listed["broken"]["error"] and not listed["broken"]["enabled"]
    assert listed["svg"]["enabled"] and err == ""
    assert listed["carmen"]["about"] == ["CARMEN logs: planar scans with corrected poses, also gzipped"]
    assert main.run(["plugins", "--quiet"]) == 0
    assert capfd.readouterr() == ("", "")


def test_every_command_takes_debug() -> None:
    import typer.main

    command = typer.main.get_command(app.app)
    for name in COMMANDS:
        options = {o for p in command.commands[name].params for o in p.opts}  # type: ignore[attr-defined]
        assert "--debug" in options
        assert name == "gui" or {"--json", "--quiet"} <= options
