"""What the tests of the shipped readers share: opening through the registry, damage, memory."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import FloorPlanError, InputError
from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import default_registry
from floorplan_core.readers import open_survey

AS_IT_IS = InputConfig(unit="m", up="z")
MEMORY = 200 << 20  # bytes that a damaged file may take above the good one
SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def shared(name: str) -> Path:
    """A file of the surveys beside the checkout; skips the test without them."""
    path = SHARED / name
    if not path.exists():
        pytest.skip(f"the surveys beside the checkout are absent ({name})")
    return path


def opened(
    path: Path, observer: Observer | None = None, trajectory: Path | None = None, **how
) -> Reconstruction:
    """Opened like the command line does it: by content, with every plugin behind its guard."""
    config = InputConfig(**how) if how else AS_IT_IS
    return open_survey(path, trajectory, config, observer, default_registry())


def whole(survey: Reconstruction):
    """(points, scan ids or None) of one pass."""
    chunks = list(survey.chunks())
    ids = [c.scan_id for c in chunks if c.scan_id is not None]
    return np.concatenate([c.points for c in chunks]), np.concatenate(ids) if ids else None


def refusal(path: Path, **how) -> str:
    """The one sentence with which a file is refused."""
    with pytest.raises(InputError) as caught:
        for _ in opened(path, **how).chunks():
            pass
    text = str(caught.value)
    assert text.endswith(".")
    assert "\n" not in text
    assert "switched off" not in text
    return text


def same_points(found, wanted, tolerance: float) -> None:
    """Each point of one cloud has one of the other within ``tolerance`` and they are as many."""
    from scipy.spatial import cKDTree

    assert len(found) == len(wanted)
    for a, b in ((found, wanted), (wanted, found)):
        assert cKDTree(a).query(b)[0].max() <= tolerance


def damages(data: bytes, cuts: int = 20, flips: int = 50, head: int = 400) -> Iterator[bytes]:
    """The file cut at ``cuts`` places, then with one byte changed at ``flips``, half of them in its head."""
    rng = np.random.default_rng(7)
    for cut in np.unique(np.linspace(0, len(data) - 1, cuts).astype(int)).tolist():
        yield data[:cut]
    places = np.concatenate(
        [rng.integers(0, min(head, len(data)), flips // 2), rng.integers(0, len(data), flips - flips // 2)]
    )
    for place in places.tolist():
        changed = bytearray(data)
        changed[place] ^= int(rng.integers(1, 256))
        yield bytes(changed)


def survives(path: Path, folder: Path, limit: int = 3_000_000, **how) -> int:
    """Read every damaged version of ``path``: only FloorPlanError may come out. How many were refused."""
    data = path.read_bytes()
    for _ in opened(path, **how).chunks():  # what reading takes at all: modules, compiled kernels
        pass
    before = peak_memory(reset=True)
    refused = 0
    for number, bad in enumerate(damages(data)):
        target = folder / f"bad{number}_{path.name}"
        target.write_bytes(bad)
        try:
            total = 0
            for chunk in opened(target, **how).chunks():
                total += len(chunk.points)
                if total > limit:
                    break
        except FloorPlanError as error:
            refused += 1
            assert "\n" not in str(error)
            assert "switched off" not in str(error), str(error)
        target.unlink()
    assert not default_registry().failures()
    after = peak_memory()
    assert after - before < MEMORY, f"{(after - before) >> 20} MB"
    return refused


def peak_memory(reset: bool = False) -> int:
    """Bytes that this process held at most since the last reset; 0 where the system does not tell."""
    try:
        if reset:
            Path("/proc/self/clear_refs").write_text("5")
        status = Path("/proc/self/status").read_text()
    except OSError:
        return 0
    line = next((row for row in status.splitlines() if row.startswith("VmHWM")), "VmHWM: 0")
    return int(line.split()[1]) << 10
