"""Surveys opened with every reader there is, as the command line does it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from floorplan_core.config import InputConfig
    from floorplan_core.model import Reconstruction
    from floorplan_core.observer import Observer


def open_survey(
    path: Path | str | Sequence[Path | str],
    trajectory: Path | str | None = None,
    config: InputConfig | None = None,
    observer: Observer | None = None,
    colours: bool = True,
) -> Reconstruction:
    """Open a file, a folder, or several as one survey, with the readers of all plugins that work.

    :param trajectory: the poses, where they do not lie beside the cloud.
    :param colours: False leaves out colours and intensities, which no plan needs, where that saves time.

    Raises :class:`InputError` with one sentence for what cannot be read or is not what it claims.
    """
    from floorplan_core.plugins import default_registry
    from floorplan_core.readers import opening

    return opening.open_survey(path, trajectory, config, observer, default_registry(), colours)
