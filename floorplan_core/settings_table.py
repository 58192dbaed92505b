"""The settings as rows, as a YAML file and as the page ``docs/settings.md``, all from the one declaration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args, get_origin

import yaml

from floorplan_core.config import Config
from floorplan_core.errors import FloorPlanError

COMMAND = "floorcast settings --markdown > docs/settings.md"


@dataclass(frozen=True)
class SettingRow:
    """One setting, ready to be shown."""

    name: str  # "doors.max_width"
    value: str
    unit: str
    bounds: str  # "> 0.2, <= 4", or the words allowed
    meaning: str


def setting_rows(config: Config) -> list[SettingRow]:
    """Every setting of ``config`` in the order of the stages."""
    return [
        SettingRow(
            f"{stage}.{name}",
            _text(getattr(section, name)),
            _unit(info),
            _bounds(info),
            info.description or "",
        )
        for stage, section in ((s, getattr(config, s)) for s in type(config).model_fields)
        for name, info in type(section).model_fields.items()
    ]


def yaml_text(config: Config) -> str:
    """A YAML file that ``--config`` reads back to the same settings; each with its meaning as a comment."""
    lines: list[str] = []
    for row in setting_rows(config):
        stage, _, name = row.name.partition(".")
        if f"{stage}:" not in lines:
            lines.append(f"{stage}:")
        value = yaml.safe_dump(getattr(getattr(config, stage), name)).removesuffix("...\n").strip()
        lines.append(f"  {name}: {value}  # {' '.join(filter(None, (row.meaning, _in_brackets(row))))}")
    return "\n".join(lines) + "\n"


def markdown_page(config: Config) -> str:
    """The page of the documentation."""
    head = [
        "# Settings",
        "",
        f"Written by `{COMMAND}`; do not edit.",
        "Change a setting with `--set stage.field=value`, or put several into a YAML file",
        "(`floorcast settings --yaml` prints one to start from) and give it with `--config`.",
    ]
    stages: dict[str, list[SettingRow]] = {}
    for row in setting_rows(config):
        stages.setdefault(row.name.partition(".")[0], []).append(row)
    return (
        "\n".join(head + [line for stage in stages for line in _section(config, stage, stages[stage])]) + "\n"
    )


def _section(config: Config, stage: str, rows: list[SettingRow]) -> list[str]:
    title = (type(getattr(config, stage)).__doc__ or "").strip().splitlines()[0]
    table = ["| setting | default | unit | bounds | meaning |", "| --- | --- | --- | --- | --- |"]
    table += [
        "| "
        + " | ".join(c.replace("|", "\\|") for c in (f"`{r.name}`", r.value, r.unit, r.bounds, r.meaning))
        + " |"
        for r in rows
    ]
    return ["", f"## {stage}", "", title, "", *table]


def _in_brackets(row: SettingRow) -> str:
    inside = "; ".join(filter(None, (row.unit, row.bounds)))
    return f"({inside})" if inside else ""


def _text(value: Any) -> str:
    return "none" if value is None else str(value)


def _unit(info: Any) -> str:
    extra = info.json_schema_extra
    if not isinstance(extra, dict) or "unit" not in extra:
        raise FloorPlanError(f"The setting described as {info.description!r} was declared without a unit.")
    return str(extra["unit"])


_SIGNS = {"ge": "≥", "gt": ">", "le": "≤", "lt": "<"}


def _bounds(info: Any) -> str:
    if get_origin(info.annotation) is Literal:
        return ", ".join(map(str, get_args(info.annotation)))
    if info.annotation is bool:
        return "True, False"
    parts = [
        f"{sign} {getattr(limit, key):g}"
        for limit in info.metadata
        for key, sign in _SIGNS.items()
        if getattr(limit, key, None) is not None
    ]
    return ", ".join(parts)
