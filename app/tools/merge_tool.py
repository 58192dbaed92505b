"""Merge: click one region, then the one that it shall be one with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from floorcast_app.layers.item_shapes import anchor
from floorcast_app.selection import Item
from floorcast_app.tools.gestures import At, Mark, Tool

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench


class MergeTool(Tool):
    """Two clicks on regions."""

    name = "merge"
    cursor = "cross"
    lights = ("region",)
    hint = "Click a region, then the region that it is one with."

    def __init__(self, workbench: Workbench) -> None:
        super().__init__(workbench)
        self._first: Item | None = None
        self._here: At | None = None

    @property
    def busy(self) -> bool:
        return self._first is not None

    def move(self, at: At) -> None:
        self._here = at

    def release(self, at: At, moved: bool) -> None:
        if moved or at.item is None or at.item.kind != "region":
            return
        if self._first is None:
            self._first = at.item
            self.workbench.selection.select(at.item)
            return
        first, self._first = self._first, None
        if first != at.item:
            self.workbench.try_run("correct.merge", regions=(first.id, at.item.id))

    def cancel(self) -> bool:
        was, self._first = self.busy, None
        return was

    def marks(self) -> tuple[Mark, ...]:
        source = self.source
        if self._first is None or self._here is None or source is None:
            return ()
        start = anchor(source, self._first)
        return () if start is None else (Mark("dashes", (start, self._here.xy)), Mark("dot", (start,)))
