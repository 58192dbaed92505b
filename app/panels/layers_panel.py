"""What is shown: layers with eyes, how points are coloured, which facings, where the ceiling is cut."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QGridLayout,
    QLabel,
    QSlider,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from floorcast_app import icons, theme
from floorcast_app.format import length
from floorcast_app.panels.base import GRID, Panel, column, label, row, rule, scrolling
from floorcast_app.panels.legend import Legend
from floorcast_app.translation import tr
from floorcast_app.view_state import LAYERS, POINT_COLOURS
from floorcast_app.workbench import Workbench

LAYER_TEXTS = {
    "points": "Points",
    "trajectory": "Trajectory",
    "planes": "Planes",
    "free_space": "Free space",
    "doors": "Doors",
    "regions": "Regions",
    "dimensions": "Dimensions",
}
COLOUR_TEXTS = {
    "height": "Height",
    "facing": "Facing",
    "plane": "Plane",
    "intensity": "Intensity",
    "rgb": "Own colour",
}
FACINGS = (("N", 2, "north"), ("E", 0, "east"), ("S", 3, "south"), ("W", 1, "west"))
CUT_RANGE = (0.2, 6.0)  # metres above the floor
CUT_STEPS = 100  # a metre
CUT_DEFAULT = 2.2
BAR = 12  # px that a scroll bar takes
SECTION_INSET = 0.2  # of the plan's extent: a new section box shows that it cuts
SECTION_FIELDS = ("x from", "y from", "x to", "y to")


class EyeButton(QToolButton):
    """An eye that is open or shut."""

    def __init__(self, tip: str) -> None:
        super().__init__()
        self.setCheckable(True)
        self.setIconSize(QSize(16, 16))
        self.setProperty("role", "eye")
        self.setToolTip(tip)
        self.toggled.connect(self._look)
        self._look(False)

    def _look(self, open_: bool) -> None:
        icons.set_icon(self, "eye" if open_ else "eye-off", "text" if open_ else "faint")


class LayersPanel(Panel):
    """Changes :class:`Look` only."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.eyes = {layer: self._eye(layer) for layer in LAYERS}
        self.colour = self._colour_box()
        self.facings = {value: self._facing(text, value, word) for text, value, word in FACINGS}
        self.cut_on, self.cut, self.cut_text = QCheckBox(tr("Ceiling cut")), QSlider(), QLabel()
        self.section_on = QCheckBox(tr("Section box"))
        self.section = [self._section_spin(i) for i in range(4)]
        inner = QWidget()
        self._fill(column(inner, 2 * GRID, GRID))
        outer = column(self, 0, 0)
        area = scrolling(inner)
        area.setMinimumWidth(inner.minimumSizeHint().width() + BAR)
        outer.addWidget(area)
        self._connect_cut()
        self.listen(workbench.view.changed, workbench.plan_changed)
        self.listen(theme.changed)
        self.refresh()

    def refresh(self) -> None:
        look = self.workbench.view.look
        for layer, eye in self.eyes.items():
            eye.setChecked(layer in look.layers)
        for value, button in self.facings.items():
            button.setChecked(value in look.facings)
        self.colour.setCurrentIndex(POINT_COLOURS.index(look.point_colour))
        self._refresh_cut()
        self._refresh_section()

    # ---- parts ------------------------------------------------------------------------------------------

    def _fill(self, layout: QVBoxLayout) -> None:
        for layer, eye in self.eyes.items():
            line = row(eye, QLabel(tr(LAYER_TEXTS[layer])))
            line.addStretch(1)
            if layer == "points":
                line.addWidget(self.colour)
            layout.addLayout(line)
            if layer == "planes":
                buttons = row(*self.facings.values(), gap=4)
                buttons.insertSpacing(0, 4 * GRID)
                buttons.addStretch(1)
                layout.addLayout(buttons)
        layout.addWidget(rule())
        top = row(self.cut_on)
        top.addStretch(1)
        top.addWidget(self.cut_text)
        layout.addLayout(top)
        layout.addWidget(self.cut)
        layout.addWidget(rule())
        layout.addWidget(self.section_on)
        grid = QGridLayout()
        grid.setSpacing(4)
        for i, (spin, text) in enumerate(zip(self.section, SECTION_FIELDS, strict=True)):
            grid.addWidget(label(tr(text), "small"), (i // 2) * 2, i % 2)
            grid.addWidget(spin, (i // 2) * 2 + 1, i % 2)
        self._section_rows = QWidget()
        self._section_rows.setLayout(grid)
        layout.addWidget(self._section_rows)
        layout.addWidget(rule())
        layout.addWidget(Legend(self.workbench))
        layout.addStretch(1)

    def _eye(self, layer: str) -> EyeButton:
        eye = EyeButton(tr("Show or hide"))
        eye.setObjectName(f"eye-{layer}")
        eye.setAccessibleName(tr(LAYER_TEXTS[layer]))
        eye.clicked.connect(lambda: self.workbench.try_run(f"view.layer_{layer}"))
        return eye

    def _colour_box(self) -> QComboBox:
        box = QComboBox()
        box.addItems([tr(COLOUR_TEXTS[c]) for c in POINT_COLOURS])
        box.setToolTip(tr("What the points are coloured by"))
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(4)
        box.activated.connect(lambda i: self.workbench.try_run(f"view.colour_{POINT_COLOURS[i]}"))
        return box

    def _facing(self, text: str, value: int, word: str) -> QToolButton:
        button = QToolButton()
        button.setText(tr(text))
        button.setCheckable(True)
        button.setProperty("role", "facing")
        button.setProperty("axis", "ns" if text in "NS" else "ew")  # in the colours of the planes
        button.setToolTip(tr("Planes that face {facing}").format(facing=tr(word)))
        button.clicked.connect(
            lambda: self.workbench.view.set(facings=self.workbench.view.look.facings ^ {value})
        )
        return button

    def _connect_cut(self) -> None:
        self.cut.setOrientation(Qt.Orientation.Horizontal)
        self.cut.setRange(*(round(v * CUT_STEPS) for v in CUT_RANGE))
        self.cut.setToolTip(tr("Points above this height are not drawn in 3D"))
        self.cut.valueChanged.connect(self._cut_moved)
        self.cut_on.clicked.connect(
            lambda on: self.workbench.view.set(ceiling_cut=self.cut.value() / CUT_STEPS if on else None)
        )
        self.section_on.clicked.connect(self._section_toggled)

    def _section_spin(self, i: int) -> QDoubleSpinBox:
        spin = QDoubleSpinBox()
        spin.setRange(-10000, 10000)
        spin.setDecimals(1)
        spin.setSingleStep(0.5)
        spin.setSuffix(" m")
        spin.setMinimumWidth(72)
        spin.setAlignment(Qt.AlignmentFlag.AlignRight)
        spin.valueChanged.connect(self._section_typed)
        return spin

    # ---- what happens -----------------------------------------------------------------------------------

    def _cut_moved(self, value: int) -> None:
        if self.cut_on.isChecked() and not self.cut.signalsBlocked():
            self.workbench.view.set(ceiling_cut=value / CUT_STEPS)

    def _section_toggled(self, on: bool) -> None:
        self.workbench.view.set(section=self._first_section() if on else None)

    def _section_typed(self) -> None:
        x0, y0, x1, y1 = (spin.value() for spin in self.section)
        self.workbench.view.set(section=(min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1)))

    def _first_section(self) -> tuple[float, float, float, float]:
        """A box somewhat smaller than the plan, or than the view where there is none."""
        plan, look = self.workbench.plan, self.workbench.view.look
        if plan is None or not plan.regions:
            (x, y), r = look.centre, look.span / 4
            return x - r, y - r, x + r, y + r
        boxes = [r.polygon.bounds for r in plan.regions]
        x0, y0 = min(b[0] for b in boxes), min(b[1] for b in boxes)
        x1, y1 = max(b[2] for b in boxes), max(b[3] for b in boxes)
        dx, dy = SECTION_INSET * (x1 - x0), SECTION_INSET * (y1 - y0)
        return x0 + dx, y0 + dy, x1 - dx, y1 - dy

    def _refresh_cut(self) -> None:
        look = self.workbench.view.look
        on = look.ceiling_cut is not None
        self.cut_on.setChecked(on)
        self.cut.setEnabled(on)
        self.cut.blockSignals(True)
        self.cut.setValue(round((look.ceiling_cut if on else CUT_DEFAULT) * CUT_STEPS))  # type: ignore[operator]
        self.cut.blockSignals(False)
        self.cut_text.setText(length(look.ceiling_cut, look.units) if on else "")

    def _refresh_section(self) -> None:
        section = self.workbench.view.look.section
        self.section_on.setChecked(section is not None)
        self._section_rows.setVisible(section is not None)
        for spin, value in zip(self.section, section or (), strict=False):
            if not spin.hasFocus():
                spin.blockSignals(True)
                spin.setValue(value)
                spin.blockSignals(False)
