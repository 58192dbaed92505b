"""The File menu: open, save, export, pictures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from floorcast_app.actions.registry import Action, with_plan
from floorplan_core.errors import Cancelled, UsageError

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench
    from floorplan_core.observer import Observer

PROJECT_SUFFIX = ".floorcast"
NOT_RECORDED = ("file.save_recording", "file.quit", "plan.cancel")


def open_any(
    workbench: Workbench,
    path: str | Path | None = None,
    trajectory: str | Path | None = None,
    unit: str = "auto",
    up: str = "auto",
) -> None:
    """Open a survey (a file or a folder) or a project."""
    path = Path(path) if path is not None else workbench.ui.ask_open("Open a survey or project", "survey")
    if path is None or not may_leave(workbench):
        return
    if path.suffix.lower() == PROJECT_SUFFIX:
        workbench.open_project(path)
    else:
        workbench.open_survey(path, None if trajectory is None else Path(trajectory), unit, up)
    workbench.remember(path)


def open_folder(workbench: Workbench, path: str | Path | None = None) -> None:
    """Open a folder of scans."""
    chosen = Path(path) if path is not None else workbench.ui.ask_open("Open a folder of scans", "folder")
    if chosen is not None:
        open_any(workbench, chosen)


def open_sample(workbench: Workbench) -> None:
    """Open the bundled survey."""
    open_any(workbench, sample_survey())


def sample_survey() -> Path:
    """The folder of the bundled survey."""
    from importlib.resources import files

    return Path(str(files("floorcast_resources"))) / "sample_survey"


def close(workbench: Workbench) -> None:
    """Close the survey."""
    if may_leave(workbench):
        workbench.close_survey()


def save(workbench: Workbench, path: str | Path | None = None) -> None:
    """Save the project where it was saved before, or ask."""
    target = Path(path) if path is not None else workbench.project
    if target is None:
        save_as(workbench)
    else:
        workbench.save_project(target)
        workbench.remember(target)


def save_as(workbench: Workbench, path: str | Path | None = None) -> None:
    """Save the project under another name."""
    survey = workbench.state.survey
    suggested = f"{survey.path.stem if survey else 'plan'}{PROJECT_SUFFIX}"
    target = (
        Path(path)
        if path is not None
        else workbench.ui.ask_save("Save the project", f"Floorcast (*{PROJECT_SUFFIX})", suggested)
    )
    if target is not None:
        save(workbench, target if target.suffix else target.with_suffix(PROJECT_SUFFIX))


def export(
    workbench: Workbench,
    path: str | Path | None = None,
    suffix: str = ".svg",
    units: str = "metric",
    language: str = "en",
    title: str = "",
) -> None:
    """Write the plan in the format that the file's suffix names; a job, as large plans take their time.

    :param suffix: the format that is offered where no path is given.
    :param units: of drawings and pictures: metric or imperial.
    :param language: of their words: en or de.
    :param title: what they are called; the survey's name where none is given.
    """
    from floorplan_core.drawing_style import DrawingStyle, in_style
    from floorplan_core.files import output_file
    from floorplan_core.plugins import default_registry

    assert workbench.plan is not None
    if workbench.jobs.running:
        raise UsageError("The plan is not ready yet: export it when it is, or cancel what runs.")
    if path is None:
        workbench.ui.show("export", suffix=suffix)
        return
    target, plan = Path(path), workbench.plan
    exporter = in_style(default_registry().exporter(target), DrawingStyle(units, language, title))

    def work(observer: Observer) -> None:
        observer.stage_started("export")
        try:
            with output_file(target) as staging:
                exporter.write(plan, staging)
                observer.check_cancelled()  # then nothing appears
        except Cancelled:
            workbench.post(lambda: workbench.ui.tell(f"{target.name} was not written.", "warning"))
            raise

    workbench.jobs.start(
        f"Exporting {target.name}", work, lambda _: workbench.ui.tell(f"Exported {target.name}.")
    )


def picture(
    workbench: Workbench,
    path: str | Path | None = None,
    pane: str = "floor_plan",
    width: int = 1600,
    height: int = 1200,
    scale_bar: bool | None = None,
) -> None:
    """A picture of one pane, at any resolution; with a scale bar, without, or (None) as the pane shows it."""
    if path is None:
        workbench.ui.show("screenshot")
        return
    size = {"width": int(width), "height": int(height)}
    workbench.ui.show("picture", path=Path(path), pane=pane, **size, scale_bar=scale_bar)


def copy_picture(workbench: Workbench, pane: str = "floor_plan") -> None:
    """The picture of a pane into the clipboard."""
    workbench.ui.show("copy_picture", pane=pane)


def save_recording(workbench: Workbench, path: str | Path | None = None) -> None:
    """Write what was done since the program began as a script."""
    import json

    from floorplan_core.files import write_text

    target = (
        Path(path)
        if path is not None
        else workbench.ui.ask_save("Save the session as a script", "JSON (*.json)", "session.json")
    )
    if target is not None:
        done = [entry for entry in workbench.log if entry["action"] not in NOT_RECORDED]
        write_text(target, json.dumps(done, indent=1) + "\n")
        workbench.ui.tell(f"Wrote {target.name}; run it with: floorcast gui --script {target.name}")


def open_in_open3d(workbench: Workbench) -> None:
    """The same scene in Open3D's own viewer, in a process of its own."""
    from floorcast_app.open3d_viewer import open_in_open3d as start

    start(workbench)


def leave(workbench: Workbench) -> None:
    """Close the program."""
    workbench.ui.show("quit")


def may_leave(workbench: Workbench) -> bool:
    """True where nothing is lost by closing the document: it is saved, or the person says so."""
    if workbench.state.survey is None or not workbench.has_edits:
        return True
    return workbench.ui.ask_yes(
        "Close without saving?", "The corrections made since the last save would be lost."
    )


def relocate(workbench: Workbench, path: str | Path | None = None) -> None:
    """Say where the survey of this project lies now."""
    survey = workbench.state.survey
    if survey is None:
        raise UsageError("There is no survey to look for.")
    kind = "survey" if survey.path.suffix else "folder"
    found = Path(path) if path is not None else workbench.ui.ask_open(f"Where is {survey.path.name}?", kind)
    if found is not None:
        workbench.relocate(found)


ACTIONS: tuple[Action, ...] = (
    Action(
        "file.open",
        "Open…",
        open_any,
        "Open a point cloud, mesh, run, grid map or project.",
        "Ctrl+O",
        "folder-open",
    ),
    Action("file.open_folder", "Open folder…", open_folder, "Open a folder of scans.", "Ctrl+Shift+O"),
    Action(
        "file.open_sample",
        "Open the bundled survey",
        open_sample,
        "Try Floorcast on a survey that comes with it.",
    ),
    Action(
        "file.relocate",
        "Find the survey…",
        relocate,
        "Say where the survey of this project lies now.",
        enabled=lambda w: w.state.survey is not None,
    ),
    Action(
        "file.save",
        "Save",
        save,
        "Save the project: survey by reference, settings, corrections, checks, view.",
        "Ctrl+S",
        "save",
        lambda w: w.state.survey is not None,
    ),
    Action(
        "file.save_as",
        "Save as…",
        save_as,
        "Save the project under another name.",
        "Ctrl+Shift+S",
        enabled=lambda w: w.state.survey is not None,
    ),
    Action(
        "file.export",
        "Export…",
        export,
        "Write the plan as SVG, GeoJSON, PNG or another format.",
        "Ctrl+E",
        "download",
        with_plan,
    ),
    Action(
        "file.picture",
        "Picture of a pane…",
        picture,
        "A picture of one pane at any resolution.",
        "Ctrl+Shift+E",
        "camera",
        with_plan,
    ),
    Action(
        "file.copy_picture",
        "Copy picture",
        copy_picture,
        "The floor plan as a picture into the clipboard.",
        "Ctrl+Shift+C",
        "copy",
        with_plan,
    ),
    Action(
        "file.save_recording",
        "Save the session as a script…",
        save_recording,
        "Write what was done as a list of actions that 'floorcast gui --script' runs again.",
        enabled=lambda w: bool(w.log),
    ),
    Action(
        "file.open3d",
        "Open in Open3D",
        open_in_open3d,
        "The same scene in Open3D's own viewer.",
        "",
        "box",
        with_plan,
    ),
    Action(
        "file.close",
        "Close",
        close,
        "Close the survey.",
        "Ctrl+W",
        enabled=lambda w: w.state.survey is not None,
    ),
    Action("file.quit", "Quit", leave, "Close the program.", "Ctrl+Q"),
)
