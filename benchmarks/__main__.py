"""``python -m benchmarks [stages] [growth] [office] [optimum] [maps]``: all of them where none is named.

stages   the whole job on the hospital survey, stage by stage, beside what Open3D needs to read the same file
growth   candidates and cover on buildings from 200 to 20,000 m2, and the exponent of their growth
office   from planes to labels for 80 x 40 m and 100 planes a facing
optimum  weight of the greedy cover against the true optimum on 100 buildings
maps     rooms of eight occupancy grid maps against their hand-made segmentation, plain and furnished

Times are the best of a few runs after one that warms up: wall time for ``stages``, CPU time of the one thread
for the others. Tables go to the terminal, figures to
``benchmarks/results/NAME.json``; where there are figures of an earlier run they stand beside the new ones.
"""

from __future__ import annotations

import sys

from benchmarks import cover, maps, pipeline
from benchmarks.record import report

BENCHMARKS = {
    "stages": pipeline.stages,
    "growth": cover.growth,
    "office": cover.office,
    "optimum": cover.optimum,
    "maps": maps.rooms,
}


def main(names: list[str]) -> int:
    """Run the named benchmarks; 2 if a name is unknown."""
    unknown = [name for name in names if name not in BENCHMARKS]
    if unknown:
        print(f"There is no benchmark {unknown[0]!r}; there are {', '.join(BENCHMARKS)}.", file=sys.stderr)
        return 2
    for name in names or BENCHMARKS:
        report(name, BENCHMARKS[name]())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
