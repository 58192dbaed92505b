"""The entry point of ``floorcast``: runs a command, turns every failure into one sentence and an exit status.

Only the standard library is imported before :func:`main` runs, so that Ctrl-C during the imports is
already handled here.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from io import TextIOWrapper
from typing import TYPE_CHECKING

from floorplan_core.cli import NO_MEMORY

if TYPE_CHECKING:
    from floorplan_core.observer import CancelToken


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and exit with the documented status."""
    _open_what_is_closed()
    try:
        status = _flushed(run(sys.argv[1:] if arguments is None else list(arguments)))
    except KeyboardInterrupt:  # after the last word, while it went out
        status = 130
    for number in (signal.SIGINT, signal.SIGTERM):  # what was to be done is done: its status counts
        signal.signal(number, signal.SIG_IGN)
    sys.exit(status)


def _open_what_is_closed() -> None:
    """With a closed stream (``>&-``) there is none to write to, and the next file would take its number."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # names of files may hold what no terminal has letters for
            stream.reconfigure(errors="backslashreplace")


def run(arguments: list[str]) -> int:
    """Run one command; returns its exit status and never raises."""
    try:
        from floorplan_core.cli.signals import interrupts_cancel

        with interrupts_cancel() as token:
            return _invoke(arguments, token)
    except BrokenPipeError:
        return _reader_has_gone()
    except SystemExit as stop:  # a library gives up
        return stop.code if isinstance(stop.code, int) else 1
    except BaseException as error:  # noqa: BLE001 - the last line of defence: nobody ever sees a traceback
        return _report(error, arguments)


def _invoke(arguments: list[str], token: CancelToken) -> int:
    import typer.main

    from floorplan_core.cli.app import app

    command = typer.main.get_command(app)
    try:
        with command.make_context("floorcast", list(arguments), obj=token) as context:
            command.invoke(context)
    except typer.Exit as stop:
        return stop.exit_code
    return 0


def _report(error: BaseException, arguments: list[str]) -> int:
    try:
        from floorplan_core.cli.failures import explain

        sentence, status = _explain_wrong_use(error) or explain(error)
    except MemoryError:  # so little that not even the words could be loaded
        sentence, status = NO_MEMORY, 4
    if sentence:
        _say(sentence, error, status, arguments)
    return status


def _explain_wrong_use(error: BaseException) -> tuple[str, int] | None:
    """The sentence of an error that typer found in the arguments, with the command's own help named."""
    import typer

    if isinstance(error, typer.Abort):
        return "Interrupted; nothing was left half-written.", 130
    if not isinstance(error, typer.TyperException):
        return None
    context = getattr(error, "ctx", None)
    if type(error).__name__ == "NoArgsIsHelpError":
        return "", 2  # the help was shown
    text = " ".join(str(getattr(error, "format_message", lambda: error)()).split()).rstrip(".")
    return f"{text}; see '{context.command_path if context else 'floorcast'} --help'.", 2


def _say(sentence: str, error: BaseException, status: int, arguments: list[str]) -> None:
    if "--debug" in arguments:
        import traceback

        traceback.print_exception(error, file=sys.stderr)
    if "--json" in arguments:
        import json

        with suppress(OSError):  # which may be just what went wrong
            sys.stdout.write(json.dumps({"ok": False, "error": sentence, "status": status}) + "\n")
    sys.stderr.write(f"floorcast: {sentence}\n")


def _reader_has_gone() -> int:
    """Whoever read our output closed it (``floorcast settings | head``): they had enough; no error."""
    _silence_stdout()
    return 0


def _silence_stdout() -> None:
    """Point stdout at nothing, so that the interpreter's last flush cannot fail."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _flushed(status: int) -> int:
    """``status``, or that of the error that shows up only when the last output is flushed."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        return _reader_has_gone()
    except OSError as error:
        _silence_stdout()
        if status == 0:
            from floorplan_core.files import output_error

            sys.stderr.write(f"floorcast: {output_error(error, 'to the standard output')}\n")
        return status or 3
    return status


if __name__ == "__main__":
    main()
