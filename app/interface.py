"""What actions may ask of a person and tell them: dialogs in a window, nobody in a script. No Qt."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from floorplan_core.errors import UsageError


class Interface(Protocol):
    """What actions may ask of a person. Scripts give arguments instead; their interface refuses."""

    def ask_open(self, title: str, filters: str) -> Path | None: ...
    def ask_save(self, title: str, filters: str, suggested: str) -> Path | None: ...
    def ask_text(self, title: str, label: str, text: str) -> str | None: ...
    def ask_yes(self, text: str, detail: str) -> bool: ...
    def tell(self, text: str, kind: str = "info") -> None: ...  # kind: "info", "warning" or "error"
    def show(self, what: str, **arguments: Any) -> Any: ...  # a dialog or pane by name


class NoInterface:
    """Nobody to ask: an action that would ask needs its arguments."""

    def __init__(self) -> None:
        self.told: list[tuple[str, str]] = []  # (kind, text)

    def ask_open(self, title: str, filters: str) -> Path | None:
        raise UsageError(f"{title}: give the path as an argument; there is nobody to ask.")

    def ask_save(self, title: str, filters: str, suggested: str) -> Path | None:
        raise UsageError(f"{title}: give the path as an argument; there is nobody to ask.")

    def ask_text(self, title: str, label: str, text: str) -> str | None:
        raise UsageError(f"{title}: give it as an argument; there is nobody to ask.")

    def ask_yes(self, text: str, detail: str) -> bool:
        return True

    def tell(self, text: str, kind: str = "info") -> None:
        self.told.append((kind, text))

    def show(self, what: str, **arguments: Any) -> Any:
        raise UsageError(f"{what} needs a window.")
