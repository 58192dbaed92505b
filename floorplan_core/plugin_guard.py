"""Guards around what plugins bring: a failure names the plugin and switches it off; the program goes on.

Errors that a plugin raises on purpose (:class:`FloorPlanError`) and those of the system (:class:`OSError`,
:class:`MemoryError`) are no failures of the plugin and pass through.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from floorplan_core.drawing_style import DrawingStyle, Styled, in_style
from floorplan_core.errors import FloorPlanError, InputError, OutputError, let_interrupt_through
from floorplan_core.plugins import Exporter, PluginStatus, Reader, ReadOptions, RegionClassifier

if TYPE_CHECKING:
    from floorplan_core.config import Config
    from floorplan_core.model import FloorPlan, PointChunk, Reconstruction, Region
    from floorplan_core.observer import Observer


class PluginFailed(OutputError):
    """An exporter or classifier of a plugin raised something that is no error on purpose."""


def guarded(thing: Reader | Exporter | RegionClassifier, status: PluginStatus) -> Any:
    """``thing`` behind the guard for its kind."""
    if isinstance(thing, Reader):
        return GuardedReader(thing, status)
    if isinstance(thing, Exporter):
        return GuardedExporter(thing, status)
    return GuardedClassifier(thing, status)


@contextmanager
def _failures(status: PluginStatus, doing: str, kind: type[FloorPlanError]) -> Iterator[None]:
    """Turn an exception of the plugin into ``kind``, naming it, and switch the plugin off."""
    from floorplan_core.plugin_discovery import reason

    try:
        yield
    except (FloorPlanError, OSError, MemoryError):
        raise
    except Exception as error:
        let_interrupt_through(error)
        status.error = f"{reason(error)} (while {doing})"
        raise kind(
            f"The plugin {status.name!r} failed while {doing} ({reason(error)}) and was switched off."
        ) from error


class GuardedReader:
    """A reader whose exceptions become :class:`InputError`."""

    def __init__(self, inner: Reader, status: PluginStatus) -> None:
        self._inner, self._status = inner, status
        self.name, self.suffixes, self.description = inner.name, tuple(inner.suffixes), inner.description

    def sniff(self, path: Path, head: bytes) -> float:
        """The reader's answer; 0 if it fails, so that another reader gets the file."""
        try:
            with _failures(self._status, f"looking at {path.name}", InputError):
                return float(self._inner.sniff(path, head))
        except FloorPlanError:
            return 0.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the survey; its chunks are guarded as well."""
        doing = f"reading {path.name}"
        with _failures(self._status, doing, InputError):
            opened = self._inner.open(path, options, observer)
        return replace(opened, chunks=self._guarded_chunks(opened.chunks, doing))

    def _guarded_chunks(
        self, chunks: Callable[[], Iterator[PointChunk]], doing: str
    ) -> Callable[[], Iterator[PointChunk]]:
        def passes() -> Iterator[PointChunk]:
            with _failures(self._status, doing, InputError):
                yield from chunks()

        return passes


class GuardedExporter:
    """An exporter whose exceptions become :class:`PluginFailed`."""

    def __init__(self, inner: Exporter, status: PluginStatus) -> None:
        self._inner, self._status = inner, status
        self.name, self.suffixes, self.description = inner.name, tuple(inner.suffixes), inner.description

    @property
    def has_style(self) -> bool:
        """True where units and language make a difference to what is written."""
        return isinstance(self._inner, Styled)

    def styled(self, style: DrawingStyle) -> GuardedExporter:
        """The same exporter in a style; one that has none as it is."""
        with _failures(self._status, "choosing units and language", PluginFailed):
            return GuardedExporter(in_style(self._inner, style), self._status)

    def write(self, plan: FloorPlan, path: Path) -> None:
        """Write the plan; a file that was promised and not written is a failure too."""
        with _failures(self._status, f"writing {path.name}", PluginFailed):
            self._inner.write(plan, path)
            if not path.exists():
                raise RuntimeError("it wrote no file")


class GuardedClassifier:
    """A classifier; once it has failed, the paper's takes its place, so that there is still a plan."""

    def __init__(self, inner: RegionClassifier, status: PluginStatus) -> None:
        self._inner, self._status = inner, status
        self.name, self.description = inner.name, inner.description

    def classify(self, region: Region, plan: Sequence[Region], config: Config) -> str:
        """The classifier's word, or the paper's."""
        if self._status.enabled:
            with suppress(PluginFailed):
                return self._ask(region, plan, config)
        from floorplan_core.stages.labels import PaperClassifier

        return PaperClassifier().classify(region, plan, config)

    def _ask(self, region: Region, plan: Sequence[Region], config: Config) -> str:
        label = ""
        with _failures(self._status, f"labelling region {region.name}", PluginFailed):
            label = self._inner.classify(region, plan, config)
            if not isinstance(label, str) or not label:
                raise TypeError(f"it gave {label!r} where a word is wanted")
        return label
