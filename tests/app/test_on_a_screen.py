"""The window on a real (virtual) screen: the xcb platform, not the offscreen one."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SAMPLE = Path(__file__).resolve().parents[2] / "resources" / "sample_survey"
PROGRAM = """
import sys, time
from PySide6.QtGui import QGuiApplication
from floorcast_app.main import make_application, make_window
from floorcast_app.script import ScriptedApplication

app = make_application()
assert QGuiApplication.platformName() == "xcb", QGuiApplication.platformName()
window = make_window(unattended=True)
window.show()
app.processEvents()
assert window.isVisible() and window.windowHandle().isExposed()
script = ScriptedApplication(window)
script.run("file.open", path=sys.argv[1])
assert len(window.workbench.plan.regions) >= 10
picture = window.grab()
assert picture.save(sys.argv[2])
window.close()
"""


@pytest.mark.skipif(not shutil.which("Xvfb"), reason="needs Xvfb, which 'make setup' installs where it may")
def test_a_survey_on_an_x_server(tmp_path: Path) -> None:
    picture = tmp_path / "window.png"
    reader, writer = os.pipe()
    with subprocess.Popen(
        ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
        pass_fds=[writer],
        stderr=subprocess.DEVNULL,
    ) as server:
        os.close(writer)
        try:
            display = os.read(reader, 16).decode().strip()
            done = subprocess.run(
                [sys.executable, "-c", PROGRAM, str(SAMPLE), str(picture)],
                env={**os.environ, "DISPLAY": f":{display}", "QT_QPA_PLATFORM": "xcb"},
                capture_output=True,
                text=True,
                timeout=240,
                check=False,
            )
        finally:
            server.terminate()
            os.close(reader)
    assert done.returncode == 0, done.stderr
    assert picture.stat().st_size > 20_000
