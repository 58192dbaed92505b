"""Options that several commands share, declared once, and the configuration that they lead to."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from floorplan_core.config import Config


def named_path(text: str) -> Path:
    """The path of an argument; an empty one (a variable that is not set) would be the current folder."""
    if not str(text):
        raise typer.BadParameter("it is empty: name a file or a folder")
    return Path(text)


JsonFlag = Annotated[
    bool, typer.Option("--json", help="One machine-readable line on stdout instead of text.")
]
QuietFlag = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
DebugFlag = Annotated[bool, typer.Option("--debug", help="Show the traceback of an error.")]
ConfigFile = Annotated[
    Path | None,
    typer.Option(
        "--config",
        metavar="FILE.yaml",
        parser=named_path,
        help="Settings to use instead of the defaults.",
    ),
]
Assignments = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="STAGE.FIELD=VALUE", help="Change one setting; may be repeated."),
]
SurveyArguments = Annotated[
    list[Path],
    typer.Argument(
        metavar="INPUT",
        parser=named_path,
        help="A point cloud, a folder of scans, or a grid map; several files are read as one survey.",
        show_default=False,
    ),
]
StoreyNumber = Annotated[
    int | None,
    typer.Option(
        "--storey", metavar="N", min=0, help="Only this storey; 0 is the lowest.", show_default="all"
    ),
]
TrajectoryFile = Annotated[
    Path | None,
    typer.Option(
        "--trajectory",
        metavar="FILE",
        parser=named_path,
        help="The sensor's path (TUM); default: the file beside INPUT.",
    ),
]
Resolution = Annotated[
    float | None,
    typer.Option("--resolution", metavar="METRES", help="Metres a pixel, where INPUT is a picture of a map."),
]
DrawingUnits = Annotated[
    str,
    typer.Option(
        "--units", metavar="metric|imperial", help="Of drawings and pictures; GeoJSON stays in metres."
    ),
]
DrawingLanguage = Annotated[
    str, typer.Option("--language", metavar="en|de", help="Of the words in drawings and pictures.")
]
DrawingTitle = Annotated[
    str,
    typer.Option(
        "--title",
        metavar="TEXT",
        help="What drawings are called; default: the input's name.",
        show_default=False,
    ),
]
OutFolder = Annotated[
    Path,
    typer.Option(
        "--out", "-o", metavar="DIR", parser=named_path, help="Folder for the results.", show_default=False
    ),
]


def resolve_config(file: Path | None, assignments: list[str] | None, stages: Path | None = None) -> Config:
    """The settings of ``--config``, else of the run in ``stages``, else defaults; then every ``--set``."""
    from floorplan_core.config import Config

    if file is not None:
        config = Config.load(file)
    elif stages is not None:
        from floorplan_core.restart import saved_config

        config = saved_config(stages)
    else:
        config = Config()
    return config.with_values(dict(_split(text) for text in assignments or ()))


def _split(text: str) -> tuple[str, str]:
    from floorplan_core.errors import UsageError

    name, equals, value = text.partition("=")
    if not equals:
        raise UsageError(f"--set needs STAGE.FIELD=VALUE, like doors.max_width=1.2 (given {text!r}).")
    return name.strip(), value.strip()
