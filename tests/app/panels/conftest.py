"""Panels need a QApplication with the look of the application, and a workbench that is put back."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from floorcast_app import theme
from floorcast_app.view_state import Look
from floorcast_app.workbench import Workbench
from tests.app.pump import settle


@pytest.fixture(autouse=True)
def look(qapp: QApplication) -> Iterator[None]:
    """The light theme."""
    if theme.name() != "light" or not qapp.styleSheet():
        theme.apply_theme(qapp, "light")
    yield
    if theme.name() != "light":
        theme.apply_theme(qapp, "light")


@pytest.fixture
def planned(sample_workbench: Workbench, qtbot: QtBot) -> Iterator[Workbench]:
    """The bundled survey with its plan; all steps are undone at the end."""
    yield sample_workbench
    sample_workbench.document.go_to(0)
    settle(sample_workbench)
    sample_workbench.selection.select(None)
    sample_workbench.view.put(Look())
