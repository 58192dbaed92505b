"""The result of an evaluation: one frozen record, as a dictionary, as table rows, as one line."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from floorplan_core.evaluation.dimensions import DimensionScores, MeasuredDimension
from floorplan_core.evaluation.doors import DoorScores
from floorplan_core.evaluation.free_space import FreeSpaceScores
from floorplan_core.evaluation.rooms import RoomMatch, RoomScores
from floorplan_core.evaluation.voxel_corridor import CORRIDOR_LENGTH, CORRIDOR_WIDTH

Row = tuple[str, str, str]  # what, value, remark


@dataclass(frozen=True)
class EvaluationReport:
    """A plan compared with a ground truth; a part is None where the truth does not hold it."""

    plan: str
    truth: str
    dimensions: DimensionScores | None  # in rooms that were entered
    dimensions_all: DimensionScores | None
    rooms: RoomScores | None  # entered and glimpsed
    rooms_entered: RoomScores | None
    rooms_glimpsed: RoomScores | None
    merged: int  # regions that hold several rooms
    split: int  # rooms cut into several regions
    labels_right: int
    labels_judged: int
    doors: DoorScores | None
    free_space: FreeSpaceScores | None
    yaw_error_deg: float | None  # modulo 90 degrees, absolute
    matches: tuple[RoomMatch, ...] = ()
    measured: tuple[MeasuredDimension, ...] = ()

    @property
    def label_accuracy(self) -> float | None:
        """Share of right labels over matched rooms."""
        return self.labels_right / self.labels_judged if self.labels_judged else None

    def as_dict(self) -> dict[str, Any]:
        """Everything, ready for JSON."""
        return {**asdict(self), "label_accuracy": self.label_accuracy}

    def rows(self) -> list[Row]:
        """What, value and remark, for a table."""
        return [
            *_dimension_rows("Dimensions", self.dimensions),
            *_dimension_rows(
                "Dimensions, glimpsed rooms included", _if_other(self.dimensions_all, self.dimensions)
            ),
            *_corridor_rows(self.measured),
            *_room_rows("Rooms", self.rooms),
            *_room_rows("Rooms entered", _if_other(self.rooms_entered, self.rooms)),
            *_room_rows("Rooms glimpsed", self.rooms_glimpsed),
            *self._count_rows(),
            *_door_rows(self.doors),
            *_free_rows(self.free_space),
            *(
                []
                if self.yaw_error_deg is None
                else [("Yaw error", f"{self.yaw_error_deg:.3f}°", "modulo 90°")]
            ),
        ]

    def _count_rows(self) -> list[Row]:
        if self.rooms is None:
            return []
        labels = f"{self.labels_right} of {self.labels_judged}"
        return [
            (
                "Rooms merged / split",
                f"{self.merged} / {self.split}",
                "regions over several rooms / rooms cut up",
            ),
            ("Labels right", _share(self.label_accuracy), labels),
        ]

    def summary(self) -> str:
        """One line."""
        parts = []
        if self.dimensions is not None and self.dimensions.mean_m is not None:
            parts.append(f"dimensions {self.dimensions.mean_m:.3f} m ({self.dimensions.mean_percent:.2f} %)")
        if self.rooms is not None:
            parts.append(f"rooms F1 {self.rooms.f1:.2f}, mean IoU {self.rooms.mean_iou:.2f}")
        if self.doors is not None:
            parts.append(f"doors P {self.doors.precision:.2f} R {self.doors.recall:.2f}")
        if self.free_space is not None:
            parts.append(
                f"free space P {_share(self.free_space.precision)} R {_share(self.free_space.recall)}"
            )
        return f"{self.plan} against {self.truth}: {'; '.join(parts) or 'nothing to compare'}"


def _if_other(scores: Any, shown: Any) -> Any:
    return None if scores == shown else scores


def _share(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def _dimension_rows(title: str, scores: DimensionScores | None) -> list[Row]:
    if scores is None:
        return []
    share = f"{scores.measured} of {scores.total} measured"
    if scores.mean_m is None:
        return [(title, "-", share)]
    return [
        (f"{title}: mean error", f"{scores.mean_m:.3f} m ({scores.mean_percent:.2f} %)", share),
        (f"{title}: median error", f"{scores.median_m:.3f} m ({scores.median_percent:.2f} %)", ""),
        (f"{title}: largest error", f"{scores.max_m:.3f} m ({scores.max_percent:.2f} %)", scores.worst),
    ]


def _corridor_rows(measured: tuple[MeasuredDimension, ...]) -> list[Row]:
    """The corridor that was measured in voxels: its length, and the median of its widths."""
    rows = []
    for title, start in (("Corridor: length", CORRIDOR_LENGTH), ("Corridor: width, median", CORRIDOR_WIDTH)):
        found = [(m.plan, m.truth) for m in measured if m.plan is not None and m.id.startswith(start)]
        if found:
            plan, truth = (median(values) for values in zip(*found, strict=True))
            rows.append((title, f"{plan:.2f} m", f"truth {truth:.2f} m"))
    return rows


def _room_rows(title: str, scores: RoomScores | None) -> list[Row]:
    if scores is None:
        return []
    half = f"{scores.precision:.3f} / {scores.recall:.3f} / {scores.f1:.3f}"
    strict = f"{scores.precision_75:.3f} / {scores.recall_75:.3f} / {scores.f1_75:.3f}"
    worst = f"worst {scores.min_iou:.3f} (room {scores.worst})"
    return [
        (
            f"{title}: P / R / F1 at IoU 0.5",
            half,
            f"{scores.found} of {scores.rooms}, {scores.regions} regions",
        ),
        (f"{title}: P / R / F1 at IoU 0.75", strict, ""),
        (f"{title}: mean IoU", f"{scores.mean_iou:.3f}", worst),
    ]


def _door_rows(scores: DoorScores | None) -> list[Row]:
    if scores is None:
        return []
    counts = f"{scores.found} of {scores.required}, {scores.judged} reported"
    rows = [("Doors: P / R / F1", f"{scores.precision:.3f} / {scores.recall:.3f} / {scores.f1:.3f}", counts)]
    if scores.mean_width_error_m is not None:
        worst = f"largest {scores.max_width_error_m:.3f} m"
        rows.append(("Doors: mean width error", f"{scores.mean_width_error_m:.3f} m", worst))
    if scores.openings:
        rows.append(("Wide openings found", f"{scores.openings_found} of {scores.openings}", ""))
    if scores.windows_as_doors or scores.optional_found:
        remark = "shut, exterior or unlisted ones do not count"
        rows.append(
            (
                "Windows as doors / optional doors",
                f"{scores.windows_as_doors} / {scores.optional_found}",
                remark,
            )
        )
    return rows


def _free_rows(scores: FreeSpaceScores | None) -> list[Row]:
    if scores is None:
        return []
    value = f"{_share(scores.precision)} / {_share(scores.recall)}"
    rows = [("Free space: P / R", value, f"plan {scores.plan_m2:.1f} m², truth {scores.truth_m2:.1f} m²")]
    if scores.outside_m2 is not None:
        rows.append(
            ("Outside the building", f"{scores.outside_m2:.2f} m² ({scores.outside_percent:.2f} %)", "")
        )
    if scores.predicted_m2:
        remark = f"{_share(scores.predicted_right)} of it right"
        rows.append(("Predicted, not seen", f"{scores.predicted_m2:.1f} m²", remark))
    return rows
