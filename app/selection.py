"""What is selected and what the pointer is over, shared by all panes. No Qt."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from floorcast_app.events import Event

KINDS = ("region", "door", "plane", "segment", "check", "warning")


@dataclass(frozen=True)
class Item:
    """One thing of the plan, by kind and id."""

    kind: str  # one of KINDS
    id: str


class Selection:
    """One or more selected items (the last one leads), and one under the pointer."""

    def __init__(self) -> None:
        self.changed = Event()  # () the selected items
        self.hover_changed = Event()  # () the item under the pointer
        self.zoom_asked = Event()  # (item) a double click: bring it into view
        self.items: tuple[Item, ...] = ()
        self.hovered: Item | None = None

    @property
    def item(self) -> Item | None:
        """The leading item: the one clicked last."""
        return self.items[-1] if self.items else None

    def select(self, item: Item | None, add: bool = False) -> None:
        """Select ``item`` alone (None: nothing), or add it to (take it from) what is selected."""
        if item is None:
            chosen: tuple[Item, ...] = ()
        elif add and item in self.items:
            chosen = tuple(i for i in self.items if i != item)
        else:
            chosen = (*self.items, item) if add else (item,)
        if chosen != self.items:
            self.items = chosen
            self.changed.emit()

    def select_all(self, items: Iterable[Item]) -> None:
        """Select these and nothing else, the last one leading; listeners hear of it once."""
        chosen = tuple(dict.fromkeys(items))
        if chosen != self.items:
            self.items = chosen
            self.changed.emit()

    def hover(self, item: Item | None) -> None:
        """The pointer is over ``item`` (None: over nothing)."""
        if item != self.hovered:
            self.hovered = item
            self.hover_changed.emit()

    def keep_only(self, exists: object) -> None:
        """Drop what a new plan does not have: ``exists(item)`` says whether it does."""
        kept = tuple(i for i in self.items if exists(i))  # type: ignore[operator]
        if self.hovered is not None and not exists(self.hovered):  # type: ignore[operator]
            self.hover(None)
        if kept != self.items:
            self.items = kept
            self.changed.emit()
