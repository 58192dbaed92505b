"""What a person said of a thing, and what the machine had said. No Qt."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench

WORDS = {
    "hidden": "Switched off by hand",
    "kept": "Kept by hand",
    "moved": "Moved by hand",
    "added": "Added by hand",
    "accepted": "Accepted by hand",
    "resized": "Resized by hand",
    "split": "Split by hand",
    "merged": "Merged by hand",
    "label": "Labelled by hand",
    "name": "Named by hand",
}


def by_hand(thing: Any) -> tuple[str, ...]:
    """The words of what was done to a region, door or plane; () where it is as the machine made it."""
    words = getattr(thing, "by_hand", ())
    return ((words,) if words else ()) if isinstance(words, str) else tuple(words)


def hand_note(thing: Any, words: Callable[[str], str]) -> str:
    """One sentence of it."""
    return ", ".join(words(WORDS[w]) if w in WORDS else w for w in by_hand(thing))


def machine_said(workbench: Workbench, item: Item, words: Callable[[str], str]) -> str:
    """What the machine had said; "" where it said nothing. ``words`` translates whole sentences, too."""
    plan = workbench.plan
    said = str(plan.machine.get(item.id, "")) if plan is not None else ""
    return "; ".join(words(part) for part in said.split("; ")) if said else ""


def machine_note(workbench: Workbench, item: Item, words: Callable[[str], str]) -> str:
    """The same as a sentence."""
    said = machine_said(workbench, item, words)
    return words("The machine had said: {said}").format(said=said) if said else ""


def is_locked(thing: Any) -> bool:
    """True where the thing stays whatever the machine finds."""
    return bool(set(by_hand(thing)) & {"kept", "accepted", "added", "moved", "resized"})
