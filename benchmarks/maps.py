"""Rooms of occupancy grid maps against their hand-made segmentation: F1, IoU and seconds a map.

The benchmark of Bormann et al. (8 of its 20 maps, beside the checkout), plain and with furniture. The truth
of a map are the connected white areas of its segmentation image; areas below ``SPECK`` are dots of its
drawing. A region is right when its IoU with a true room exceeds 0.5. The settings were chosen on the maps of
``TUNED`` only. Seconds are wall time; the CPU time of the median map stands beside them, for machines that
are busy.
"""

from __future__ import annotations

import statistics
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.record import Outcome

FOLDER = Path(__file__).resolve().parents[1].parent / "shared" / "data" / "maps_room_segmentation"
RESOLUTION = 0.05  # m a pixel, as the authors of the benchmark say
TUNED = ("Freiburg52_scan", "lab_b_scan", "lab_f_scan", "office_b")
VARIANTS = {"plain": "", "furnished": "_furnitures"}
SPECK = 200  # pixels (0.5 m2)
WHITE = 250
MATCH = 0.5  # IoU
PEERS = {"plain": 0.856, "furnished": 0.538}  # best of four classical methods on these maps

Labels = NDArray[np.int32]


@dataclass(frozen=True)
class Score:
    """One map."""

    name: str
    variant: str
    precision: float
    recall: float
    iou: float  # mean over the true rooms of the best overlap
    regions: int
    rooms: int
    seconds: float
    cpu: float  # seconds

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall."""
        both = self.precision + self.recall
        return 2 * self.precision * self.recall / both if both else 0.0


def rooms() -> Outcome:
    """All maps, plain and furnished."""
    title = "rooms of grid maps, F1 at IoU 0.5 (targets 0.90 plain, 0.75 furnished, median under 1 s)"
    if not FOLDER.is_dir():
        return Outcome(title, skipped="the maps are not beside the checkout (../shared/data)")
    names = sorted(p.name.removesuffix("_gt_segmentation.png") for p in FOLDER.glob("*_gt_segmentation.png"))
    measure(names[0], "plain")  # compiles the kernels
    scores = [measure(name, variant) for variant in VARIANTS for name in names]
    rows = [
        (
            f"{s.name} {s.variant}",
            f"{s.f1:.3f}",
            f"{s.precision:.3f}",
            f"{s.recall:.3f}",
            f"{s.iou:.3f}",
            f"{s.regions}/{s.rooms}",
            f"{s.seconds:.2f}",
            "yes" if s.name in TUNED else "no",
        )
        for s in scores
    ]
    header = ("map", "F1", "precision", "recall", "mean IoU", "regions/rooms", "s", "tuned on")
    note = "Best of four classical methods on these maps: " + ", ".join(f"{v} {k}" for k, v in PEERS.items())
    return Outcome(title, header, rows, _figures(scores), (f"{note}.",))


def measure(name: str, variant: str) -> Score:
    """Plan one map and compare; the seconds are those of reading and planning."""
    from floorplan_core.exporters.label_image import region_labels
    from floorplan_core.grid_pipeline import plan_grid_map
    from floorplan_core.readers.grid_map import read_grid_map

    began, busy = time.perf_counter(), time.process_time()
    plan = plan_grid_map(read_grid_map(FOLDER / f"{name}{VARIANTS[variant]}.png", RESOLUTION))
    seconds, cpu = time.perf_counter() - began, time.process_time() - busy
    overlap = iou_table(region_labels(plan), true_rooms(FOLDER / f"{name}_gt_segmentation.png"))
    regions, areas = overlap.shape
    found = int((overlap > MATCH).sum())  # above one half a match is one to one
    best = float(overlap.max(axis=0, initial=0.0).mean())
    return Score(name, variant, found / max(regions, 1), found / areas, best, regions, areas, seconds, cpu)


def true_rooms(path: Path) -> Labels:
    """(ny, nx) the connected white areas of a segmentation image from 1; row 0 is the picture's bottom."""
    from PIL import Image
    from scipy.ndimage import label

    with Image.open(path) as picture:
        white = np.asarray(picture.convert("L")) > WHITE
    labels = np.asarray(label(white[::-1])[0], dtype=np.int32)
    large = np.bincount(labels.ravel()) >= SPECK
    large[0] = False
    return np.where(large, np.cumsum(large), 0).astype(np.int32)[labels]


def iou_table(regions: Labels, truth: Labels) -> NDArray[np.float64]:
    """(R, T) intersection over union of every region and every true room."""
    shape = int(regions.max()) + 1, int(truth.max()) + 1
    pairs = np.bincount((regions.astype(np.int64) * shape[1] + truth).ravel(), minlength=shape[0] * shape[1])
    shared = pairs.reshape(shape).astype(np.float64)
    union = shared.sum(axis=1)[:, None] + shared.sum(axis=0)[None, :] - shared
    return (shared / np.maximum(union, 1.0))[1:, 1:]


def _figures(scores: list[Score]) -> dict[str, float]:
    """Means over the maps, over each half, and the time of the median map."""
    figures: dict[str, float] = {}
    for variant in VARIANTS:
        mine = [s for s in scores if s.variant == variant]
        halves = {"": mine, ", tuned half": [s for s in mine if s.name in TUNED]}
        halves[", other half"] = [s for s in mine if s.name not in TUNED]
        figures |= {
            f"F1 {variant}{k}": statistics.fmean(s.f1 for s in half) for k, half in halves.items() if half
        }
        figures[f"mean IoU {variant}"] = statistics.fmean(s.iou for s in mine)
        figures[f"median s {variant}"] = statistics.median(s.seconds for s in mine)
        figures[f"median CPU s {variant}"] = statistics.median(s.cpu for s in mine)
    return figures
