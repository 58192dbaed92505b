"""The surveys of the accuracy benchmark: simulated ones in two halves, and those beside the checkout.

Style, sensor, exploration, furniture and noise vary together so that in each half every value of one factor
meets every value of the others about equally often (18 surveys a half). Settings are tuned on the first half.
More of the kind, which nobody has looked at, are made from any other first seed (``--fresh``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset

STYLES = ("straight", "l", "t", "ring", "grid", "flat")
SENSORS = ("lidar", "camera", "station")
EXPLORE = (1.0, 0.6, 0.3)
FURNITURE = ("none", "normal", "heavy")
NOISE = (0.01, 0.02, 0.03)  # m
DRIFT = (0.0, 0.01, 0.02)  # m
ROOMS = {"straight": 14, "l": 14, "t": 16, "ring": 18, "grid": 24, "flat": 7}
HALVES = ("tuning", "held out")
FIRST_SEED = {"tuning": 1000, "held out": 2000}
FRESH = "fresh"  # surveys of other seeds, to see whether a change helps beyond both halves
REPEATS = 3  # surveys of one style in a half
MAX_POINTS = 700_000
SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"
REAL = ("sim_aws_hospital", "sim_aws_small_house", "sim_ifc_duplex_L1", "octomap_fr079_3d")
QUICK = ("straight", "ring", "flat")  # one survey of each in both halves


@dataclass(frozen=True)
class Case:
    """One survey of the benchmark."""

    name: str
    half: str  # "tuning", "held out", "fresh" or "shared"
    spec: SurveySpec | None = None  # simulated ones
    folder: Path | None = None  # given ones
    factors: tuple[tuple[str, str], ...] = ()  # name, value; for the table


def simulated_cases() -> list[Case]:
    """36 surveys, 18 in each half."""
    return [case for half in HALVES for case in _cases(half, HALVES.index(half), FIRST_SEED[half])]


def fresh_cases(first_seeds: Sequence[int]) -> list[Case]:
    """18 surveys of each first seed, laid out as those of the half held out."""
    return [case for first in first_seeds for case in _cases(FRESH, 1, first)]


def _cases(half: str, turn: int, first_seed: int) -> list[Case]:
    """The surveys of one half, whose plan of the factors is rotated by ``turn``."""
    return [
        _case(half, turn, first_seed, style, repeat)
        for style in range(len(STYLES))
        for repeat in range(REPEATS)
    ]


def _case(half: str, turn: int, first_seed: int, style: int, repeat: int) -> Case:
    """Levels of the factors by a fixed balanced plan; the halves differ in seeds and in its rotation."""
    sensor = SENSORS[(style + repeat + turn) % 3]
    explore = EXPLORE[(2 * style + repeat + style // 3 + 2 * turn) % 3]
    furniture = FURNITURE[(repeat + style // 2 + turn) % 3]
    noise, drift = NOISE[(style + 2 * repeat) % 3], DRIFT[(style // 2 + 2 * repeat + turn) % 3]
    seed = first_seed + 10 * style + repeat
    name = f"{STYLES[style]}-{sensor}-{round(100 * explore)}-{furniture}-{seed}"
    spec = SurveySpec(
        building=BuildingSpec(style=STYLES[style], rooms=ROOMS[STYLES[style]], furniture=furniture),
        sensor=sensor_preset(sensor, noise=noise if sensor != "station" else noise / 3),
        seed=seed,
        explore=explore,
        drift=drift if sensor != "station" else 0.0,
        max_points=MAX_POINTS,
    )
    factors = {"style": STYLES[style], "sensor": sensor, "explored": f"{100 * explore:.0f} %"}
    factors |= {
        "furniture": furniture,
        "noise": f"{100 * spec.sensor.noise:.1f} cm",
        "drift": f"{100 * spec.drift:.0f} cm",
    }
    return Case(name, half, spec=spec, factors=tuple(factors.items()))


def shared_cases() -> list[Case]:
    """The surveys beside the checkout that have a truth; none where they are absent."""
    return [Case(name, "shared", folder=SHARED / name) for name in REAL if (SHARED / name).is_dir()]


def chosen_cases(quick: bool, only: str | None, fresh: Sequence[int] = ()) -> list[Case]:
    """All cases, the quick subset, or those whose name holds ``only``; of ``fresh`` seeds where given."""
    cases = fresh_cases(fresh) if fresh else simulated_cases() + shared_cases()
    if only is not None:
        return [c for c in cases if only in c.name]
    if quick:
        return [c for c in cases if (c.half == "shared" and "duplex" in c.name) or _is_quick(c)]
    return cases


def _is_quick(case: Case) -> bool:
    return case.spec is not None and case.spec.building.style in QUICK and case.spec.seed % 10 == 0
