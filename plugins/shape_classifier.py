"""A second region classifier: places that one passes through are corridors, whatever their outline.

The paper's rule looks at the outline alone, so a short straight corridor is a room to it and an L-shaped room
a corridor. This one asks what a corridor is for: many doors, ways between other places that lead through it
(betweenness in the graph of regions and doors), long for its width, not wide. The weights are a logistic
regression on 60 simulated buildings (no seed of either half of the accuracy benchmark; doors, rooms and
stretches of corridor left out at random) and the benchmark's tuning half; `docs/accuracy.md` compares both.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from floorplan_core.api import Config, Region, RegionClassifier, hookimpl

ROOM, CORRIDOR = "room", "corridor"

BIAS = -5.2
ELONGATION = 2.3  # a natural logarithm of length over width
WIDE = -2.5  # a natural logarithm of the width over USUAL
USUAL = 2.5  # m, corridors are rarely wider
BETWEENNESS = 1.1  # share of the ways between two other regions that lead through
DOORS = 1.7  # a natural logarithm of one more than the doors
DEAD_END = -0.9  # one door only: nothing lies behind
HUB_DOORS, HUB_WAYS = 5, 0.5  # so many doors and so large a betweenness make a lobby, however wide it is
SAMPLES = 12  # of the width profile
HALVINGS = 8  # of the interval that holds the largest width


class ShapeClassifier:
    """Rooms and corridors by connectivity, width profile and elongation."""

    name = "shape"
    description = "corridor: long for its width, narrow, many doors, ways lead through it; else room"

    def classify(self, region: Region, plan: Sequence[Region], config: Config) -> str:
        """The label of ``region`` among the regions of ``plan``, which share the ids of the doors."""
        ways = betweenness(tuple((r.id, r.doors) for r in plan)).get(region.id, 0.0)
        hub = len(region.doors) >= HUB_DOORS and ways >= HUB_WAYS
        return CORRIDOR if hub or circulation(region.polygon, len(region.doors), ways) > 0 else ROOM


def circulation(polygon: Any, doors: int, ways: float) -> float:
    """Log odds that a region serves to pass through.

    :param polygon: shapely Polygon, metres.
    :param doors: how many doors open into it.
    :param ways: its betweenness, 0 to 1.
    """
    width = typical_width(polygon)
    return (
        BIAS
        + ELONGATION * math.log(polygon.area / width**2)
        + WIDE * max(0.0, math.log(width / USUAL))
        + BETWEENNESS * ways
        + DOORS * math.log(1 + doors)
        + (DEAD_END if doors == 1 else 0.0)
    )


def typical_width(polygon: Any) -> float:
    """Metres: the mean, over the area, of the widest square that fits around a place (its granulometry)."""
    low, high = 0.0, math.sqrt(polygon.area) * (1 + 1e-6)  # no wider square can fit
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _opened(polygon, middle) > 0 else (low, middle)
    shares = [_opened(polygon, (k + 0.5) / SAMPLES * high) for k in range(SAMPLES)]
    return max(high * sum(shares) / SAMPLES, high / SAMPLES)


def _opened(polygon: Any, width: float) -> float:
    """Share of the area that a square of ``width`` metres reaches without leaving the polygon."""
    shrunk = polygon.buffer(-width / 2, join_style="mitre")
    return float(shrunk.buffer(width / 2, join_style="mitre").area / polygon.area)


@lru_cache(maxsize=1)
def betweenness(doors_of: tuple[tuple[str, tuple[str, ...]], ...]) -> dict[str, float]:
    """For each region the share of pairs of others whose shortest way leads through it, 0 to 1.

    :param doors_of: id of each region with the ids of its doors. Pairs without any way do not count.
    """
    import networkx

    graph = networkx.Graph()
    graph.add_nodes_from(region for region, _ in doors_of)
    first: dict[str, str] = {}
    for region, doors in doors_of:
        graph.add_edges_from((first[door], region) for door in doors if door in first)
        first |= {door: region for door in doors if door not in first}
    ways = networkx.betweenness_centrality(graph, normalized=False)
    sizes = {node: len(part) for part in networkx.connected_components(graph) for node in part}
    return {node: way / max(1.0, _pairs(sizes[node] - 1)) for node, way in ways.items()}


def _pairs(count: int) -> float:
    return count * (count - 1) / 2


@hookimpl
def floorcast_classifiers() -> list[RegionClassifier]:
    return [ShapeClassifier()]
