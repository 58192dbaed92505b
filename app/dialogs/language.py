"""The language that the next start speaks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.translation import LANGUAGES, tr
from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow


def show(window: MainWindow, language: str) -> None:
    """Remember ``language``; texts that are on the screen already stay until the next start."""
    if language not in LANGUAGES:
        raise UsageError(f"There is no language {language!r}; there are: {', '.join(LANGUAGES)}.")
    window.workbench.preferences.set("language", language)
    window.tell(tr("{language} from the next start on.").format(language=LANGUAGES[language]))
