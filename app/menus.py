"""The menus of the window: every action that needs no arguments, the recent files, and the panes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMenu

from floorcast_app.actions import MENUS
from floorcast_app.translation import tr

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

MENU_TITLES = {
    "file": "File", "edit": "Edit", "view": "View", "plan": "Plan", "tool": "Tools",
    "correct": "Correct", "measure": "Measure", "help": "Help",
}  # fmt: skip
NOT_IN_MENUS = (  # they need arguments: for the palette's settings, for panes and for scripts
    "view.pane", "view.look", "edit.select", "edit.history", "plan.set", "plan.preset", "measure.set",
)  # fmt: skip
MENU_GROUPS = (  # actions that begin a group of their menu
    "file.save", "file.export", "file.save_recording", "file.close", "edit.delete", "edit.preferences",
    "view.layer_points",
    "view.units", "view.inspect", "plan.reset", "plan.storey", "plan.replay", "tool.measure", "tool.split",
    "correct.accept_door", "correct.relabel", "correct.release", "measure.export", "help.english",
    "help.about",
)  # fmt: skip
SUBMENUS = {"view.layer_": "Layers", "view.colour_": "Points by colour"}  # ids that begin so, and their menu


def fill_menus(window: MainWindow) -> None:
    """Make the menus of ``window`` anew, in the present language."""
    bar = window.menuBar()
    bar.clear()
    menus = {menu: bar.addMenu(tr(MENU_TITLES[menu])) for menu in MENUS}
    inner: dict[str, QMenu] = {}
    for action in window.workbench.actions:
        menu = menus[action.id.partition(".")[0]]
        if action.id in NOT_IN_MENUS:
            continue
        if action.id in MENU_GROUPS:
            menu.addSeparator()
        title = next((t for prefix, t in SUBMENUS.items() if action.id.startswith(prefix)), "")
        if title and title not in inner:
            inner[title] = menu.addMenu(tr(title))
        inner.get(title, menu).addAction(window.actions_by_id[action.id])
        if action.id == "file.open_folder":
            menu.addMenu(_recent_menu(window, menu))
    panes = menus["view"].addMenu(tr("Panes"))
    for dock in window.docks.values():
        panes.addAction(dock.toggleViewAction())


def _recent_menu(window: MainWindow, parent: QMenu) -> QMenu:
    menu = QMenu(tr("Open recent"), parent)

    def fill() -> None:
        menu.clear()
        for path in window.recent.paths():
            menu.addAction(str(path), lambda p=path: window.workbench.try_run("file.open", path=p))
        menu.setDisabled(False)

    menu.aboutToShow.connect(fill)
    return menu
