"""The workbench of the tests of plan panes."""

from tests.app.plan_panes import drawn

__all__ = ["drawn"]
