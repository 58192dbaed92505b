"""The paper's figure (b): the slice of the voxel map, with a slider for its height."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QResizeEvent
from PySide6.QtWidgets import QFrame, QLabel, QSlider, QToolButton, QVBoxLayout, QWidget

from floorcast_app import format, theme
from floorcast_app.translation import tr
from floorcast_app.viewports.canvas import PlanCanvas
from floorcast_app.viewports.free_space_legend import paint_legend
from floorcast_app.viewports.listening import listen, stop_listening
from floorcast_app.viewports.plan_frame import Frame, colour
from floorcast_app.workbench import Workbench

SETTING = "occupancy.slice_height"
LOWEST, HIGHEST = 0.1, 3.0  # metres, of the slider; settings take more
STEPS = 100  # of the slider for a metre
DEBOUNCE = 150  # ms: no planning while the slider still moves


class FreeSpaceView(PlanCanvas):
    """White known free, hatched grey predicted, black occupied, a tone for what nobody saw."""

    kinds = ("free_space", "trajectory")
    hits = ("region",)
    empty = "Free space appears here once a survey is planned."

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.height_slider = HeightSlider(workbench, self)

    def ground(self, frame: Frame) -> QColor:
        shown = (self._drawing is not None or self._partial) and "free_space" in frame.look.layers
        return colour(frame.colours.unobserved if shown else frame.colours.canvas)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.height_slider.place(self.width(), self.height())

    def _plan_changed(self, plan: object) -> None:
        super()._plan_changed(plan)
        self.height_slider.follow()

    def _paint_over(self, painter: QPainter, frame: Frame, interactive: bool) -> None:
        super()._paint_over(painter, frame, interactive)
        if self._drawing is not None and "free_space" in frame.look.layers:
            paint_legend(painter, frame, self._drawing.source)

    def shut_down(self) -> None:
        self.height_slider.shut_down()
        super().shut_down()


class HeightSlider(QFrame):
    """The height h of the slice; letting go of it plans again."""

    def __init__(self, workbench: Workbench, parent: QWidget) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self.setObjectName("heightSlider")
        self.setCursor(Qt.CursorShape.ArrowCursor)
        self.label = QLabel(alignment=Qt.AlignmentFlag.AlignCenter)
        self.slider = QSlider(Qt.Orientation.Vertical)
        self.slider.setRange(round(LOWEST * STEPS), round(HIGHEST * STEPS))
        self.slider.setPageStep(STEPS // 10)
        self.slider.setToolTip(tr("Height of the slice above the floor"))
        self.auto = QToolButton()
        self.auto.setText(tr("Auto"))
        self.auto.setToolTip(tr("The height at which most free space was seen"))
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 8, 6, 6)
        column.setSpacing(6)
        for widget in (self.label, self.slider, self.auto):
            column.addWidget(widget, 0, Qt.AlignmentFlag.AlignHCenter)
        column.setStretch(1, 1)
        self._later = QTimer(self, singleShot=True, interval=DEBOUNCE)
        self._later.timeout.connect(self._apply)
        self.slider.valueChanged.connect(self._moved)
        self.auto.clicked.connect(lambda: self._set(None))
        self._bound = (
            (workbench.view.changed, self._changed),
            (workbench.document.changed, self._changed),
            (theme.changed, self._restyle),
        )
        listen(self, self._bound)
        self._restyle("")
        self.follow()

    def shut_down(self) -> None:
        """Stop listening."""
        stop_listening(self._bound)

    def place(self, width: int, height: int) -> None:
        """At the right of a pane of this size."""
        tall = min(height - 150, 260)
        self.setVisible(tall > 110 and self._workbench.plan is not None)
        self.setGeometry(width - 74, 66, 64, max(tall, 110))

    def follow(self) -> None:
        """Show the height of the present plan."""
        plan = self._workbench.plan
        if plan is not None and not self.slider.isSliderDown() and not self._later.isActive():
            with QSignalBlocker(self.slider):
                self.slider.setValue(round(plan.grid.slice_height * STEPS))
        self._show()
        parent = self.parentWidget()
        self.place(parent.width(), parent.height())

    def _moved(self, value: int) -> None:
        self._show()
        self._later.start()

    def _apply(self) -> None:
        value = self.slider.value() / STEPS
        plan = self._workbench.plan
        if plan is not None and round(plan.grid.slice_height * STEPS) != self.slider.value():
            self._set(value)

    def _set(self, value: float | None) -> None:
        if self._workbench.state.config.occupancy.slice_height != value:
            self._workbench.try_run("plan.set", name=SETTING, value=value)

    def _show(self) -> None:
        text = format.length(self.slider.value() / STEPS, self._workbench.view.look.units)
        self.label.setText(text.replace("0 m", " m") if text.endswith("0 m") else text)
        chosen = self._workbench.state.config.occupancy.slice_height
        self.auto.setEnabled(chosen is not None)

    def _changed(self, before: object, after: object) -> None:
        self._show()

    def _restyle(self, name: str) -> None:
        c = theme.colours()
        self.setStyleSheet(
            f"#heightSlider {{ background: {c.panel}; border: 1px solid {c.line}; border-radius: 6px; }}"
            f"#heightSlider QLabel {{ background: transparent; color: {c.text}; font-size: 11px; }}"
            f"QSlider::groove:vertical {{ width: 4px; border-radius: 2px; background: {c.line_strong}; }}"
            f"QSlider::add-page:vertical {{ width: 4px; border-radius: 2px; background: {c.accent}; }}"
            f"QSlider::handle:vertical {{ width: 12px; height: 12px; margin: 0 -5px; border-radius: 7px;"
            f" background: {c.panel}; border: 1px solid {c.accent}; }}"
        )
