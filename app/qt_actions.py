"""The registry's actions as QActions: one each, shared by menus, toolbar and keys, kept up to date."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer
from PySide6.QtGui import QAction, QKeySequence

from floorcast_app.actions.registry import Action
from floorcast_app.icons import icon
from floorcast_app.translation import tr_action, tr_text
from floorcast_app.view_state import turned_only
from floorcast_app.workbench import Workbench


class QtActions(QObject):
    """QActions by id."""

    def __init__(self, workbench: Workbench, parent: QObject) -> None:
        super().__init__(parent)
        self._workbench = workbench
        self._by_id = {action.id: self._make(action) for action in workbench.actions}
        self._soon = QTimer(self, singleShot=True, interval=0)  # many events, one look at all actions
        self._soon.timeout.connect(self.refresh)
        for event in (
            workbench.plan_changed,
            workbench.survey_changed,
            workbench.selection.changed,
            workbench.document.saved_changed,
            workbench.tool_changed,
            workbench.jobs.started,
            workbench.jobs.ended,
            workbench.view.changed,
        ):
            event.connect(lambda *told: None if turned_only(*told) else self._soon.start())
        self.refresh()

    def __getitem__(self, id: str) -> QAction:
        return self._by_id[id]

    def refresh(self) -> None:
        """Look anew at what is enabled and checked, and in which words."""
        for id, qt in self._by_id.items():
            action = self._workbench.actions[id]
            qt.setEnabled(action.enabled(self._workbench))
            if action.checked is not None:
                qt.setChecked(action.checked(self._workbench))
        for id, text in (
            ("edit.undo", self._workbench.document.undo_text),
            ("edit.redo", self._workbench.document.redo_text),
        ):
            if id in self._by_id:
                plain, _ = tr_action(self._workbench.actions[id])
                self._by_id[id].setText(f"{plain}: {tr_text(text)}" if text else plain)

    def reword(self) -> None:
        """Words of the present language."""
        for id, qt in self._by_id.items():
            self._word(qt, self._workbench.actions[id])
        self.refresh()

    def retinting(self) -> list[Callable[[], None]]:
        """Icons in the colours of the present theme, one at each call: they are drawn anew."""
        named = [(qt, self._workbench.actions[id].icon) for id, qt in self._by_id.items()]
        return [lambda qt=qt, name=name: qt.setIcon(icon(name)) for qt, name in named if name]  # type: ignore[misc]

    def _make(self, action: Action) -> QAction:
        qt = QAction(self)
        if action.shortcut:
            qt.setShortcuts([QKeySequence(s.strip()) for s in action.shortcut.split(" | ")])
        if action.icon:
            qt.setIcon(icon(action.icon))
        qt.setCheckable(action.checked is not None)
        qt.triggered.connect(self._runner(action.id))
        self._word(qt, action)
        return qt

    def _word(self, qt: QAction, action: Action) -> None:
        text, tip = tr_action(action)
        qt.setText(text)
        qt.setIconText("")  # Qt makes it of the text
        keys = f" ({qt.shortcut().toString()})" if action.shortcut else ""
        qt.setToolTip(f"{text.rstrip('…')}{keys}\n{tip}" if tip else text)
        qt.setStatusTip(tip)

    def _runner(self, id: str) -> Callable[[], None]:
        def run() -> None:
            self._workbench.try_run(id)
            self._soon.start()

        return run
