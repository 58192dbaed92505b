"""The colours of the light and the dark theme, as data. No Qt.

Those of the data are the paper's (planes red and green, free white, predicted grey, rooms cyan, corridors
magenta, doors yellow), softened, and told apart by colour-blind eyes by lightness as well as hue.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Colours:
    """One theme, each "#rrggbb"."""

    window: str  # behind the panels
    panel: str
    line: str  # hairlines
    text: str
    muted: str
    accent: str
    canvas: str  # ground of the plan panes
    plane_ns: str  # planes that face north or south: the paper's green
    plane_ew: str  # planes that face east or west: the paper's red
    free: str
    predicted: str
    occupied: str
    unobserved: str
    room: str
    corridor: str
    other: str
    door: str
    wall: str
    selection: str
    hover: str
    warning: str
    error: str
    raised: str  # under the pointer, chips
    stripe: str  # every second row of a table
    field: str  # ground of what is typed into
    faint: str  # disabled text
    line_strong: str  # borders of fields
    accent_hover: str
    accent_soft: str  # tint of the accent: selected rows, banners
    on_accent: str  # text on the accent
    warning_soft: str
    tip: str
    tip_text: str

    def region(self, label: str) -> str:
        """Fill of a region with this label; one neutral tone for labels that the paper does not know."""
        return {"room": self.room, "corridor": self.corridor}.get(label, self.other)


LIGHT = Colours(
    window="#f2f4f6",
    panel="#ffffff",
    line="#e1e6ea",
    text="#1b2530",
    muted="#5d6a76",
    accent="#0f7285",
    canvas="#fafbfc",
    plane_ns="#178a5f",
    plane_ew="#d1453b",
    free="#ffffff",
    predicted="#bcc5cd",
    occupied="#141a20",
    unobserved="#4a5661",
    room="#c9e9ee",
    corridor="#f3cfe2",
    other="#e6e1cf",
    door="#f5cb3d",
    wall="#2b343d",
    selection="#1d5fe0",
    hover="#6b9cf5",
    warning="#a15c07",
    error="#c02b2b",
    raised="#eef1f4",
    stripe="#f8f9fb",
    field="#ffffff",
    faint="#a3adb7",
    line_strong="#cbd3da",
    accent_hover="#0c5f6f",
    accent_soft="#dff0f3",
    on_accent="#ffffff",
    warning_soft="#fdf1dc",
    tip="#1b2530",
    tip_text="#f2f5f7",
)

DARK = Colours(
    window="#12171c",
    panel="#1a2026",
    line="#2a323a",
    text="#e4e9ee",
    muted="#94a1ad",
    accent="#3fb3c8",
    canvas="#151a20",
    plane_ns="#3fc490",
    plane_ew="#f0736a",
    free="#e9edf0",
    predicted="#8a959f",
    occupied="#05080a",
    unobserved="#303a43",
    room="#1f5660",
    corridor="#66305a",
    other="#4b4736",
    door="#e6b93c",
    wall="#d3dbe2",
    selection="#6ea3ff",
    hover="#4a79c9",
    warning="#f0b45a",
    error="#ff7b74",
    raised="#252d35",
    stripe="#1d242a",
    field="#141a1f",
    faint="#5f6b76",
    line_strong="#3b4650",
    accent_hover="#5cc6d9",
    accent_soft="#17373e",
    on_accent="#06222a",
    warning_soft="#3a2d16",
    tip="#e4e9ee",
    tip_text="#161c22",
)

THEMES = {"light": LIGHT, "dark": DARK}
