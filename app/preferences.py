"""What a person prefers in every document: one table of them, and their values. No Qt.

One declaration per preference drives what is allowed, the dialog and the words. They are no part of a
document, so that nothing here is undone; a window keeps them in the user's settings.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from floorcast_app.events import Event
from floorplan_core.errors import UsageError

Value = str | int


@dataclass(frozen=True)
class Preference:
    """One preference: a choice of words, or a whole number."""

    name: str  # as scripts say it
    key: str  # in the user's settings
    group: str  # heading in the dialog
    title: str
    help: str  # one sentence
    default: Value
    choices: tuple[tuple[str, str], ...] = ()  # (value, text); none: a number
    least: int = 0
    most: int = 0
    unit: str = ""
    zero: str = ""  # what 0 is called, where it is no number
    step: int = 1

    def checked(self, value: object) -> Value:
        """``value`` as this preference has it; :class:`UsageError` where it cannot."""
        if self.choices:
            if value in [v for v, _ in self.choices]:
                return str(value)
            words = ", ".join(repr(v) for v, _ in self.choices)
            raise UsageError(f"{self.title} is one of {words}, not {value!r}.")
        try:
            number = int(str(value))
        except ValueError:
            number = -1
        if not (self.least <= number <= self.most or (self.zero and number == 0)):
            span = f"{self.least} to {self.most}{f' {self.unit}' if self.unit else ''}"
            raise UsageError(f"{self.title} is a whole number, {span}; given {value!r}.")
        return number


PREFERENCES = (
    Preference(
        "language",
        "language",
        "Window",
        "Language",
        "Of the window; an exported drawing has its own.",
        "",
        (("", "As the system"), ("en", "English"), ("de", "Deutsch")),
    ),
    Preference(
        "theme",
        "look/theme",
        "Window",
        "Theme",
        "Of the window; exported drawings stay light.",
        "light",
        (("light", "Light"), ("dark", "Dark")),
    ),
    Preference(
        "units",
        "look/units",
        "Window",
        "Units",
        "Of lengths and areas wherever they are shown; files have metres.",
        "m",
        (("m", "Metres"), ("ft-in", "Feet and inches")),
    ),
    Preference(
        "autosave",
        "recovery/interval",
        "Files",
        "Autosave",
        "How often the view is kept for the case of a crash; every edit is kept at once.",
        30,
        least=5,
        most=600,
        unit="s",
        step=5,
    ),
    Preference(
        "recent",
        "recent/most",
        "Files",
        "Recent files",
        "How many are offered again; 0 remembers none.",
        8,
        least=0,
        most=30,
    ),
    Preference(
        "memory",
        "planning/memory",
        "Planning",
        "Memory",
        "What the map of a survey may take, of surveys opened from now on; more goes to temporary files.",
        0,
        least=64,
        most=1_000_000,
        unit="MB",
        zero="Half of what is free",
        step=256,
    ),
)

BY_NAME = {p.name: p for p in PREFERENCES}


class Preferences:
    """The values; ``changed`` tells of each one that is another now."""

    def __init__(self) -> None:
        self.changed = Event()  # (name, value)
        self._values: dict[str, Value] = {p.name: p.default for p in PREFERENCES}
        self._write: Callable[[str, Value], object] = lambda key, value: None

    def __getitem__(self, name: str) -> Value:
        return self._values[_known(name).name]

    def number(self, name: str) -> int:
        """The value of a preference that is a number."""
        return int(self[name])

    def set(self, name: str, value: object) -> None:
        """Another value; kept at once. :class:`UsageError` where the preference cannot have it."""
        preference = _known(name)
        checked = preference.checked(value)
        if checked != self._values[name]:
            self._values[name] = checked
            self._write(preference.key, checked)
            self.changed.emit(name, checked)

    def reset(self) -> None:
        """All as they were when Floorcast was new."""
        for preference in PREFERENCES:
            self.set(preference.name, preference.default)

    def attach(self, read: Callable[[str], object], write: Callable[[str, Value], object]) -> None:
        """Take the values that were kept, and keep each from now on; what is not understood is left out.

        :param read: the value kept under a key; None where there is none.
        """
        for preference in PREFERENCES:
            kept = read(preference.key)
            try:
                if kept is not None:
                    self.set(preference.name, kept)
            except UsageError:
                continue
        self._write = write


def _known(name: str) -> Preference:
    if name not in BY_NAME:
        raise UsageError(f"There is no preference {name!r}; there are: {', '.join(BY_NAME)}.")
    return BY_NAME[name]
