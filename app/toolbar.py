"""The toolbar: what is done most, in words where the window is wide enough, and the workspaces at its end."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QMenu, QSizePolicy, QToolBar, QToolButton, QWidget

from floorcast_app.panels.base import listener_of
from floorcast_app.panels.storey_chooser import StoreyChooser
from floorcast_app.qt_actions import QtActions
from floorcast_app.translation import tr
from floorcast_app.workbench import Workbench

ITEMS = (
    "file.open", "file.save", "|", "plan.again", "plan.cancel", "|", "edit.undo", "edit.redo", "|",
    "tool.select", "tool.measure", "tool.plane", "tool.door", "tool.wall", "tool.split", "tool.merge", "|",
    "view.fit", "storey", "|", "file.export", "file.picture", "<->",
    "view.inspect", "view.plan", "view.run", "|", "view.theme",
)  # fmt: skip
SPELT = ("view.inspect", "view.plan", "view.run", "file.export", "plan.again", "file.open")  # in this order
ICON = 20  # px


class MainToolbar(QToolBar):
    """Words appear beside the icons one after the other, as the width allows."""

    def __init__(self, workbench: Workbench, actions: QtActions, parent: QWidget) -> None:
        super().__init__(tr("Toolbar"), parent)
        self._workbench = workbench
        self.setObjectName("toolbar")
        self.setMovable(False)
        self.setIconSize(QSize(ICON, ICON))
        self._respell = QTimer(
            self, singleShot=True, interval=0
        )  # when what stands in it is wider or narrower
        self._respell.timeout.connect(self.spell)
        for id in ITEMS:
            if id == "|":
                self.addSeparator()
            elif id == "<->":
                self.addWidget(_spring())
            elif id == "storey":
                self._add_storeys()
            else:
                self.addAction(actions[id])
        for id in SPELT:
            actions[id].setIconText(f" {actions[id].iconText()}")  # icon and word stand a little apart
        self._spelt = [self._button(actions, id) for id in SPELT]
        self._add_formats(self._button(actions, "file.export"))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.spell()

    def spell(self) -> None:
        """Words beside as many icons as there is room for."""
        for button in self._spelt:
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        for button in self._spelt:
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            if self.sizeHint().width() > self.width():
                button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
                return

    def _button(self, actions: QtActions, id: str) -> QToolButton:
        button = self.widgetForAction(actions[id])
        assert isinstance(button, QToolButton)
        return button

    def _add_formats(self, button: QToolButton) -> None:
        """The formats that the plan can be written in, below the arrow."""
        menu = QMenu(button)

        def fill() -> None:
            from floorplan_core.plugins import default_registry

            menu.clear()
            for exporter in default_registry().exporters:
                text = f"{exporter.name}\t{exporter.suffixes[0]}"
                action = menu.addAction(text, lambda s=exporter.suffixes[0]: self._export(s))
                action.setToolTip(tr(exporter.description))

        menu.setToolTipsVisible(True)
        menu.aboutToShow.connect(fill)
        button.setPopupMode(QToolButton.ToolButtonPopupMode.MenuButtonPopup)
        button.setMenu(menu)

    def _export(self, suffix: str) -> None:
        self._workbench.try_run("file.export", suffix=suffix)

    def _add_storeys(self) -> None:
        """The chooser of storeys, there only where a survey has several."""
        chooser = StoreyChooser(self._workbench, self)
        shown = self.addWidget(chooser)

        def follow(*_: object) -> None:
            shown.setVisible(chooser.wanted)
            self._respell.start()

        changed = self._workbench.plan_changed
        changed.connect(listener_of(self, follow, changed))
        chooser.refilled.connect(self._respell.start)
        shown.setVisible(chooser.wanted)


def _spring() -> QWidget:
    """Takes what is left of the width."""
    made = QWidget()
    made.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
    made.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
    return made
