"""Actions as data: id, text, shortcut, when enabled, what to do. No Qt."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


def always(workbench: Workbench) -> bool:
    """Enabled at any time."""
    return True


def with_plan(workbench: Workbench) -> bool:
    """Enabled where there is a plan."""
    return workbench.plan is not None


@dataclass(frozen=True)
class Action:
    """One command. ``run(workbench, **arguments)``; arguments left out are asked for or have defaults."""

    id: str  # "file.open": the part before the dot is its menu
    text: str  # "Open…", sentence case
    run: Callable[..., Any]
    tip: str = ""  # one sentence that teaches
    shortcut: str = ""  # "Ctrl+O", Qt's portable text
    icon: str = ""  # name in resources/icons, without suffix
    enabled: Callable[[Workbench], bool] = always
    checked: Callable[[Workbench], bool] | None = None  # for toggles and tools


class ActionRegistry:
    """All actions by id, in the order in which they were added."""

    def __init__(self) -> None:
        self._actions: dict[str, Action] = {}

    def add(self, *actions: Action) -> None:
        """Add actions; an id may be taken only once."""
        for action in actions:
            if action.id in self._actions:
                raise ValueError(f"two actions are called {action.id}")
            self._actions[action.id] = action

    def __iter__(self) -> Iterator[Action]:
        return iter(self._actions.values())

    def __getitem__(self, id: str) -> Action:
        try:
            return self._actions[id]
        except KeyError:
            known = ", ".join(self._actions)
            raise UsageError(f"There is no action {id!r}; the actions are: {known}.") from None


def check_arguments(action: Action, arguments: dict[str, Any]) -> None:
    """Say in one sentence which argument an action does not take, or needs."""
    try:
        signature(action.run).bind(None, **arguments)
    except TypeError as error:
        raise UsageError(f"{action.id}: {error}.") from error


def as_json(value: Any) -> Any:
    """``value`` as JSON has it."""
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, (list, tuple, set, frozenset)):
        return [as_json(v) for v in value]
    return value if isinstance(value, (str, int, float, bool, dict, type(None))) else str(value)
