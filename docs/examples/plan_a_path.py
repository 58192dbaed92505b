"""A robot's way through what Floorcast predicts: A* from a place to a room, on the two grid maps of a plan.

    floorcast plan survey.ply --out plan
    floorcast export plan --to plan/map.yaml --to plan/map.predicted.yaml
    python plan_a_path.py plan --from 1.5 2.0 --to 7 --out path.geojson

Cells that were seen cost what they are long. Predicted ones cost more, the more the less certain their room
is, so that the robot takes a known way where one is not much longer. Needs numpy, scipy and PyYAML only.
"""

from __future__ import annotations

import argparse
import heapq
import json
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import yaml
from PIL import Image
from scipy import ndimage

FREE, OCCUPIED, UNKNOWN = 0, 100, -1  # as in nav_msgs/OccupancyGrid
RADIUS = (
    0.2  # m, of the robot: the middle of a cell keeps this far from the middles of cells that are not free
)
STEPS = [(dy, dx, (dy * dy + dx * dx) ** 0.5) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if (dy, dx) != (0, 0)]


@dataclass(frozen=True)
class Map:
    """An occupancy grid as Nav2 keeps it."""

    cells: np.ndarray  # (ny, nx) FREE, OCCUPIED or UNKNOWN; row 0 is the lowest y
    resolution: float  # metres
    origin: np.ndarray  # (2,) metres, world: lower left corner of cell [0, 0]

    def cell(self, xy: tuple[float, float]) -> tuple[int, int]:
        """Row and column of a place in the world."""
        x, y = np.floor((np.asarray(xy) - self.origin) / self.resolution).astype(int)
        return int(y), int(x)

    def world(self, cells: np.ndarray) -> np.ndarray:
        """(N, 2) middles of (N, 2) rows and columns, metres."""
        return self.origin + (cells[:, ::-1] + 0.5) * self.resolution


def load_map(path: Path) -> Map:
    """``map.yaml`` and its image, by the rules of Nav2's map server (mode trinary)."""
    head = yaml.safe_load(path.read_text())
    grey = np.asarray(Image.open(path.parent / head["image"]), dtype=float)[
        ::-1
    ]  # the top row is the highest y
    occupied = grey / 255 if head["negate"] else 1 - grey / 255
    cells = np.full(grey.shape, UNKNOWN)
    cells[occupied < head["free_thresh"]] = FREE
    cells[occupied > head["occupied_thresh"]] = OCCUPIED
    return Map(cells, head["resolution"], np.array(head["origin"][:2]))


def costs(seen: Map, predicted: Map, regions: list[dict], radius: float, weight: float) -> np.ndarray:
    """(ny, nx) cost of a metre through each cell; infinite where a robot of this radius does not fit."""
    cost = np.where(predicted.cells == FREE, 1.0, np.inf)
    guessed = (predicted.cells == FREE) & (seen.cells != FREE)
    rows, columns = np.nonzero(guessed)
    doubt = np.ones(len(rows))  # in a doorway, say
    for region in regions:
        inside = _inside(region["geometry"], predicted.world(np.column_stack([rows, columns])))
        doubt[inside] = 1 - region["properties"]["confidence"]
    cost[rows, columns] += weight * doubt
    free = ndimage.distance_transform_edt(predicted.cells == FREE) * predicted.resolution
    cost[free < radius] = np.inf
    return cost


def find_path(
    cost: np.ndarray, start: tuple[int, int], goal: tuple[int, int]
) -> list[tuple[int, int]] | None:
    """Cells of the cheapest way (A*, eight neighbours); None where there is none."""
    best, came = {start: 0.0}, {start: start}
    queue = [(0.0, start)]
    while queue:
        _, cell = heapq.heappop(queue)
        if cell == goal:
            path = [cell]
            while came[path[-1]] != path[-1]:
                path.append(came[path[-1]])
            return path[::-1]
        for dy, dx, length in STEPS:
            other = cell[0] + dy, cell[1] + dx
            if not (0 <= other[0] < cost.shape[0] and 0 <= other[1] < cost.shape[1]):
                continue
            total = best[cell] + length * cost[other]
            if total < best.get(other, np.inf):
                best[other], came[other] = total, cell
                ahead = np.hypot(goal[0] - other[0], goal[1] - other[1])  # no cell costs less than 1
                heapq.heappush(queue, (total + ahead, other))
    return None


def _connected(feature: dict) -> list[str]:
    """The regions that a door joins; none for what is no door."""
    return feature["properties"].get("connects", [])


def _inside(geometry: dict, xy: np.ndarray) -> np.ndarray:
    """(N,) which places lie in a GeoJSON polygon, holes and all (a ray to the right crosses it oddly)."""
    crossings = np.zeros(len(xy), dtype=int)
    for ring in geometry["coordinates"]:
        for (x0, y0), (x1, y1) in pairwise(ring):
            if y0 != y1:
                between = (xy[:, 1] >= min(y0, y1)) & (xy[:, 1] < max(y0, y1))
                crossings += between & (xy[:, 0] < x0 + (xy[:, 1] - y0) * (x1 - x0) / (y1 - y0))
    return crossings % 2 == 1


def nearest_free(cost: np.ndarray, grid: Map, places: np.ndarray, to: tuple[float, float]) -> tuple[int, int]:
    """The cell among ``places`` (N, 2) nearest to a place in the world where the robot fits."""
    fits = places[np.isfinite(cost[tuple(places.T)])]
    if not len(fits):
        raise SystemExit("A robot of this radius fits nowhere there; try a smaller --radius.")
    distance = np.linalg.norm(grid.world(fits) - np.asarray(to), axis=1)
    return tuple(int(v) for v in fits[distance.argmin()])


def plan_path(
    folder: Path, start: tuple[float, float], room: str, radius: float = RADIUS, weight: float = 2.0
) -> dict:
    """A GeoJSON feature: the way from ``start`` (world metres) into the region called ``room``."""
    seen, predicted = load_map(folder / "map.yaml"), load_map(folder / "map.predicted.yaml")
    features = json.loads((folder / "plan.geojson").read_text())["features"]
    regions = [f for f in features if f["properties"]["kind"] == "region"]
    wanted = [f for f in regions if f["properties"]["name"] == room]
    if not wanted:
        names = ", ".join(f["properties"]["name"] for f in regions)
        raise SystemExit(f"There is no region {room!r}; the regions are {names}.")
    cost = costs(seen, predicted, regions, radius, weight)
    free = np.argwhere(predicted.cells == FREE)
    middle = np.mean(wanted[0]["geometry"]["coordinates"][0][:-1], axis=0)
    goal = nearest_free(cost, predicted, free[_inside(wanted[0]["geometry"], predicted.world(free))], middle)
    path = find_path(cost, nearest_free(cost, predicted, free, start), goal)
    if path is None:
        widths = [f["properties"]["width_m"] for f in features if wanted[0]["id"] in _connected(f)]
        raise SystemExit(f"No way leads to region {room} for a robot of {radius} m; its doors (m): {widths}.")
    cells = np.array(path)
    line = predicted.world(cells)
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    known = seen.cells[tuple(cells[1:].T)] == FREE
    return {
        "type": "Feature",
        "geometry": {"type": "LineString", "coordinates": line.round(3).tolist()},
        "properties": {
            "to": room,
            "length_m": round(float(steps.sum()), 2),
            "predicted_m": round(float(steps[~known].sum()), 2),
            "first_predicted": None if known.all() else line[1:][~known][0].round(3).tolist(),
        },
    }


def main() -> None:
    """Read the arguments, write the path."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plan", type=Path, help="folder with plan.geojson, map.yaml and map.predicted.yaml")
    parser.add_argument("--from", dest="start", type=float, nargs=2, required=True, metavar=("X", "Y"))
    parser.add_argument("--to", required=True, metavar="NAME", help="name of the region to go to")
    parser.add_argument("--radius", type=float, default=RADIUS, help="of the robot, m (default: %(default)s)")
    parser.add_argument("--weight", type=float, default=2.0, help="of doubt (default: %(default)s)")
    parser.add_argument("--out", type=Path, default=Path("path.geojson"))
    arguments = parser.parse_args()
    path = plan_path(arguments.plan, arguments.start, arguments.to, arguments.radius, arguments.weight)
    arguments.out.write_text(json.dumps({"type": "FeatureCollection", "features": [path]}) + "\n")
    about = path["properties"]
    print(
        f"{about['length_m']} m, {about['predicted_m']} m of it through what was predicted: {arguments.out}"
    )


if __name__ == "__main__":
    main()
