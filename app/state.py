"""What a document is: one frozen value. An edit makes a new one; undo goes back to the old. No Qt.

Positions are in the *local* frame of the survey (metres, z up, without the large world offset), so that they
mean the same place after a rerun that turned the Manhattan frame by a hair.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

from floorplan_core.config import Config
from floorplan_core.model.corrections import Correction

Point = tuple[float, float]


@dataclass(frozen=True)
class SurveyRef:
    """An input by reference."""

    path: Path
    trajectory: Path | None = None
    digest: str = ""  # of its content (floorplan_core.project_file.digest); "" until it was read


@dataclass(frozen=True)
class Check:
    """A row of the ground-truth table: a distance on the plan and what the laser meter said."""

    id: str  # "c1"
    start: Point  # metres, local frame
    end: Point
    measured: float | None = None  # metres by the laser meter; None until typed in
    note: str = ""


@dataclass(frozen=True)
class StoreyEdits:
    """What was said about a storey that is not the one shown."""

    storey: int
    corrections: tuple[Correction, ...] = ()
    checks: tuple[Check, ...] = ()


@dataclass(frozen=True)
class DocumentState:
    """Everything that undo brings back."""

    survey: SurveyRef | None = None
    config: Config = field(default_factory=Config)
    corrections: tuple[Correction, ...] = ()  # of the storey that is shown
    checks: tuple[Check, ...] = ()  # of the storey that is shown
    storey: int = 0  # the one that is shown; 0 is the lowest
    elsewhere: tuple[StoreyEdits, ...] = ()  # of the other storeys, by number; none that says nothing

    def on_storey(self, number: int) -> DocumentState:
        """The same document with another storey shown: a correction names a place, which every storey has."""
        mine = StoreyEdits(self.storey, self.corrections, self.checks)
        edits = {e.storey: e for e in (*self.elsewhere, mine)}
        shown = edits.pop(number, StoreyEdits(number))
        others = tuple(edits[k] for k in sorted(edits) if edits[k].corrections or edits[k].checks)
        return replace(
            self, storey=number, corrections=shown.corrections, checks=shown.checks, elsewhere=others
        )
