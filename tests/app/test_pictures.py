"""The panes look as they did when somebody last looked: structural similarity with accepted pictures.

``python -m tests.app.test_pictures`` writes the pictures anew; look at each before it is committed.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import gaussian_filter

from floorcast_app.main import make_application, make_window
from floorcast_app.main_window import MainWindow
from floorcast_app.script import ScriptedApplication
from tests.app.pump import SAMPLE

ACCEPTED = Path(__file__).parent / "pictures"
PANES = ("space", "planes", "free_space", "floor_plan", "evidence")
SIZE = (480, 360)
LEAST = 0.9  # similarity: a moved label costs 0.02, another colour or a missing layer 0.1 and more


def similarity(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Mean structural similarity (Wang et al. 2004) of two grey pictures with values 0 to 255."""
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2

    def mean(image: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(gaussian_filter(image, 1.5))

    ma, mb = mean(a), mean(b)
    va, vb, cov = mean(a * a) - ma**2, mean(b * b) - mb**2, mean(a * b) - ma * mb
    ssim = (2 * ma * mb + c1) * (2 * cov + c2) / ((ma**2 + mb**2 + c1) * (va + vb + c2))
    return float(ssim.mean())


def compare(a: Path, b: Path) -> float:
    """The lowest similarity of the three colours."""
    first, second = (np.asarray(Image.open(p).convert("RGB"), dtype=np.float64) for p in (a, b))
    assert first.shape == second.shape
    return min(similarity(first[..., k], second[..., k]) for k in range(3))


def sample_window() -> MainWindow:
    """The bundled survey with its surest door selected."""
    from floorcast_app.selection import Item

    make_application()
    window = make_window(unattended=True)
    window.resize(1440, 900)
    window.show()
    ScriptedApplication(window).run("file.open", path=SAMPLE)
    door = max(window.workbench.plan.doors, key=lambda d: d.confidence)
    window.workbench.selection.select(Item("door", door.id))
    return window


@pytest.fixture(scope="module")
def window() -> Iterator[MainWindow]:
    made = sample_window()
    yield made
    made.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("pane", PANES)
def test_a_pane_looks_as_accepted(window: MainWindow, tmp_path: Path, pane: str, theme: str) -> None:
    window.workbench.view.set(theme=theme)
    picture = tmp_path / "now.png"
    window.save_picture(picture, pane, *SIZE)
    assert compare(picture, ACCEPTED / f"{pane}-{theme}.png") > LEAST


def test_another_picture_is_told_apart() -> None:
    light, dark = ACCEPTED / "floor_plan-light.png", ACCEPTED / "planes-light.png"
    assert compare(light, light) > 0.999 and compare(light, dark) < LEAST


def write_accepted() -> None:
    """The pictures as they are now."""
    ACCEPTED.mkdir(exist_ok=True)
    window = sample_window()
    for theme in ("light", "dark"):
        window.workbench.view.set(theme=theme)
        for pane in PANES:
            window.save_picture(ACCEPTED / f"{pane}-{theme}.png", pane, *SIZE)
    window.close()


if __name__ == "__main__":
    write_accepted()
