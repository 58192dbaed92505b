"""A run over time: the plan as it was known at each moment, played or picked."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtWidgets import QPushButton, QSizePolicy, QSlider, QToolButton, QVBoxLayout, QWidget

from floorcast_app import icons, theme
from floorcast_app.format import area, length
from floorcast_app.panels.base import GRID, Panel, column, label, row
from floorcast_app.panels.sparkline import Sparkline
from floorcast_app.run_replay import Snapshot
from floorcast_app.translation import tr, tr_n
from floorcast_app.workbench import Workbench

FRAME = 700  # ms that a moment stays while the run is played


class TimelinePanel(Panel):
    """Shows ``workbench.timeline``; the last place of the slider is the whole survey."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.at = -1
        self._of: list[Snapshot] = []  # the moments that ``at`` counts
        self.play = QToolButton()
        self.play.setIconSize(QSize(20, 20))
        self.play.setCheckable(True)
        self.play.setToolTip(tr("Play the run"))
        self.play.toggled.connect(self._play)
        icons.set_icon(self.play, "play")
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.valueChanged.connect(self.show_moment)
        self.clock = label("", "changed")
        self.clock.setMinimumWidth(72)
        self.end = label("", "muted")  # when the run ends
        for clock in (self.clock, self.end):
            clock.setFont(theme.font(figures=True))  # else it trembles while the run is played
        self.facts = label("", "small")
        self.facts.setContentsMargins(GRID, 0, GRID, 0)
        self.facts.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.spark = Sparkline(self.slider)
        self.spark.picked.connect(self.slider.setValue)
        self.whole = QPushButton(tr("Whole survey"))
        self.whole.setToolTip(tr("Back to the plan of all that was measured"))
        self.whole.clicked.connect(self._show_whole)
        self.replay = QPushButton(tr("Replay the run"))
        icons.set_icon(self.replay, "play")
        self.replay.clicked.connect(lambda: workbench.try_run("plan.replay"))
        self.hint = label("", "muted", wrap=True)
        self._lay_out()
        self._next = QTimer(self)
        self._next.timeout.connect(self._step)
        self.listen(workbench.timeline_changed, workbench.survey_changed, workbench.plan_changed)
        self.listen(workbench.jobs.ended, workbench.view.changed, theme.changed)
        self.refresh()

    def refresh(self) -> None:
        moments = self.workbench.timeline
        self._run.setVisible(bool(moments))
        self._empty.setVisible(not moments)
        if moments is not self._of:  # another replay, or that of another storey
            self._of, self.at = moments, -1
            self.play.setChecked(False)
        if not moments:
            self._refresh_empty()
            return
        self.slider.blockSignals(True)
        self.slider.setRange(0, len(moments) - 1)
        if self.at < 0:
            self.slider.setValue(len(moments) - 1)
        self.slider.blockSignals(False)
        self._refresh_facts()

    def show_moment(self, index: int) -> None:
        """Show the plan as it was known at a moment."""
        if 0 <= index < len(self.workbench.timeline):
            self.at = index
            self.workbench.show_snapshot(index)
            self._refresh_facts()

    # ---- inside -----------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        top = row(self.play, self.clock, self.slider, self.end, self.whole, gap=GRID)
        top.setStretch(2, 1)
        self._run = QWidget()
        run = QVBoxLayout(self._run)
        run.setContentsMargins(GRID, 4, GRID, 4)
        run.setSpacing(2)
        run.addLayout(top)
        run.addWidget(self.facts)
        run.addWidget(self.spark, 1)
        self._empty = QWidget()
        empty = row(self.replay, self.hint, gap=2 * GRID)
        empty.setContentsMargins(2 * GRID, GRID, 2 * GRID, GRID)
        empty.setStretch(1, 1)
        self._empty.setLayout(empty)
        layout = column(self, 0, 0)
        layout.addWidget(self._run)
        layout.addWidget(self._empty)

    def _refresh_empty(self) -> None:
        action = self.workbench.actions["plan.replay"]
        possible = action.enabled(self.workbench)
        self.replay.setEnabled(possible and not self.workbench.jobs.running)
        if self.workbench.plan is not None and not possible:
            self.hint.setText(tr("This survey does not say when its points were measured."))
        else:
            self.hint.setText(
                tr("See the plan grow as the sensor moved: one plan for every 20 s of the run.")
            )

    def _refresh_facts(self) -> None:
        moments = self.workbench.timeline
        at = self.slider.value() if self.at < 0 else self.at
        moment = moments[min(at, len(moments) - 1)]
        self.clock.setText(_clock(moment.time))
        self.facts.setText(self._facts(moment))
        self.whole.setEnabled(self.at >= 0)
        self.spark.units = self.workbench.view.look.units
        self.end.setText(_clock(moments[-1].time))
        self.spark.show_values([(m.time, m.seen, m.predicted) for m in moments], at)

    def _facts(self, moment: Snapshot) -> str:
        units = self.workbench.view.look.units
        path = tr("path {length}").format(length=length(moment.path_length, units))
        if moment.plan is None:
            return f"{path} · {tr('no plan yet')}"
        regions = tr_n("%Ln region(s)", len(moment.plan.regions))
        seen = tr("seen {area}").format(area=area(moment.seen, units))
        predicted = tr("predicted {area}").format(area=area(moment.predicted, units))
        return " · ".join((path, regions, seen, predicted))

    def _play(self, on: bool) -> None:
        icons.set_icon(self.play, "pause" if on else "play")
        if not on:
            self._next.stop()
            return
        if self.at < 0 or self.at >= len(self.workbench.timeline) - 1:
            self.slider.setValue(0)
            self.show_moment(0)
        self._next.start(FRAME)

    def _step(self) -> None:
        if self.at + 1 >= len(self.workbench.timeline):
            if not self.workbench.jobs.running:
                self.play.setChecked(False)
            return
        self.slider.setValue(self.at + 1)

    def _show_whole(self) -> None:
        self.play.setChecked(False)
        self.at = -1
        self.workbench.show_snapshot(None)
        self.refresh()


def _clock(seconds: float) -> str:
    """Run time as hours, minutes and seconds.

    >>> _clock(840.0)
    '00:14:00'
    """
    whole = round(seconds)
    return f"{whole // 3600:02d}:{whole // 60 % 60:02d}:{whole % 60:02d}"
