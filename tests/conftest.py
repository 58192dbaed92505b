"""What all tests share: repeatable property tests, no plugins of one's own, a command runner."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# No deadlines (a loaded machine is no failure) and the same examples every time.
settings.register_profile(
    "repeatable", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")

Runner = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(autouse=True, scope="session")
def interruptible() -> None:
    """Shells start background jobs deaf to Ctrl-C, and their children inherit that; some tests need it."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def plugin_folder(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Path]:
    """An empty folder in place of the user's own plugins, and a registry that has not looked yet."""
    from floorplan_core.plugins import default_registry

    folder = tmp_path_factory.mktemp("plugins")
    monkeypatch.setenv("FLOORCAST_PLUGINS", str(folder))
    default_registry.cache_clear()
    yield folder
    default_registry.cache_clear()


@pytest.fixture
def floorcast(tmp_path: Path) -> Runner:
    """Runs ``floorcast`` as a program of its own, in ``tmp_path`` and without any input."""

    def run(*arguments: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "floorplan_core.cli.main", *map(str, arguments)]
        given = {
            "cwd": tmp_path,
            "env": {**os.environ, "COLUMNS": "160"},
            "stdin": subprocess.DEVNULL,
            "stdout": subprocess.PIPE,
            "stderr": subprocess.PIPE,
            "text": True,
            "timeout": 300,
        }
        return subprocess.run(command, check=False, **{**given, **options})  # type: ignore[call-overload]

    return run
