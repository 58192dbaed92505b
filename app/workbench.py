"""The application without a window: document, plan, selection, look, jobs and actions, tied together. No Qt.

The window shows it, a script drives it, tests look at it. Everything here runs in the main thread; work runs
in :mod:`floorcast_app.jobs`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from floorcast_app.actions import all_actions
from floorcast_app.actions.registry import ActionRegistry, as_json, check_arguments
from floorcast_app.document import Document
from floorcast_app.events import Event
from floorcast_app.interface import Interface, NoInterface
from floorcast_app.item_bounds import bring_into_view, change_plan
from floorcast_app.jobs import Jobs, Post
from floorcast_app.layers.partial import InWorld
from floorcast_app.point_store import PointStore
from floorcast_app.preferences import Preferences
from floorcast_app.run_replay import ShownStorey, Snapshot
from floorcast_app.saved_look import look_from_dict, look_to_dict
from floorcast_app.selection import Item, Selection
from floorcast_app.state import Check, DocumentState, StoreyEdits, SurveyRef
from floorcast_app.tools.box import ToolBox
from floorcast_app.view_state import ViewState
from floorcast_app.workers.planner import LocalPlanner, Planner, Session
from floorplan_core.errors import FloorPlanError, UsageError
from floorplan_core.model import FloorPlan
from floorplan_core.model.corrections import Correction
from floorplan_core.model.storey import Storey
from floorplan_core.observer import Observer

_Planned = tuple[Session, FloorPlan, tuple[Storey, ...]]


class Workbench:
    """One document and everything that is derived from it."""

    def __init__(self, post: Post, planner: Planner | None = None) -> None:
        self.post = post  # runs a function in the main thread, soon
        self.planner: Planner = planner or LocalPlanner()  # reads and plans, for jobs
        self._whole: FloorPlan | None = None  # the plan of the whole survey, while a moment of a run is shown
        self.moment: float | None = None  # seconds of run time of that moment
        self.document = Document()
        self.selection = Selection()
        self.view = ViewState()
        self.preferences = Preferences()
        self.jobs = Jobs(post)
        self.actions: ActionRegistry = all_actions()
        self.ui: Interface = NoInterface()
        self.thumbnail: Callable[[], bytes | None] = lambda: None  # a small PNG of the plan, from a window
        self.project: Path | None = None  # where the document is saved; None: nowhere yet
        # World metres of what corrections and checks are relative to; None: of the survey's local frame
        self.origin: tuple[float, float] | None = None
        self.names: tuple[tuple[str, str, str], ...] = ()  # of the regions, as they were saved
        self.plan: FloorPlan | None = None
        self.storeys: tuple[Storey, ...] = ()  # of the survey, lowest first; nearly always one
        self.session: Session | None = None
        self.points = PointStore()
        self.warnings: tuple[str, ...] = ()
        self.assumptions: tuple[str, ...] = ()
        self.failure = ""  # why the last job came to nothing
        self.tool = "select"  # "select", "measure", "plane", "door", "wall", "split", "merge", "move"
        self.plan_changed = Event()  # (FloorPlan | None)
        self.partial = Event()  # (stage, result) as stages finish
        self.points_changed = Event()  # () more points to show, or none
        self.tool_changed = Event()  # (tool)
        self.survey_changed = Event()  # () another survey, or none
        self.input_missing = Event()  # (path) the survey of a project that was opened is not where it was
        self.pointer_moved = Event()  # (x, y) metres, manhattan frame; (None, None) outside the panes
        self.recent_changed = Event()  # (Path) it was opened or saved
        self.log: list[dict[str, Any]] = []  # the actions that were run, for a script that does it again
        self.timeline: list[Snapshot] = []  # of a replayed run, of the storey that is shown
        self._replayed: dict[int, list[Snapshot]] = {}  # the same of each storey
        self.timeline_changed = Event()  # ()
        self.setting_asked = Event()  # (name) show "stage.field" in the settings form
        self.toolbox = ToolBox(self)  # the tool in hand, one for all plan panes
        self.document.changed.connect(self._document_changed)
        self.selection.zoom_asked.connect(lambda item: bring_into_view(self, item))
        in_world = InWorld()
        self.jobs.stage_done.connect(lambda stage, _, result: self.partial.emit(stage, in_world(result)))
        self.jobs.ended.connect(self._job_ended)
        self.jobs.warned.connect(self._warned)

    # ---- running actions --------------------------------------------------------------------------------

    def run(self, id: str, /, **arguments: Any) -> Any:
        """Run an action by id; :class:`UsageError` where it is not possible now."""
        action = self.actions[id]
        if not action.enabled(self):
            raise UsageError(f"{action.text.rstrip('…')} ({id}) is not possible now.")
        check_arguments(action, arguments)
        self.log.append({"action": id, **{k: as_json(v) for k, v in arguments.items()}})
        return action.run(self, **arguments)

    def try_run(self, id: str, /, **arguments: Any) -> Any:
        """The same from a menu or a key: what goes wrong is told, not raised."""
        try:
            return self.run(id, **arguments)
        except FloorPlanError as error:
            self.ui.tell(str(error), "error")
            return None

    def set_tool(self, tool: str) -> None:
        """What a click in a pane does from now on."""
        if tool != self.tool:
            self.tool = tool
            self.tool_changed.emit(tool)

    # ---- the document -----------------------------------------------------------------------------------

    @property
    def state(self) -> DocumentState:
        """The document's present state."""
        return self.document.state

    def change(self, text: str, gesture: str = "", **values: Any) -> None:
        """One undoable step: fields of the :class:`DocumentState` with their new values."""
        self.document.apply(text, replace(self.state, **values), gesture)

    def correct(self, text: str, *corrections: Correction) -> None:
        """One undoable step that adds corrections; the plan follows."""
        self.change(text, corrections=(*self.state.corrections, *corrections))

    # ---- survey and plan --------------------------------------------------------------------------------

    def open_survey(
        self, path: Path, trajectory: Path | None = None, unit: str = "auto", up: str = "auto"
    ) -> None:
        """Begin a new document with a survey; it is read and planned in a job."""
        self._close_survey()
        state = DocumentState(SurveyRef(Path(path), trajectory))
        sections = {"input": state.config.input.model_copy(update={"unit": unit, "up": up})}
        if memory := self.preferences.number("memory"):
            sections["voxels"] = state.config.voxels.model_copy(update={"memory": float(memory)})
        config = state.config.model_copy(update=sections)
        self.project, self.origin, self.names = None, None, ()
        self.document.reset(replace(state, config=config), f"Open {Path(path).name}", saved=False)

    def read_and_plan(self) -> None:
        """Start the job that reads the survey and plans it from nothing."""
        ref, state = self.state.survey, self.state
        if ref is None:
            return
        self.points = PointStore()
        store = self.points
        names = self.session.names if self.session is not None else self.names

        def work(observer: Observer) -> _Planned:
            session = self.planner.open(ref.path, ref.trajectory, state.config, names, observer)
            self.planner.read(session, store, observer)
            return self._plan(session, state, observer)

        self.jobs.start(f"Reading {ref.path.name}", work, self._planned)

    def replan(self) -> None:
        """Start the job that brings the plan up to date with settings and corrections."""
        session, state = self.session, self.state
        if session is None or not session.ready or session.must_read_again(state.config):
            self.read_and_plan()
            return

        self.jobs.start("Planning", lambda observer: self._plan(session, state, observer), self._planned)

    def cancel(self) -> None:
        """Stop what runs; the last plan stays."""
        self.jobs.cancel()

    def replay(self, every: float) -> None:
        """Start the job that plans the run again as the sensor moved, every ``every`` seconds of it."""
        session, state, whole = self.session, self.state, self._whole
        if session is None or whole is None:
            return
        shown = ShownStorey.of(whole, session.reconstruction, len(self.storeys) < 2)
        moments = self._replayed[state.storey] = []
        self._show_timeline()

        def add(snapshot: Snapshot) -> None:
            moments.append(snapshot)
            if moments is self.timeline:
                self.timeline_changed.emit()

        def work(observer: Observer) -> None:
            self.planner.replay(
                session, state.config, every, shown, observer, lambda s: self.post(lambda: add(s))
            )

        self.jobs.start("Replaying the run", work, lambda _: None)

    def show_snapshot(self, index: int | None) -> None:
        """Show the plan of one moment of the run; None: the plan of the whole survey."""
        shown = self._whole if index is None else self.timeline[index].plan or self.plan
        self.moment = None if index is None else self.timeline[index].time
        change_plan(self, shown)
        self.plan_changed.emit(self.plan)
        self.selection.keep_only(self.exists)

    # ---- projects ---------------------------------------------------------------------------------------

    @property
    def has_edits(self) -> bool:
        """True where closing would lose what a person did."""
        state = self.state
        return self.document.dirty and bool(
            state.corrections or state.checks or self.project or len(self.document.history) > 1
        )

    def open_project(self, path: Path) -> None:
        """Open a saved project; its survey is read again. An input that moved is asked for."""
        from floorplan_core import project_file

        self.open_loaded(project_file.load(path), path, f"Open {path.name}")

    def open_loaded(self, loaded: Any, path: Path | None, text: str, saved: bool = True) -> None:
        """Go on with a :class:`floorplan_core.project_file.Project` that was read from anywhere.

        :param path: where the document is saved; None: nowhere yet.
        """
        self._close_survey()
        self.project, self.origin, self.names = path, loaded.origin, loaded.names
        state = DocumentState(
            survey=None if loaded.survey is None else SurveyRef(*loaded.survey),
            config=loaded.config,
            corrections=loaded.corrections,
            checks=tuple(Check(**c) for c in loaded.checks),
            storey=loaded.storey,
            elsewhere=tuple(
                StoreyEdits(n, said, tuple(Check(**c) for c in checks))
                for n, said, checks in loaded.elsewhere
            ),
        )
        self.view.put(look_from_dict(loaded.view))
        self.document.reset(state, text, saved)
        for note in loaded.notes:
            self.ui.tell(note, "warning")
        survey = state.survey.path if state.survey is not None else None
        for missing in loaded.missing:
            if missing != survey or not self.input_missing.is_heard:  # else it is asked for, which says it
                self.ui.tell(f"{missing.name} is not where it was; say where it lies now.", "warning")
        if survey in loaded.missing:
            self.input_missing.emit(survey)

    def save_project(self, path: Path) -> None:
        """Save the document; whole or not at all."""
        from floorplan_core import project_file

        project_file.save(path, self.saved_form(), self.thumbnail())
        self.project = path
        self.document.mark_saved()
        self.ui.tell(f"Saved {path.name}.")

    def saved_form(self) -> Any:
        """The document as a :class:`floorplan_core.project_file.Project`."""
        from floorplan_core.project_file import Project

        state = self.state
        return Project(
            survey=state.survey and (state.survey.path, state.survey.trajectory, state.survey.digest),
            config=state.config,
            corrections=state.corrections,
            checks=tuple(asdict(c) for c in state.checks),
            view=look_to_dict(self.view.look),
            origin=self.origin or (self.session.origin if self.session else None),
            names=self.session.names if self.session else self.names,
            storey=state.storey,
            elsewhere=tuple(
                (e.storey, e.corrections, tuple(asdict(c) for c in e.checks)) for e in state.elsewhere
            ),
        )

    def relocate(self, path: Path) -> None:
        """The survey of this document lies at ``path`` now."""
        survey = self.state.survey
        assert survey is not None
        if self.origin is None and self.session is not None:
            self.origin = self.session.origin  # what was said stays where it was in the world
        self.change(f"Find {path.name}", survey=replace(survey, path=path))

    def close_survey(self) -> None:
        """An empty document."""
        self._close_survey()
        self.project, self.origin, self.names = None, None, ()
        self.document.reset(DocumentState(), "New")

    def remember(self, path: Path) -> None:
        """Put ``path`` first among the recent files."""
        self.recent_changed.emit(path)

    def exists(self, item: Item) -> bool:
        """True where the plan has ``item``."""
        return self.find(item) is not None

    def find(self, item: Item | None) -> Any:
        """The region, door, plane, segment or check that ``item`` names; None where there is none."""
        if item is None:
            return None
        if item.kind == "check":
            return next((c for c in self.state.checks if c.id == item.id), None)
        if self.plan is None:
            return None
        things: dict[str, Any] = {
            "region": self.plan.regions,
            "door": self.plan.doors,
            "plane": self.plan.all_planes,
            "segment": self.plan.all_segments,
        }
        return next((t for t in things.get(item.kind, ()) if t.id == item.id), None)

    def to_local(self, xy: tuple[float, float]) -> tuple[float, float]:
        """Plan coordinates (manhattan frame) to the local frame that corrections and checks are kept in."""
        assert self.plan is not None
        (x, y), origin = self.plan.to_world([xy])[0], self._origin()
        return float(x) - origin[0], float(y) - origin[1]

    def to_plan(self, xy: tuple[float, float]) -> tuple[float, float]:
        """Local coordinates to the manhattan frame of the present plan."""
        assert self.plan is not None
        dx, dy = self.shift_to_plan()
        x, y = self.plan.frame.plan_from_local([(xy[0] + dx, xy[1] + dy)])[0]
        return float(x), float(y)

    def shift_to_plan(self) -> tuple[float, float]:
        """Metres from the local frame of the document to that of the present plan; nearly always nothing."""
        assert self.plan is not None
        shift, origin = self.plan.local_frame.shift, self._origin()
        return origin[0] - float(shift[0]), origin[1] - float(shift[1])

    def _origin(self) -> tuple[float, float]:
        """World metres of what corrections and checks are relative to."""
        assert self.plan is not None
        if self.origin is not None:
            return self.origin
        if self.session is not None:
            return self.session.origin
        return float(self.plan.local_frame.shift[0]), float(self.plan.local_frame.shift[1])

    # ---- what follows from what -------------------------------------------------------------------------

    def _document_changed(self, before: DocumentState, after: DocumentState) -> None:
        if after.survey != before.survey:
            self._close_survey()
            self.survey_changed.emit()
            self.read_and_plan()
        elif (after.config, after.corrections, after.storey) != (
            before.config,
            before.corrections,
            before.storey,
        ):
            if after.storey != before.storey:
                self._show_timeline()
            self.replan()
        self.selection.keep_only(self.exists)

    def _plan(self, session: Session, state: DocumentState, observer: Observer) -> _Planned:
        """The plan of the storey that is shown; in a job's thread."""
        plan = session.plan(state.config, state.corrections, observer, state.storey, self.origin)
        return session, plan, session.storeys(state.config)

    def _planned(self, result: _Planned) -> None:
        self.session, self.plan, self.storeys = result
        self._whole, self.moment = self.plan, None
        self.warnings = self.plan.warnings
        self.assumptions = self.session.reconstruction.assumptions
        self.points_changed.emit()
        self.plan_changed.emit(self.plan)
        self.selection.keep_only(self.exists)

    def _job_ended(self, error: Exception | None) -> None:
        self.failure = ""
        if error is not None:
            cancelled = getattr(error, "exit_status", 4) == 130
            self.failure = "" if cancelled else str(error)
            self.points_changed.emit()
            self.ui.tell(str(error), "info" if cancelled else "error")

    def _warned(self, text: str) -> None:
        if text not in self.warnings:
            self.warnings = (*self.warnings, text)

    def _show_timeline(self) -> None:
        """The moments of the storey that is shown; none where it was not replayed."""
        self.timeline = self._replayed.get(self.state.storey, [])
        self.timeline_changed.emit()

    def _close_survey(self) -> None:
        self.jobs.cancel()
        self.planner.forget()
        self.session, self.plan, self.storeys, self.warnings, self.failure = None, None, (), (), ""
        self._whole, self.moment, self._replayed = None, None, {}
        self._show_timeline()
        self.points = PointStore()
        self.selection.select(None)
        self.points_changed.emit()
        self.plan_changed.emit(None)
