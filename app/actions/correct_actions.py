"""The correct menu."""

from __future__ import annotations

from floorcast_app.actions.registry import Action

ACTIONS: tuple[Action, ...] = ()
