"""Plugins: the public interface of readers, exporters and region classifiers, and how they are found.

A plugin is a module (or object) with any of the hooks of :class:`Hooks`, marked by ``@hookimpl``. It is found
in the shipped ``plugins`` folder, by the entry-point group ``floorcast.plugins``, and in the user's folder.
What ships uses nothing that others could not use: import from :mod:`floorplan_core.api` only.
A plugin that fails is named, switched off and reported; it never takes the program down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import pluggy

if TYPE_CHECKING:
    from floorplan_core.config import Config, InputConfig
    from floorplan_core.model import FloorPlan, Reconstruction, Region
    from floorplan_core.observer import Observer

PROJECT = "floorcast"
hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@dataclass(frozen=True)
class ReadOptions:
    """What the user said about the input; None means: guess."""

    input: InputConfig
    trajectory: Path | None = None


@runtime_checkable
class Reader(Protocol):
    """Opens one kind of survey."""

    name: str  # "PLY"
    suffixes: tuple[str, ...]  # (".ply",); folders: ()
    description: str

    def sniff(self, path: Path, head: bytes) -> float:
        """0 to 1: how sure we are that ``path`` (its first 4 KiB in ``head``, b"" for a folder) is ours."""

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open it; raises :class:`InputError` with one clear sentence."""


@runtime_checkable
class Exporter(Protocol):
    """Writes a plan to one kind of file."""

    name: str  # "SVG"
    suffixes: tuple[str, ...]  # (".svg",)
    description: str

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write ``plan``; the caller makes it appear whole or not at all."""


@runtime_checkable
class RegionClassifier(Protocol):
    """Labels regions."""

    name: str  # "paper"
    description: str

    def classify(self, region: Region, plan: Sequence[Region], config: Config) -> str:
        """The label of ``region`` among all regions of the plan: "room", "corridor", or another word."""


class Hooks:
    """The hooks that a plugin may implement; each returns a list."""

    @hookspec
    def floorcast_readers(self) -> list[Reader]:  # type: ignore[empty-body]
        """Readers that the plugin brings."""

    @hookspec
    def floorcast_exporters(self) -> list[Exporter]:  # type: ignore[empty-body]
        """Exporters that the plugin brings."""

    @hookspec
    def floorcast_classifiers(self) -> list[RegionClassifier]:  # type: ignore[empty-body]
        """Region classifiers that the plugin brings."""


@dataclass
class PluginStatus:
    """One plugin, for ``floorcast plugins``."""

    name: str
    origin: str  # "shipped", "installed" or "user folder"
    brings: list[str] = field(default_factory=list)
    error: str = ""  # why it was switched off


class PluginRegistry:
    """Finds plugins once and hands out what they bring. (Discovery is implemented below.)"""

    def __init__(self) -> None:
        self.statuses: list[PluginStatus] = []
        self.readers: list[Reader] = []
        self.exporters: list[Exporter] = []
        self.classifiers: list[RegionClassifier] = []

    def discover(self, user_folder: Path | None = None) -> Any:
        """Load every plugin; failures end up in ``statuses``."""
        raise NotImplementedError
