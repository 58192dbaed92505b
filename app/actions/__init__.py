"""Every command of the application as data: one id for the menu, the toolbar, the palette and the script."""

from __future__ import annotations

from importlib import import_module

from floorcast_app.actions.registry import ActionRegistry

MENUS = ("file", "edit", "view", "plan", "tool", "correct", "measure", "help")  # in the order of the menu bar


def all_actions() -> ActionRegistry:
    """What every menu's module declares as ``ACTIONS``."""
    registry = ActionRegistry()
    for menu in MENUS:
        registry.add(*import_module(f"floorcast_app.actions.{menu}_actions").ACTIONS)
    return registry
