"""Presets: several settings that belong together, with the reason why. Files in resources/presets. No Qt."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import yaml

from floorplan_core.config import Config


@dataclass(frozen=True)
class Preset:
    """One preset."""

    id: str  # the file's name
    name: str  # English, sentence case
    reason: str  # when to take it, and why
    settings: tuple[tuple[str, Any], ...]  # "stage.field" and its value

    def holds(self, config: Config) -> bool:
        """True where the configuration has all its values."""
        return all(getattr(getattr(config, n.split(".")[0]), n.split(".")[1]) == v for n, v in self.settings)


@lru_cache(maxsize=1)
def presets() -> tuple[Preset, ...]:
    """All presets that come with the application, by the order in their files."""
    from importlib.resources import files

    folder = files("floorcast_resources").joinpath("presets")
    found = [
        (f.name, yaml.safe_load(f.read_text(encoding="utf-8")))
        for f in folder.iterdir()
        if f.name.endswith(".yaml")
    ]
    found.sort(key=lambda entry: (entry[1].get("order", 99), entry[0]))
    return tuple(
        Preset(name.removesuffix(".yaml"), data["name"], data["reason"], _flat(data["settings"]))
        for name, data in found
    )


def _flat(settings: dict[str, dict[str, Any]]) -> tuple[tuple[str, Any], ...]:
    """Stage tables as "stage.field" pairs."""
    return tuple(
        (f"{stage}.{field}", value) for stage, fields in settings.items() for field, value in fields.items()
    )
