"""What runs: the stage, a bar, the time left, and Cancel. Shown only while a job runs; never in the way."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QToolButton, QWidget

from floorcast_app import icons
from floorcast_app.format import seconds
from floorcast_app.jobs import Progress
from floorcast_app.panels.base import GRID, label, listener_of
from floorcast_app.translation import tr, tr_text
from floorcast_app.workbench import Workbench

BAR_WIDTH = 160  # px
LEFT_WIDTH = 96  # px, so that the bar does not dance
FULL = 1000
STAGES = {
    "compile": "Preparing for the first survey (only once)",
    "read": "Reading points",
    "drift": "Correcting the path",
    "frame": "Finding the axes",
    "storeys": "Finding the storeys",
    "segments": "Layout segments",
    "planes": "Layout planes",
    "occupancy": "Free space",
    "doors": "Doors",
    "candidates": "Candidate rectangles",
    "cover": "Covering the free space",
    "regions": "Regions",
    "labels": "Labels",
    "replay": "Replaying the run",
    "export": "Exporting",
}


class ProgressStrip(QWidget):
    """A line for the status bar."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self.text = QLabel()
        self.bar = QProgressBar()
        self.bar.setTextVisible(False)
        self.bar.setFixedWidth(BAR_WIDTH)
        self.left = label("", "small")
        self.left.setMinimumWidth(LEFT_WIDTH)
        self.cancel = QToolButton()
        icons.set_icon(self.cancel, "x", "muted")
        self.cancel.setToolTip(tr("Cancel (Esc)"))
        self.cancel.clicked.connect(lambda: workbench.try_run("plan.cancel"))
        layout = QHBoxLayout(self)
        layout.setContentsMargins(GRID, 0, GRID, 0)
        layout.setSpacing(GRID)
        for widget in (self.text, self.bar, self.left, self.cancel):
            layout.addWidget(widget)
        jobs = workbench.jobs
        for event, then in (
            (jobs.started, self._started),
            (jobs.progressed, self._progressed),
            (jobs.ended, self._ended),
        ):
            event.connect(listener_of(self, then, event))
        self.setVisible(jobs.running)

    def _started(self, text: str) -> None:
        self.text.setText(tr_text(text))
        self.left.clear()
        self.bar.setRange(0, 0)
        self.show()

    def _progressed(self, progress: Progress) -> None:
        self.text.setText(stage_text(progress.stage))
        if progress.total:
            self.bar.setRange(0, FULL)
            self.bar.setValue(min(FULL, FULL * progress.done // progress.total))
        else:
            self.bar.setRange(0, 0)
        left = progress.seconds_left
        self.left.setText("" if left is None else tr("{time} left").format(time=seconds(max(left, 0.1))))

    def _ended(self, error: Exception | None) -> None:
        self.hide()


def stage_text(stage: str) -> str:
    """What a stage does, in words."""
    return tr(STAGES[stage]) if stage in STAGES else stage.replace("_", " ").capitalize()
