"""Makes the layers of a plan in a thread, so that a large plan does not hold up the window."""

from __future__ import annotations

from threading import Lock

from PySide6.QtCore import QObject, QRunnable, QThreadPool, Signal

from floorcast_app.layers.source import PlanSource, source_of
from floorcast_app.viewports.plan_layers import LayerView, make_views
from floorcast_app.workers.behind import step_behind
from floorplan_core.model import FloorPlan

_one_at_a_time = Lock()  # the panes share what they draw from


class Drawing:
    """A plan with what paints its layers."""

    def __init__(self, plan: FloorPlan, kinds: tuple[str, ...]) -> None:
        with _one_at_a_time:
            self.source: PlanSource = source_of(plan)
            self.views: dict[str, LayerView] = make_views(self.source, kinds)
            self.source.hits, self.source.snaps  # noqa: B018 (made here, not at the first move of the pointer)


class PlanBuilder(QObject):
    """Builds the newest plan that it was given; older ones are dropped."""

    built = Signal(object)  # Drawing
    failed = Signal(str)  # a sentence

    _done = Signal(int, object)

    def __init__(self, kinds: tuple[str, ...], parent: QObject) -> None:
        super().__init__(parent)
        self._kinds = kinds
        self._serial = 0
        self._waiting = False
        self._done.connect(self._take)

    @property
    def busy(self) -> bool:
        """True while a plan is being built."""
        return self._waiting

    def build(self, plan: FloorPlan) -> None:
        """Build ``plan`` in a thread; :attr:`built` says when."""
        self._serial += 1
        self._waiting = True
        QThreadPool.globalInstance().start(_Task(self, self._serial, plan, self._kinds))

    def build_now(self, plan: FloorPlan) -> Drawing:
        """Build ``plan`` here."""
        self.drop()
        return Drawing(plan, self._kinds)

    def drop(self) -> None:
        """Forget what is being built."""
        self._serial += 1
        self._waiting = False

    def _take(self, serial: int, made: object) -> None:
        if serial != self._serial:
            return
        self._waiting = False
        if isinstance(made, Exception):
            self.failed.emit(f"This plan cannot be drawn ({type(made).__name__}: {made}).")
        else:
            self.built.emit(made)


class _Task(QRunnable):
    def __init__(self, builder: PlanBuilder, serial: int, plan: FloorPlan, kinds: tuple[str, ...]) -> None:
        super().__init__()
        self._builder, self._serial, self._plan, self._kinds = builder, serial, plan, kinds

    def run(self) -> None:
        step_behind()
        try:
            made: object = Drawing(self._plan, self._kinds)
        except Exception as error:  # noqa: BLE001 (a bug in a drawing must not leave the pane waiting)
            made = error
        try:
            self._builder._done.emit(self._serial, made)
        except RuntimeError:  # the pane was closed meanwhile
            return
