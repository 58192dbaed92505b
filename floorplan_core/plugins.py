"""Plugins: the public interface of readers, exporters and region classifiers, and how they are found.

A plugin is a module (or object) with any of the hooks of :class:`Hooks`, marked by ``@hookimpl``. It is found
in the shipped ``plugins`` folder, by the entry-point group ``floorcast.plugins``, and in the user's folder.
What ships uses nothing that others could not use: import from :mod:`floorplan_core.api` only.
A plugin that fails is named, switched off and reported; it never takes the program down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import pluggy

from floorplan_core.errors import UsageError

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
    colours: bool = True  # False: nobody will look at colours and intensities, a reader may leave them out


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
    about: list[str] = field(default_factory=list)  # of each of ``brings``, what it says of itself
    error: str = ""  # why it was switched off; "" while it works

    @property
    def enabled(self) -> bool:
        """False once it failed."""
        return not self.error


class PluginRegistry:
    """Finds plugins once and hands out what they bring, as long as they work."""

    def __init__(self) -> None:
        self.statuses: list[PluginStatus] = []
        self._brought: list[tuple[PluginStatus, Any]] = []

    def discover(self, user_folder: Path | None = None) -> PluginRegistry:
        """Load every plugin; failures end up in ``statuses``. ``user_folder``: None for the usual one."""
        from floorplan_core.plugin_discovery import load_all

        for status, things in load_all(user_folder):
            self.add(status, things)
        return self

    def add(self, status: PluginStatus, things: Sequence[Reader | Exporter | RegionClassifier]) -> None:
        """Take on what one plugin brings, each thing behind a guard that switches it off if it fails."""
        from floorplan_core.plugin_guard import guarded

        self.statuses.append(status)
        self._brought += [(status, guarded(thing, status)) for thing in things]

    @property
    def readers(self) -> list[Reader]:
        """Readers of the plugins that work: shipped ones first, then by name."""
        return self._enabled(Reader)

    @property
    def exporters(self) -> list[Exporter]:
        """Exporters of the plugins that work."""
        return self._enabled(Exporter)

    @property
    def classifiers(self) -> list[RegionClassifier]:
        """Region classifiers of the plugins that work."""
        return self._enabled(RegionClassifier)

    def exporter(self, path: Path, format: str | None = None) -> Exporter:
        """The exporter named ``format``, else the one for the suffix of ``path``.

        The longest suffix that fits wins, then the first exporter; one of two parts may be the whole name:
        ``planes.png`` has the suffix ``.planes.png``. Raises :class:`UsageError` that lists what there is.
        """
        if format is not None:
            wanted = [(0, e) for e in self.exporters if e.name.lower() == format.lower()]
        else:
            name = f".{path.name.lower()}"
            wanted = [(len(s), e) for e in self.exporters for s in e.suffixes if name.endswith(s)]
        if not wanted:
            raise UsageError(self._no_exporter(path, format))
        return max(wanted, key=lambda found: found[0])[1]

    def classifier(self, name: str) -> RegionClassifier:
        """The classifier called ``name``. Raises :class:`UsageError` that lists what there is."""
        for classifier in self.classifiers:
            if classifier.name == name:
                return classifier
        known = ", ".join(sorted(c.name for c in self.classifiers)) or "none"
        raise UsageError(
            f"There is no region classifier {name!r} (setting labels.classifier); known: {known}."
        )

    def failures(self) -> list[str]:
        """One sentence for each plugin that was switched off."""
        return [
            f"The plugin {s.name!r} ({s.origin}) was switched off: {s.error}."
            for s in self.statuses
            if s.error
        ]

    def _enabled(self, kind: Any) -> list[Any]:
        return [thing for status, thing in self._brought if status.enabled and isinstance(thing, kind)]

    def _no_exporter(self, path: Path, format: str | None) -> str:
        known = ", ".join(f"{e.name} ({' '.join(e.suffixes)})" for e in self.exporters) or "none"
        what = f"called {format!r}" if format is not None else f"for {path.name!r}"
        return f"There is no exporter {what}; known: {known}."


@lru_cache(maxsize=1)
def default_registry() -> PluginRegistry:
    """The registry of this process; plugins are found on the first call, not before."""
    return PluginRegistry().discover()


def classifier_of(config: Config) -> RegionClassifier:
    """The region classifier that the settings name; :class:`UsageError` lists those there are otherwise.

    The paper's needs no search for plugins.
    """
    from floorplan_core.stages.labels import PaperClassifier

    name = config.labels.classifier
    return PaperClassifier() if name == PaperClassifier.name else default_registry().classifier(name)
