"""How the docks stand in each workspace, until the user moves them."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow

H, V = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
HIDDEN = {  # panes that a workspace does without
    "inspect": (),
    "plan": ("space", "planes", "free_space", "evidence", "timeline", "layers"),
    "run": ("planes", "free_space", "evidence", "settings", "layers"),
}


def arrange(window: QMainWindow, docks: Mapping[str, QDockWidget], workspace: str) -> None:
    """Put every dock where the workspace has it."""
    for dock in docks.values():
        dock.setFloating(False)
        window.removeDockWidget(dock)
    left = Qt.DockWidgetArea.LeftDockWidgetArea
    bottom = Qt.DockWidgetArea.BottomDockWidgetArea
    window.addDockWidget(left, docks["layers"])
    window.splitDockWidget(docks["layers"], docks["space"], H)
    window.splitDockWidget(docks["space"], docks["planes"], H)
    window.splitDockWidget(docks["planes"], docks["properties"], H)
    window.splitDockWidget(docks["space"], docks["free_space"], V)
    window.splitDockWidget(docks["planes"], docks["floor_plan"], V)
    window.splitDockWidget(docks["properties"], docks["evidence"], V)
    window.splitDockWidget(docks["evidence"], docks["settings"], V)
    window.tabifyDockWidget(docks["evidence"], docks["settings"])
    docks["evidence"].raise_()
    window.addDockWidget(bottom, docks["items"])
    for id in ("ground_truth", "warnings", "history"):
        window.tabifyDockWidget(docks["items"], docks[id])
    docks["items"].raise_()
    window.addDockWidget(bottom, docks["timeline"])
    window.splitDockWidget(docks["items"], docks["timeline"], V)
    for id, dock in docks.items():
        dock.setVisible(id not in HIDDEN[workspace])
    _resize(window, docks, workspace)


def _resize(window: QMainWindow, docks: Mapping[str, QDockWidget], workspace: str) -> None:
    width, height = max(window.width(), 900), max(window.height(), 600)
    side = max(220, round(0.17 * width))
    middle = (width - side - max(180, round(0.12 * width))) // 2
    window.resizeDocks(
        [docks[k] for k in ("layers", "space", "planes", "properties")],
        [max(180, round(0.12 * width)), middle, middle, side],
        H,
    )
    tables = round(0.2 * height)
    tall = {"inspect": 72, "plan": 72, "run": 160}[workspace]
    window.resizeDocks([docks["items"], docks["timeline"]], [tables, tall], V)
    half = (height - tables - tall) // 2
    window.resizeDocks([docks["space"], docks["free_space"]], [half, half], V)
    window.resizeDocks([docks["planes"], docks["floor_plan"]], [half, half], V)
    window.resizeDocks([docks["properties"], docks["evidence"]], [half, half], V)
