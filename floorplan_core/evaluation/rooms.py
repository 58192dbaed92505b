"""Regions against true rooms: one-to-one matching by intersection over union, labels, merges and splits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from floorplan_core.evaluation.plan_file import PlanRegion
from floorplan_core.evaluation.truth import Exposure, TruthRoom

MATCH_IOU = 0.5
STRICT_IOU = 0.75
MAJORITY = 0.5  # a region holds a room, or lies in it, by more than half of the area
SPLIT_SHARE = 0.05  # parts below this share of the room are slivers, not a split
Float = NDArray[np.float64]


@dataclass(frozen=True)
class Overlap:
    """Areas shared by regions and rooms."""

    shared: Float  # (R, T) m2
    regions: Float  # (R,) m2
    rooms: Float  # (T,) m2

    @property
    def iou(self) -> Float:
        """(R, T) intersection over union."""
        union = self.regions[:, None] + self.rooms[None, :] - self.shared
        return np.divide(self.shared, union, out=np.zeros_like(self.shared), where=union > 0)


@dataclass(frozen=True)
class RoomMatch:
    """A true room and the region that was matched to it."""

    room: str
    exposure: Exposure
    region: str  # id; "" where none overlaps
    iou: float
    kind: str | None
    label: str


@dataclass(frozen=True)
class RoomScores:
    """Room detection over one class of rooms."""

    rooms: int
    regions: int  # regions that count: not those in hidden rooms
    found: int  # at IoU 0.5
    precision: float
    recall: float
    f1: float
    precision_75: float
    recall_75: float
    f1_75: float
    mean_iou: float  # over all true rooms of the class, 0 where missed
    min_iou: float
    worst: str  # name of the room of the smallest IoU


def overlap(regions: Sequence[PlanRegion], rooms: Sequence[TruthRoom]) -> Overlap:
    """Exact areas of all intersections (same axes)."""
    import shapely

    a = np.array([r.polygon for r in regions], dtype=object)
    b = np.array([t.polygon for t in rooms], dtype=object)
    shared = np.zeros((len(a), len(b)))
    if len(a) and len(b):
        shared = shapely.area(shapely.intersection(a[:, None], b[None, :]))
    return Overlap(shared, _areas(a), _areas(b))


def _areas(polygons: NDArray[np.object_]) -> Float:
    import shapely

    return np.asarray(shapely.area(polygons), dtype=np.float64) if len(polygons) else np.zeros(0)


def match_rooms(
    regions: Sequence[PlanRegion], rooms: Sequence[TruthRoom], areas: Overlap
) -> tuple[RoomMatch, ...]:
    """The assignment of largest total IoU, one row for each true room in their order."""
    from scipy.optimize import linear_sum_assignment

    iou = areas.iou
    rows, columns = linear_sum_assignment(iou, maximize=True) if iou.size else ((), ())
    partner = {int(c): int(r) for r, c in zip(rows, columns, strict=True) if iou[r, c] > 0}
    return tuple(_match(room, regions, partner.get(t), iou[:, t]) for t, room in enumerate(rooms))


def _match(room: TruthRoom, regions: Sequence[PlanRegion], row: int | None, iou: Float) -> RoomMatch:
    if row is None:
        return RoomMatch(room.name, room.exposure, "", 0.0, room.kind, "")
    region = regions[row]
    return RoomMatch(room.name, room.exposure, region.id, min(1.0, float(iou[row])), room.kind, region.label)


def room_scores(
    matches: Sequence[RoomMatch], homes: Sequence[Exposure | None], classes: Sequence[Exposure]
) -> RoomScores | None:
    """Precision, recall and IoU over the rooms of ``classes``; None where there are none.

    ``homes`` says for each region in which class of room most of it lies (None: in no room). A region that
    matches no room counts against the class in which it lies, and against the entered rooms where in none.
    """
    wanted = [m for m in matches if m.exposure in classes]
    if not wanted:
        return None
    regions = sum(h in classes or (h is None and "entered" in classes) for h in homes)
    worst = min(wanted, key=lambda m: m.iou)
    at_half, strict = (
        scores(hits, max(regions, hits), len(wanted))
        for hits in (sum(m.iou >= limit for m in wanted) for limit in (MATCH_IOU, STRICT_IOU))
    )
    mean = float(np.mean([m.iou for m in wanted]))
    found = sum(m.iou >= MATCH_IOU for m in wanted)
    return RoomScores(len(wanted), regions, found, *at_half, *strict, mean, worst.iou, worst.room)


def scores(found: int, predicted: int, true: int) -> tuple[float, float, float]:
    """Precision, recall, F1; nothing predicted where nothing is true is perfect."""
    precision = found / predicted if predicted else float(not true)
    recall = found / true if true else 1.0
    f1 = 2 * precision * recall / (precision + recall) if precision + recall else 0.0
    return precision, recall, f1


def region_homes(rooms: Sequence[TruthRoom], areas: Overlap) -> tuple[Exposure | None, ...]:
    """For each region the class of the room that holds most of it; None where it lies in no room."""
    best = areas.shared.argmax(axis=1) if len(rooms) else np.zeros(len(areas.regions), dtype=int)
    inside = areas.shared.max(axis=1, initial=0.0) > 0
    return tuple(rooms[t].exposure if ok else None for t, ok in zip(best, inside, strict=True))


def merged_regions(rooms: Sequence[TruthRoom], areas: Overlap) -> int:
    """Regions that hold most of at least two rooms which a plan should keep apart."""
    expected = np.array([r.exposure != "hidden" for r in rooms], dtype=bool)
    holds = areas.shared[:, expected] > MAJORITY * areas.rooms[None, expected]
    return int((holds.sum(axis=1) >= 2).sum())


def split_rooms(areas: Overlap) -> int:
    """Rooms in which at least two regions lie for the most part (slivers aside)."""
    inside = areas.shared > MAJORITY * areas.regions[:, None]
    real = areas.shared > SPLIT_SHARE * areas.rooms[None, :]
    return int(((inside & real).sum(axis=0) >= 2).sum())


def label_accuracy(matches: Sequence[RoomMatch]) -> tuple[int, int]:
    """(right, judged) labels over rooms matched at IoU 0.5 whose kind is known."""
    judged = [m for m in matches if m.iou >= MATCH_IOU and m.kind is not None and m.exposure != "hidden"]
    return sum(m.label == m.kind for m in judged), len(judged)
