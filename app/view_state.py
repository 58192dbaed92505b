"""How things are looked at: saved with the project, never part of undo. No Qt."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from floorcast_app.events import Event

LAYERS = ("points", "trajectory", "planes", "free_space", "doors", "regions", "dimensions")
POINT_COLOURS = ("height", "facing", "plane", "intensity", "rgb")


@dataclass(frozen=True)
class Look:
    """One frozen value for the whole look, so that it saves and compares as one."""

    centre: tuple[float, float] = (0.0, 0.0)  # metres, manhattan frame: what all panes are centred on
    span: float = 20.0  # metres across the shorter side of a pane
    azimuth: float = -60.0  # degrees, of the 3D camera about z
    elevation: float = 55.0  # degrees above the floor
    layers: frozenset[str] = frozenset(LAYERS)  # those shown
    facings: frozenset[int] = frozenset((0, 1, 2, 3))  # Facing values of the planes shown
    hidden: frozenset[tuple[str, str]] = frozenset()  # (kind, id) with the eye shut
    point_colour: str = "height"  # one of POINT_COLOURS
    ceiling_cut: float | None = 2.2  # metres above the floor; None: nothing is cut
    section: tuple[float, float, float, float] | None = None  # x0, y0, x1, y1 of the section box, manhattan
    units: str = "m"  # "m" or "ft-in"
    scale_bar: bool = True  # in the plan panes
    theme: str = "light"  # "light" or "dark"
    workspace: str = "inspect"  # "inspect", "plan" or "run"


def turned_only(*told: object) -> bool:
    """True where what a listener was told is that the 3D camera was turned: no other pane shows it."""
    before, after = told if len(told) == 2 else (None, None)
    if not isinstance(before, Look) or not isinstance(after, Look):
        return False
    return replace(before, azimuth=after.azimuth, elevation=after.elevation) == after


class ViewState:
    """Holds a :class:`Look` and tells when it changes."""

    def __init__(self) -> None:
        self.look = Look()
        self.room: tuple[float, float] | None = None  # pixels of the plan's pane, where there is one
        self.fitted: tuple[tuple[float, float], float] | None = None  # all in view
        self.changed = Event()  # (before: Look, after: Look)

    @property
    def is_fitted(self) -> bool:
        """True while nobody has moved the camera since the whole plan was brought into view."""
        return self.fitted == (self.look.centre, self.look.span)

    def set(self, **values: Any) -> None:
        """Change some of the look's fields."""
        self.put(replace(self.look, **values))

    def put(self, look: Look) -> None:
        """Change the whole look."""
        before, self.look = self.look, look
        if look != before:
            self.changed.emit(before, look)
