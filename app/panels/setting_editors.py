"""One line of the settings form: name, slider, number, and a way back to how it comes."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDoubleSpinBox,
    QLineEdit,
    QSlider,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from floorcast_app import icons
from floorcast_app.format import number
from floorcast_app.panels.base import label, row, set_role
from floorcast_app.panels.setting_fields import SLIDER_STEPS, SettingField
from floorcast_app.translation import tr

SPIN_WIDTH = 92  # px
HIGHEST = 1e9  # what a spin box takes where nothing bounds it


class SettingEditor(QWidget):
    """Edits one setting; ``edited(name, value, gesture)`` at each change, nothing at :meth:`show_value`."""

    edited = Signal(str, object, str)

    def __init__(self, field: SettingField, stage: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.field = field
        self._gestures = 0
        self._showing = False
        self.title = label(f"{stage} · {tr(field.title)}" if stage else tr(field.title), wrap=True)
        self.reset = QToolButton()
        self.reset.setIconSize(QSize(14, 14))
        self.reset.setProperty("role", "eye")
        icons.set_icon(self.reset, "rotate-ccw", "muted")
        self.reset.clicked.connect(lambda: self.edited.emit(field.name, field.default, ""))
        self.automatic = QCheckBox(tr("Automatic"))
        self.control = _control(field)
        self.setToolTip(self._tip())
        self._lay_out()
        self._connect()

    def show_value(self, value: Any) -> None:
        """Show ``value`` without reporting it."""
        self._showing = True
        changed = value != self.field.default
        set_role(self.title, "changed" if changed else "")
        self.reset.setVisible(changed)
        self.reset.setToolTip(tr("Back to {value}").format(value=self._text(self.field.default)))
        self.automatic.setChecked(value is None)
        self.control.setEnabled(value is not None)
        if value is not None:
            self.control.show_value(value)
        self._showing = False

    @property
    def dragging(self) -> bool:
        """True while its slider is held."""
        return isinstance(self.control, NumberControl) and self.control.slider.isSliderDown()

    # ---- inside -----------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 2, 0, 2)
        layout.setSpacing(0)
        top = row(self.title)
        top.setStretch(0, 1)
        if self.field.optional:
            top.addWidget(self.automatic)
        top.addWidget(self.reset)
        layout.addLayout(top)
        layout.addWidget(self.control)
        self.title.setMinimumHeight(22)

    def _connect(self) -> None:
        self.control.changed.connect(self._changed)
        self.automatic.clicked.connect(self._automatic_clicked)
        if isinstance(self.control, NumberControl):
            self.control.slider.sliderPressed.connect(self._gesture_begins)

    def _gesture_begins(self) -> None:
        self._gestures += 1

    def _changed(self, value: Any) -> None:
        if not self._showing:
            gesture = f"{self.field.name}#{id(self)}.{self._gestures}" if self.dragging else ""
            self.edited.emit(self.field.name, value, gesture)

    def _automatic_clicked(self, on: bool) -> None:
        first = max(self.field.low, min(self.field.soft, 1.0))
        self.edited.emit(self.field.name, None if on else first, "")

    def _text(self, value: Any) -> str:
        return tr("automatic") if value is None else f"{value} {self.field.unit}".strip()

    def _tip(self) -> str:
        field = self.field
        bounds = ""
        if field.kind in ("int", "float"):
            bounds = tr("{low} to {high}").format(
                low=number(field.low, "g"), high=f"{number(field.high, 'g')} {field.unit}".strip()
            )
        comes = tr("comes as {value}").format(value=self._text(field.default))
        return f"{tr(field.help)}\n{field.name} · {' · '.join(filter(None, (bounds, comes)))}"


class Control(QWidget):
    """What all kinds of controls do."""

    changed = Signal(object)

    def show_value(self, value: Any) -> None:
        """Show ``value``."""


class NumberControl(Control):
    """A slider over the usual range beside a spin box over all that is allowed."""

    def __init__(self, field: SettingField) -> None:
        super().__init__()
        self._field = field
        self.slider = QuietSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, SLIDER_STEPS)
        self.spin = QuietSpin()
        self.spin.setDecimals(field.decimals)
        self.spin.setRange(field.low, min(field.high, HIGHEST))
        self.spin.setSingleStep(field.step)
        self.spin.setKeyboardTracking(False)
        self.spin.setFixedWidth(SPIN_WIDTH)
        self.spin.setAlignment(Qt.AlignmentFlag.AlignRight)
        if field.unit:
            self.spin.setSuffix(f" {field.unit}")
        self.setLayout(row(self.slider, self.spin))
        self.slider.valueChanged.connect(self._slid)
        self.spin.valueChanged.connect(self._typed)

    def show_value(self, value: Any) -> None:
        for widget in (self.slider, self.spin):
            widget.blockSignals(True)
        if not self.slider.isSliderDown():
            self.slider.setValue(self._field.position(float(value)))
        if not self.spin.hasFocus() or self.spin.value() != value:
            self.spin.setValue(float(value))
        for widget in (self.slider, self.spin):
            widget.blockSignals(False)

    def _slid(self, position: int) -> None:
        value = self._field.value(position)
        self.spin.blockSignals(True)
        self.spin.setValue(value)
        self.spin.blockSignals(False)
        self.changed.emit(value)

    def _typed(self, value: float) -> None:
        self.changed.emit(int(value) if self._field.kind == "int" else round(value, 6))


class ChoiceControl(Control):
    """One of some words."""

    def __init__(self, field: SettingField) -> None:
        super().__init__()
        self._choices = field.choices
        self.box = QuietCombo()
        self.box.addItems([tr(c) for c in field.choices])
        self.setLayout(row(self.box))
        self.box.activated.connect(lambda i: self.changed.emit(self._choices[i]))

    def show_value(self, value: Any) -> None:
        if value in self._choices:
            self.box.setCurrentIndex(self._choices.index(value))


class TextControl(Control):
    """A word."""

    def __init__(self, field: SettingField) -> None:
        super().__init__()
        self.line = QLineEdit()
        self.setLayout(row(self.line))
        self.line.editingFinished.connect(lambda: self.changed.emit(self.line.text()))

    def show_value(self, value: Any) -> None:
        if not self.line.hasFocus():
            self.line.setText(str(value))


class _Quiet:
    """The wheel scrolls the form, it does not change numbers by accident."""

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()


class QuietSlider(_Quiet, QSlider):
    """A slider that the wheel does not move."""


class QuietSpin(_Quiet, QDoubleSpinBox):
    """A spin box that the wheel does not turn."""


class QuietCombo(_Quiet, QComboBox):
    """A combo box that the wheel does not turn."""


def _control(field: SettingField) -> Control:
    if field.name == "labels.classifier":
        from dataclasses import replace

        return ChoiceControl(replace(field, choices=_classifiers()))
    if field.kind == "choice":
        return ChoiceControl(field)
    return TextControl(field) if field.kind == "text" else NumberControl(field)


def _classifiers() -> tuple[str, ...]:
    """The names of all region classifiers, plugins included."""
    from floorplan_core.plugins import default_registry

    return tuple(c.name for c in default_registry().classifiers)
