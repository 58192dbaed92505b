"""The Plan menu: settings, planning again, replaying a run."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from floorcast_app.actions.registry import Action, with_plan
from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench
    from floorplan_core.config import Config


def set_setting(workbench: Workbench, name: str, value: Any, gesture: str = "") -> None:
    """Change one setting, ``stage.field``; what depends on it is planned again.

    Calls with the same ``gesture`` (a slider that is dragged) are one step of the history.
    """
    config = with_setting(workbench.state.config, name, value)
    workbench.change(f"Set {name} to {value}", gesture, config=config)


def with_setting(config: Config, name: str, value: Any) -> Config:
    """``config`` with one other value; :class:`UsageError` where it is not known or out of bounds."""
    return with_settings(config, {name: value})


def with_settings(config: Config, values: dict[str, Any]) -> Config:
    """``config`` with several other values, checked together."""
    data = config.model_dump()
    for name, value in values.items():
        stage, _, field = name.partition(".")
        if stage not in data or field not in data[stage]:
            raise UsageError(f"There is no setting {name!r}; 'floorcast settings' lists them.")
        data[stage][field] = value
    return type(config).from_dict(data)


def apply_preset(workbench: Workbench, settings: dict[str, Any], name: str = "preset") -> None:
    """Change several settings in one step."""
    workbench.change(f"Use {name}", config=with_settings(workbench.state.config, settings))


def reset_settings(workbench: Workbench) -> None:
    """All settings as they come, except how the file is read."""
    fresh = type(workbench.state.config)()
    kept = fresh.model_copy(update={"input": workbench.state.config.input})
    workbench.change("Reset settings", config=kept)


def plan_again(workbench: Workbench) -> None:
    """Read and plan from nothing."""
    workbench.read_and_plan()


def cancel(workbench: Workbench) -> None:
    """Stop what runs."""
    workbench.cancel()


def replay(workbench: Workbench, every: float = 20.0) -> None:
    """Plan the run again as the robot moved, a plan every ``every`` seconds of run time."""
    workbench.replay(every)


def show_storey(workbench: Workbench, number: int | None = None) -> None:
    """Plan and show another storey, 0 for the lowest; asked for where none is named."""
    highest = len(workbench.storeys) - 1
    if number is None:
        label = f"Storey, 0 to {highest}"
        text = workbench.ui.ask_text("Show a storey", label, str(workbench.state.storey))
        if text is None:
            return
        number = int(text) if text.strip().isdigit() else -1
    if not 0 <= number <= highest:
        raise UsageError(f"There is no storey {number}; the survey has storeys 0 to {highest}.")
    workbench.document.apply(f"Show storey {number}", workbench.state.on_storey(number))


def step_storey(workbench: Workbench, by: int) -> None:
    """One storey up or down."""
    show_storey(workbench, workbench.state.storey + by)


def _has_storey(by: int) -> Callable[[Workbench], bool]:
    return lambda w: with_plan(w) and 0 <= w.state.storey + by < len(w.storeys)


def _replayable(workbench: Workbench) -> bool:
    session = workbench.session
    return session is not None and session.reconstruction.trajectory is not None


ACTIONS: tuple[Action, ...] = (
    Action(
        "plan.again",
        "Plan again",
        plan_again,
        "Read the survey once more and plan it from nothing.",
        "F5",
        "refresh-cw",
        lambda w: w.state.survey is not None,
    ),
    Action(
        "plan.cancel",
        "Cancel",
        cancel,
        "Stop what runs; the last plan stays.",
        "",
        "circle-x",
        lambda w: w.jobs.running,
    ),
    Action(
        "plan.set",
        "Change a setting…",
        set_setting,
        "Change one number of the method; only what depends on it is planned again.",
    ),
    Action("plan.preset", "Use a preset…", apply_preset, "Change several settings in one step."),
    Action(
        "plan.reset",
        "Reset settings",
        reset_settings,
        "All settings as they come.",
        "",
        "rotate-ccw",
    ),
    Action(
        "plan.storey",
        "Show a storey…",
        show_storey,
        "Plan another storey of the survey; each keeps its own corrections and checks.",
        "",
        "layers",
        lambda w: len(w.storeys) > 1,
    ),
    Action(
        "plan.storey_up",
        "Storey above",
        lambda w: step_storey(w, 1),
        "Plan the storey above the one that is shown.",
        "Shift+PgUp",
        "chevron-up",
        _has_storey(1),
    ),
    Action(
        "plan.storey_down",
        "Storey below",
        lambda w: step_storey(w, -1),
        "Plan the storey below the one that is shown.",
        "Shift+PgDown",
        "chevron-down",
        _has_storey(-1),
    ),
    Action(
        "plan.replay",
        "Replay the run",
        replay,
        "See the plan grow as the sensor moved: one plan every 20 s of run time.",
        "",
        "play",
        lambda w: with_plan(w) and _replayable(w),
    ),
)
