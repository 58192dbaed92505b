"""The settings form as data, read off the configuration that also validates and documents. No Qt."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from types import NoneType
from typing import Any, Literal, get_args, get_origin

from floorplan_core.config import Config

SLIDER_STEPS = 1000
LOG_RATIO = 1000.0  # a range whose ends differ by more than this factor is spread logarithmically
SOFT_FACTOR = 4.0  # a slider reaches this many times the default where the bound lies far beyond
STEPS = {"m": 0.01, "m2": 0.05, "deg": 0.05, "s": 1.0, "rays": 1.0}  # of a spin box, by unit
PLAIN_STEP = 0.01  # of a number without unit that is mostly a share
UNITS = {"m2": "m²", "deg": "°"}


@dataclass(frozen=True)
class SettingField:
    """One setting as the form shows it."""

    name: str  # "doors.max_width"
    title: str  # "Max width"
    help: str
    unit: str  # as shown: "m²"
    kind: str  # "float", "int", "choice" or "text"
    default: Any
    low: float = 0.0
    high: float = 0.0  # hard bound: what may be typed
    soft: float = 0.0  # where the slider ends
    step: float = PLAIN_STEP
    choices: tuple[str, ...] = ()
    optional: bool = False  # None: the machine decides

    @property
    def stage(self) -> str:
        """The section it belongs to."""
        return self.name.partition(".")[0]

    @property
    def decimals(self) -> int:
        """Figures behind the point that a step needs."""
        return 0 if self.kind == "int" else max(0, -math.floor(math.log10(self.step) + 1e-9))

    @property
    def logarithmic(self) -> bool:
        """True where the slider is spread over powers of ten."""
        return self.low >= 1 and self.soft / self.low > LOG_RATIO

    def position(self, value: float) -> int:
        """Where on the slider ``value`` lies, 0 to :data:`SLIDER_STEPS`."""
        share = self._share(min(max(value, self.low), self.soft))
        return round(SLIDER_STEPS * share)

    def value(self, position: int) -> float:
        """The value at a slider's position, on a round step."""
        share = position / SLIDER_STEPS
        if self.logarithmic:
            raw = self.low * (self.soft / self.low) ** share
            digits = max(0, 1 - math.floor(math.log10(raw)))  # two figures that count
            return self._clamped(round(raw, digits))
        return self._clamped(round((self.low + share * (self.soft - self.low)) / self.step) * self.step)

    def _share(self, value: float) -> float:
        if self.logarithmic:
            return math.log(value / self.low) / math.log(self.soft / self.low)
        return (value - self.low) / (self.soft - self.low) if self.soft > self.low else 0.0

    def _clamped(self, value: float) -> float:
        clamped = round(min(max(value, self.low), self.high), 6)
        return int(clamped) if self.kind == "int" else clamped


@dataclass(frozen=True)
class SettingStage:
    """The settings of one stage."""

    name: str  # "doors"
    title: str
    help: str
    fields: tuple[SettingField, ...]


@lru_cache(maxsize=1)
def setting_stages() -> tuple[SettingStage, ...]:
    """The whole form, in the order of the stages."""
    return tuple(_stage(name, getattr(Config(), name)) for name in Config.model_fields)


def setting_field(name: str) -> SettingField:
    """One field by name; KeyError where there is none."""
    return {f.name: f for stage in setting_stages() for f in stage.fields}[name]


def value_of(config: Config, name: str) -> Any:
    """The present value of "stage.field"."""
    stage, _, field = name.partition(".")
    return getattr(getattr(config, stage), field)


def changed_fields(config: Config) -> tuple[SettingField, ...]:
    """Those that differ from how they come."""
    return tuple(f for s in setting_stages() for f in s.fields if value_of(config, f.name) != f.default)


def readable(name: str) -> str:
    """A field's name as words.

    >>> readable("yaw_step_deg"), readable("max_width")
    ('Yaw step', 'Max width')
    """
    return name.removesuffix("_deg").replace("_", " ").capitalize()


def _stage(name: str, section: Any) -> SettingStage:
    kind = type(section)
    fields = tuple(
        _field(f"{name}.{field}", info, getattr(section, field)) for field, info in kind.model_fields.items()
    )
    words = (kind.__doc__ or "").strip().splitlines()
    return SettingStage(name, readable(name), words[0] if words else "", fields)


def _field(name: str, info: Any, default: Any) -> SettingField:
    unit = str((info.json_schema_extra or {}).get("unit", ""))
    arguments = get_args(info.annotation)
    optional = NoneType in arguments
    plain = (
        next((a for a in arguments if a is not NoneType), info.annotation) if optional else info.annotation
    )
    common = {
        "name": name,
        "title": readable(name.partition(".")[2]),
        "help": info.description or "",
        "unit": UNITS.get(unit, unit),
        "default": default,
        "optional": optional,
    }
    if get_origin(plain) is Literal:
        return SettingField(kind="choice", choices=tuple(map(str, get_args(plain))), **common)
    if plain not in (int, float):
        return SettingField(kind="text", **common)
    kind = "int" if plain is int else "float"
    step = 1.0 if kind == "int" else STEPS.get(unit, PLAIN_STEP)
    low, high = _bounds(info, step)
    soft = high if default is None else min(high, max(SOFT_FACTOR * float(default), low + 10 * step))
    return SettingField(kind=kind, low=low, high=high, soft=soft, step=step, **common)


def _bounds(info: Any, step: float) -> tuple[float, float]:
    """Closed bounds; an open one is moved in by a step."""
    low, high = 0.0, math.inf
    for limit in info.metadata:
        if getattr(limit, "ge", None) is not None:
            low = float(limit.ge)
        if getattr(limit, "gt", None) is not None:
            low = float(limit.gt) + step
        if getattr(limit, "le", None) is not None:
            high = float(limit.le)
        if getattr(limit, "lt", None) is not None:
            high = float(limit.lt) - step
    return low, high
