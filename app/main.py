"""Start: the Qt application, the window, a survey or a script."""

from __future__ import annotations

import atexit
import logging
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from floorcast_app.warm_up import WarmUp, load_without_collecting

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

SWITCH = 0.0001  # s after which a thread that computes is asked to let the window have the interpreter
SCRIPT_SIZE = (1440, 900)  # pixels of the window that a script sees
PATIENCE = 0.5  # s for modules that are still being imported when the window is gone
LAST_WAIT = 60.0  # s for a thread that is compiling or reading; nobody sees it, the window is gone


def run(survey: Path | None = None, script: Path | None = None) -> int:
    """Open the window with ``survey``, or run ``script`` offscreen; returns the exit status."""
    if script is not None or not _has_display():
        os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    if (
        script is None
        and os.environ.get("QT_QPA_PLATFORM") == "offscreen"
        and "FLOORCAST_OFFSCREEN" not in os.environ
    ):
        from floorplan_core.errors import UsageError

        raise UsageError("There is no display to open a window on; 'floorcast gui --script FILE' needs none.")
    load_without_collecting()
    from PySide6.QtCore import QTimer

    app = make_application()
    window = make_window(unattended=script is not None)
    warming = WarmUp(window.workbench.planner)
    if script is not None:
        from floorcast_app.script import run_script

        window.resize(*SCRIPT_SIZE)
        window.show()
        warming.start()
        try:
            if survey is not None:
                from floorcast_app.script import ScriptedApplication

                ScriptedApplication(window).run("file.open", path=survey)
            run_script(script, window)
        finally:
            window.close()
            _let_end(warming, window)
        return 0
    window.show()
    QTimer.singleShot(0, warming.start)  # the window is painted first
    if survey is not None:
        window.workbench.try_run("file.open", path=survey)
    status = int(app.exec())
    if not _let_end(warming, window, PATIENCE):
        _leave(status)
    return status


def _let_end(warming: WarmUp, window: MainWindow, seconds: float = LAST_WAIT) -> bool:
    """Threads of ours end before the interpreter does: one that is torn off aborts the program.

    False where modules are still being imported after ``seconds``.
    """
    loaded = warming.stop(seconds)
    window.workbench.planner.close()
    window.workbench.jobs.wait(LAST_WAIT)
    return loaded


def _leave(status: int) -> None:
    """End here and now: a thread that imports modules cannot be told to stop, and has nothing to save.

    On a loaded machine the imports of a first start took 10 s after the window was gone.
    """
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def make_application():  # type: ignore[no-untyped-def]
    """The QApplication, with its name, theme, font and language."""
    from PySide6.QtCore import qInstallMessageHandler
    from PySide6.QtWidgets import QApplication

    from floorcast_app import theme
    from floorcast_app.gentle_imports import import_gently
    from floorcast_app.translation import install_translator
    from floorplan_core import __version__

    import_gently()
    sys.setswitchinterval(SWITCH)
    qInstallMessageHandler(_log)
    app = QApplication.instance() or QApplication(sys.argv[:1])
    app.setApplicationName("Floorcast")
    app.setOrganizationName("Floorcast")
    app.setApplicationVersion(__version__)
    install_translator(app)
    theme.apply_theme(app, "light")
    return app


def _log(kind: object, context: object, text: str) -> None:
    """Qt's own remarks go to the log of Python: a user of a script reads our sentences only."""
    logging.getLogger("floorcast.qt").debug("%s", text)


def make_window(unattended: bool = False) -> MainWindow:
    """The main window with an empty document; an unattended one neither asks nor remembers anything."""
    from floorcast_app.main_window import MainWindow
    from floorcast_app.qt_post import QtPost
    from floorcast_app.workbench import Workbench
    from floorcast_app.workers.remote_planner import RemotePlanner

    post = QtPost()
    workbench = Workbench(post, RemotePlanner())
    window = MainWindow(workbench, _settings(unattended), unattended)
    post.setParent(window)
    return window


def _settings(unattended: bool):  # type: ignore[no-untyped-def]
    """The user's settings; those of an unattended window begin empty and are kept nowhere."""
    from PySide6.QtCore import QSettings

    if not unattended:
        return QSettings()
    import shutil
    import tempfile

    folder = tempfile.mkdtemp(prefix="floorcast-")
    settings = QSettings(str(Path(folder) / "settings.ini"), QSettings.Format.IniFormat)

    def forget() -> None:
        settings.sync()  # else it is written, and its folder made again, when Qt itself ends
        shutil.rmtree(folder, ignore_errors=True)

    atexit.register(forget)
    return settings


def _has_display() -> bool:
    if not sys.platform.startswith("linux"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
