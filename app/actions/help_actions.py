"""The Help menu: the palette, shortcuts, languages, whose work is in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.actions.registry import Action

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


def palette(workbench: Workbench) -> None:
    """Find a command or a setting by some of its letters."""
    workbench.ui.show("palette")


def shortcuts(workbench: Workbench) -> None:
    """All shortcuts and gestures on one sheet."""
    workbench.ui.show("shortcuts")


def about(workbench: Workbench) -> None:
    """Version and licences."""
    workbench.ui.show("about")


def language(workbench: Workbench, name: str) -> None:
    """Speak another language from now on."""
    workbench.preferences.set("language", name)


ACTIONS: tuple[Action, ...] = (
    Action(
        "help.palette",
        "Find a command…",
        palette,
        "Type some letters of a command or a setting, press Enter.",
        "Ctrl+K | Ctrl+Shift+P",
        "command",
    ),
    Action(
        "help.shortcuts", "Shortcuts", shortcuts, "All shortcuts and gestures on one sheet.", "F1", "keyboard"
    ),
    Action(
        "help.english",
        "English",
        lambda w: language(w, "en"),
        "Speak English.",
        "",
        "languages",
    ),
    Action(
        "help.german",
        "Deutsch",
        lambda w: language(w, "de"),
        "Speak German.",
        "",
        "languages",
    ),
    Action("help.about", "About Floorcast", about, "Version and licences.", "", "info"),
)
