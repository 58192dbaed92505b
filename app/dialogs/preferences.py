"""The preferences, made from their table: each takes effect as soon as it is chosen."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QGridLayout, QSpinBox, QWidget

from floorcast_app.dialogs.base import Dialog
from floorcast_app.panels.base import GRID, label, listener_of, rule
from floorcast_app.preferences import PREFERENCES, Preference, Value
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

FIELD_WIDTH = 208  # px
WIDTH = 480  # px of the dialog


class PreferencesDialog(Dialog):
    """One row a preference, under the heading of its group."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(tr("Preferences"), parent)
        self._workbench = workbench
        self.fields: dict[str, QComboBox | QSpinBox] = {}
        self._grid = QGridLayout()
        self._grid.setColumnStretch(0, 1)
        self._grid.setHorizontalSpacing(3 * GRID)
        self._grid.setVerticalSpacing(GRID // 2)
        group = ""
        for preference in PREFERENCES:
            if preference.group != group:
                group = preference.group
                self._begin(group)
            self._add(preference)
        self.body.addLayout(self._grid)
        self.body.addStretch(1)
        self.reset = self.add_button(tr("As it was at first"))
        self.reset.clicked.connect(workbench.preferences.reset)
        self.add_close(tr("Close"))
        self.setMinimumWidth(WIDTH)
        changed = workbench.preferences.changed
        changed.connect(listener_of(self, self._show, changed))

    # ---- inside -----------------------------------------------------------------------------------------

    def _begin(self, group: str) -> None:
        at = self._grid.rowCount()
        if self.fields:
            self._grid.addWidget(rule(), at, 0, 1, 2)
        heading = label(tr(group), "section")
        heading.setContentsMargins(0, GRID if self.fields else 0, 0, 0)
        self._grid.addWidget(heading, at + 1, 0, 1, 2)

    def _add(self, preference: Preference) -> None:
        at = self._grid.rowCount()
        field = self._choice(preference) if preference.choices else self._number(preference)
        field.setFixedWidth(FIELD_WIDTH)
        field.setToolTip(tr(preference.help))
        title, note = label(tr(preference.title)), label(tr(preference.help), "small", wrap=True)
        title.setBuddy(field)
        note.setContentsMargins(0, 0, 0, GRID)
        note.ensurePolished()
        note.setMinimumHeight(note.heightForWidth(WIDTH - 6 * GRID))  # a grid does not ask for it
        self._grid.addWidget(title, at, 0)
        self._grid.addWidget(field, at, 1)
        self._grid.addWidget(note, at + 1, 0, 1, 2)
        self.fields[preference.name] = field
        self._show(preference.name, self._workbench.preferences[preference.name])

    def _choice(self, preference: Preference) -> QComboBox:
        box = QComboBox()
        for value, text in preference.choices:
            box.addItem(tr(text), value)
        box.activated.connect(lambda at: self._chosen(preference.name, box.itemData(at)))
        return box

    def _number(self, preference: Preference) -> QSpinBox:
        box = _Steps(preference) if preference.zero else QSpinBox()
        box.setRange(0 if preference.zero else preference.least, preference.most)
        box.setSingleStep(preference.step)
        box.setAlignment(Qt.AlignmentFlag.AlignRight)
        box.setKeyboardTracking(False)  # a number counts when it is typed to its end
        if preference.unit:
            box.setSuffix(f" {preference.unit}")
        if preference.zero:
            box.setSpecialValueText(tr(preference.zero))
        box.valueChanged.connect(partial(self._chosen, preference.name))
        return box

    def _chosen(self, name: str, value: Value) -> None:
        self._workbench.try_run("edit.preferences", name=name, value=value)
        self._show(name, self._workbench.preferences[name])

    def _show(self, name: str, value: Value) -> None:
        field = self.fields[name]
        field.blockSignals(True)
        if isinstance(field, QComboBox):
            field.setCurrentIndex(field.findData(value))
        else:
            field.setValue(int(value))
        field.blockSignals(False)


class _Steps(QSpinBox):
    """A number, or 0: nothing lies between 0 and the least."""

    def __init__(self, preference: Preference) -> None:
        super().__init__()
        self._least = preference.least

    def stepBy(self, steps: int) -> None:
        before = self.value()
        super().stepBy(steps)
        if 0 < self.value() < self._least:
            self.setValue(self._least if before == 0 else 0)


def show(window: MainWindow) -> PreferencesDialog:
    """Open the preferences, or bring them forward."""
    found = window.findChild(PreferencesDialog)
    dialog = found if found is not None else PreferencesDialog(window.workbench, window)
    dialog.open_over(window)
    return dialog
