"""The settings form, made from the configuration: changed settings first, presets with reasons, a search."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QDockWidget, QFrame, QLineEdit, QPushButton, QToolButton, QVBoxLayout, QWidget

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID, Panel, clear, column, label, row, scrolling, set_role
from floorcast_app.panels.fold import Fold
from floorcast_app.panels.setting_editors import SettingEditor
from floorcast_app.panels.setting_fields import (
    SettingField,
    changed_fields,
    readable,
    setting_field,
    setting_stages,
    value_of,
)
from floorcast_app.presets import Preset, presets
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench

DEBOUNCE = 150  # ms between the last move of a slider and the plan
WAIT_FOR_DRAG = 200  # ms until the list of changed settings is looked at again while a slider is held
MOST_FOUND = 24  # settings that a search shows


class SettingsPanel(Panel):
    """All settings of the document; each change is one undoable step."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.search = QLineEdit()
        self.search.setPlaceholderText(tr("Search settings"))
        self.search.setClearButtonEnabled(True)
        glass = icons.icon("search", theme.colours().faint)
        self.search.addAction(glass, QLineEdit.ActionPosition.LeadingPosition)
        self.reset = QToolButton()
        icons.set_icon(self.reset, "rotate-ccw")
        self.reset.setToolTip(tr("Reset all settings"))
        self.reset.clicked.connect(lambda: workbench.try_run("plan.reset"))
        self.folds: dict[str, Fold] = {}
        self._editors: dict[str, list[SettingEditor]] = {}
        self._pending: dict[str, tuple[Any, str]] = {}
        self._apply_soon = QTimer(self)
        self._apply_soon.setSingleShot(True)
        self._apply_soon.timeout.connect(self.apply)
        self._lay_out()
        self.search.textChanged.connect(self._search)
        self.listen(workbench.document.changed, workbench.document.saved_changed)
        self.listen(workbench.setting_asked, then=self.reveal)
        self.refresh()

    def refresh(self) -> None:
        config = self.workbench.state.config
        changed = changed_fields(config)
        self.reset.setEnabled(any(f.stage != "input" for f in changed))
        if not any(e.dragging for editors in self._editors.values() for e in editors):
            self._show_changed(changed)
        else:
            self._soon.start(WAIT_FOR_DRAG)
        for name, editors in self._editors.items():
            if name not in self._pending:
                for editor in editors:
                    editor.show_value(value_of(config, name))
        for stage in setting_stages():
            self.folds[stage.name].set_count(sum(f.stage == stage.name for f in changed))
        for preset, button in self._preset_buttons.items():
            holds = preset.holds(config)
            button.setEnabled(not holds)
            button.setText(tr("In use") if holds else tr("Use"))

    def apply(self) -> None:
        """Take over what was edited since the last time."""
        pending, self._pending = self._pending, {}
        for name, (value, gesture) in pending.items():
            if value != value_of(self.workbench.state.config, name):
                self.workbench.try_run("plan.set", name=name, value=value, gesture=gesture)
        self.refresh_soon()

    def editor(self, name: str) -> SettingEditor:
        """The editor of a setting in its stage, unfolded."""
        self.folds[setting_field(name).stage].unfold()
        return self._editors[name][-1]

    def reveal(self, name: str) -> None:
        """Bring a setting into view."""
        self.search.clear()
        editor = self.editor(name)
        dock = self.parentWidget()
        if isinstance(dock, QDockWidget):
            dock.show()
            dock.raise_()
        QTimer.singleShot(0, lambda: self._area.ensureWidgetVisible(editor, 0, 6 * GRID))
        set_role(editor.title, "changed")

    # ---- parts ------------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        top = row(self.search, self.reset)
        top.setContentsMargins(2 * GRID, GRID, GRID, GRID)
        self._found = QWidget()
        self._found_layout = column(self._found, 0, 4)
        self._changed = QWidget()
        self._changed_layout = column(self._changed, 0, 4)
        self._changed_names: tuple[str, ...] = ()
        self._tree = QWidget()
        tree = column(self._tree, 0, 4)
        tree.addWidget(self._presets())
        for stage in setting_stages():
            self.folds[stage.name] = Fold(
                tr(stage.title), tr(stage.help), lambda s=stage: self._fields(s.fields)
            )
            tree.addWidget(self.folds[stage.name])
        inner = QWidget()
        body = column(inner, 0, GRID)
        body.setContentsMargins(2 * GRID, 0, 2 * GRID, 2 * GRID)
        for part in (self._changed, self._found, self._tree):
            body.addWidget(part)
        body.addStretch(1)
        self._area = scrolling(inner)
        layout = column(self, 0, 0)
        layout.addLayout(top)
        layout.addWidget(self._area)
        self._found.hide()
        self._changed.hide()

    def _fields(self, fields: Sequence[SettingField]) -> QWidget:
        holder = QWidget()
        layout = column(holder, 0, 4)
        layout.setContentsMargins(2 * GRID + 4, 0, 0, GRID)
        for field in fields:
            layout.addWidget(self._new_editor(field))
        return holder

    def _new_editor(self, field: SettingField, stage: str = "") -> SettingEditor:
        editor = SettingEditor(field, stage)
        editor.edited.connect(self._edited)
        editor.show_value(value_of(self.workbench.state.config, field.name))
        self._editors.setdefault(field.name, []).append(editor)
        return editor

    def _presets(self) -> Fold:
        self._preset_buttons: dict[Preset, QPushButton] = {}
        holder = QWidget()
        layout = column(holder, 0, GRID)
        layout.setContentsMargins(2 * GRID + 4, 4, 0, GRID)
        for preset in presets():
            layout.addWidget(self._preset(preset))
        return Fold(tr("Presets"), tr("Settings that belong together, with the reason why"), lambda: holder)

    def _preset(self, preset: Preset) -> QFrame:
        card = QFrame()
        card.setProperty("role", "card")
        use = QPushButton(tr("Use"))
        use.setObjectName(f"preset-{preset.id}")
        use.clicked.connect(
            lambda: self.workbench.try_run(
                "plan.preset", settings=dict(preset.settings), name=tr(preset.name)
            )
        )
        self._preset_buttons[preset] = use
        layout = QVBoxLayout(card)
        layout.setContentsMargins(GRID + 4, GRID, GRID, GRID)
        layout.setSpacing(4)
        top = row(label(tr(preset.name), "changed", wrap=True), use)
        top.setStretch(0, 1)
        layout.addLayout(top)
        layout.addWidget(label(tr(preset.reason), "small", wrap=True))
        card.setToolTip("\n".join(f"{name} = {value}" for name, value in preset.settings))
        return card

    def _show_changed(self, changed: Sequence[SettingField]) -> None:
        names = tuple(f.name for f in changed)
        if names == self._changed_names:
            return
        self._changed_names = names
        self._drop_editors(self._changed)
        clear(self._changed_layout)
        if changed:
            self._changed_layout.addWidget(label(tr("Changed"), "section"))
            for field in changed:
                self._changed_layout.addWidget(self._new_editor(field, _stage_title(field)))
                self._editors[field.name].insert(0, self._editors[field.name].pop())
            self._changed_layout.addSpacing(GRID)
        self._changed.setVisible(bool(changed) and not self.search.text())

    # ---- what happens -----------------------------------------------------------------------------------

    def _edited(self, name: str, value: Any, gesture: str) -> None:
        self._pending[name] = (value, gesture)
        self._apply_soon.start(DEBOUNCE)

    def _search(self, text: str) -> None:
        typed = text.casefold().split()
        self._tree.setVisible(not typed)
        self._found.setVisible(bool(typed))
        self._changed.setVisible(not typed and bool(self._changed_names))
        self._drop_editors(self._found)
        clear(self._found_layout)
        if not typed:
            return
        found = [f for s in setting_stages() for f in s.fields if all(t in _words(f, s.title) for t in typed)]
        for field in found[:MOST_FOUND]:
            self._found_layout.addWidget(self._new_editor(field, _stage_title(field)))
        if not found:
            self._found_layout.addWidget(label(tr("No setting is called that."), "muted"))

    def _drop_editors(self, holder: QWidget) -> None:
        """Forget the editors of a part that is about to be cleared."""
        for name, editors in list(self._editors.items()):
            self._editors[name] = [e for e in editors if not holder.isAncestorOf(e)]
            if not self._editors[name]:
                del self._editors[name]


def _stage_title(field: SettingField) -> str:
    return tr(readable(field.stage))


def _words(field: SettingField, stage: str) -> str:
    return " ".join((field.name, tr(field.title), tr(field.help), tr(stage))).casefold()
