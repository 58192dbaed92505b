"""The context menu of a thing: the actions that fit its kind, in the registry's order."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget

from floorcast_app.actions.registry import Action
from floorcast_app.icons import icon
from floorcast_app.panels.by_hand import by_hand
from floorcast_app.selection import Item
from floorcast_app.translation import tr, tr_action
from floorcast_app.workbench import Workbench

FIT = {  # which actions speak of which kind
    "region": ("correct.rename", "correct.relabel", "correct.merge", "correct.split"),
    "door": ("correct.accept_door", "correct.reject_door", "correct.resize_door"),
    "plane": ("correct.keep_plane", "correct.hide_plane", "correct.move_plane"),
    "check": ("measure.remove",),
}
RELEASE = "correct.release"


def fitting(workbench: Workbench, item: Item | None) -> list[Action]:
    """The actions that are possible now on a selected item."""
    if item is None:
        return []
    ids = (*FIT.get(item.kind, ()), *((RELEASE,) if by_hand(workbench.find(item)) else ()))
    return [a for a in workbench.actions if a.id in ids and a.enabled(workbench)]


def item_menu(workbench: Workbench, item: Item, parent: QWidget) -> QMenu:
    """The menu; it removes itself when it closes."""
    menu = QMenu(parent)
    menu.aboutToHide.connect(menu.deleteLater)
    zoom = menu.addAction(icon("zoom-in"), tr("Zoom to it"))
    zoom.triggered.connect(lambda: workbench.selection.zoom_asked.emit(item))
    hidden = (item.kind, item.id) in workbench.view.look.hidden
    eye = menu.addAction(icon("eye" if hidden else "eye-off"), tr("Show") if hidden else tr("Hide"))
    eye.triggered.connect(
        lambda: workbench.view.set(hidden=workbench.view.look.hidden ^ {(item.kind, item.id)})
    )
    actions = fitting(workbench, item)
    if actions:
        menu.addSeparator()
    for action in actions:
        text, tip = tr_action(action)
        entry = menu.addAction(icon(action.icon), text)
        entry.setToolTip(tip)
        entry.triggered.connect(lambda _=False, id=action.id: workbench.try_run(id))
    return menu
