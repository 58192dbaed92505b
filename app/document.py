"""The document: its state, the history of it, and who is told. No Qt."""

from __future__ import annotations

from dataclasses import dataclass

from floorcast_app.events import Event
from floorcast_app.state import DocumentState


@dataclass(frozen=True)
class Step:
    """One entry of the history: what was done, and the state that it led to."""

    text: str  # "Move wall p12", as the undo menu shows it
    state: DocumentState
    gesture: str = ""  # steps of one gesture (a slider that is dragged) are one step


class Document:
    """States are values, so undo without limit is a list of them."""

    def __init__(self) -> None:
        self.changed = Event()  # (before: DocumentState, after: DocumentState)
        self.saved_changed = Event()  # () the document became dirty or clean, or moved in its history
        self.reset(DocumentState())

    @property
    def state(self) -> DocumentState:
        """What holds now."""
        return self._steps[self._at].state

    @property
    def history(self) -> tuple[Step, ...]:
        """All steps, undone ones included; the first is how the document began."""
        return tuple(self._steps)

    @property
    def position(self) -> int:
        """Index of the present step in :attr:`history`."""
        return self._at

    @property
    def dirty(self) -> bool:
        """True where the state is not the one that was saved."""
        return self.state != self._saved

    def reset(self, state: DocumentState, text: str = "Open", saved: bool = True) -> None:
        """Begin anew with ``state``: no history."""
        before = self.state if hasattr(self, "_steps") else DocumentState()
        self._steps, self._at = [Step(text, state)], 0
        self._saved = state if saved else None
        self._tell(before)

    def apply(self, text: str, state: DocumentState, gesture: str = "") -> None:
        """Take a step; what had been undone is forgotten. Nothing happens where nothing changes.

        A step of the same ``gesture`` as the one before takes its place.
        """
        before = self.state
        if state == before:
            return
        goes_on = gesture != "" and self._steps[self._at].gesture == gesture
        self._at += not goes_on
        self._steps[self._at :] = [Step(text, state, gesture)]
        self._tell(before)

    def go_to(self, position: int) -> None:
        """Undo or redo up to step ``position``."""
        before = self.state
        self._at = min(max(position, 0), len(self._steps) - 1)
        self._tell(before)

    def undo(self) -> None:
        """Back by one step."""
        self.go_to(self._at - 1)

    def redo(self) -> None:
        """Forward by one step."""
        self.go_to(self._at + 1)

    @property
    def undo_text(self) -> str:
        """What undo would take back; "" where there is nothing."""
        return self._steps[self._at].text if self._at else ""

    @property
    def redo_text(self) -> str:
        """What redo would do again; "" where there is nothing."""
        return self._steps[self._at + 1].text if self._at + 1 < len(self._steps) else ""

    def mark_saved(self) -> None:
        """The present state is the one on disk."""
        self._saved = self.state
        self.saved_changed.emit()

    def _tell(self, before: DocumentState) -> None:
        if self.state != before:
            self.changed.emit(before, self.state)
        self.saved_changed.emit()
