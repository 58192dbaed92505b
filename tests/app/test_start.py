"""The first window waits for nothing that it does not show."""

from __future__ import annotations

import subprocess
import sys

import pytest

BEFORE_THE_WINDOW = """
import sys
import floorcast_app.main_window, floorcast_app.workers.remote_planner
print([name for name in sys.argv[1:] if name in sys.modules])
"""


@pytest.mark.parametrize(
    "heavy", [("numba", "scipy", "cv2", "open3d"), ("matplotlib", "ezdxf", "reportlab", "trimesh", "laspy")]
)
def test_the_window_imports_nothing_heavy(heavy: tuple[str, ...]) -> None:
    command = [sys.executable, "-c", BEFORE_THE_WINDOW, *heavy]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"
