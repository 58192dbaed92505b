"""What a wheel would hold: every package of the checkout, under names of our own."""

from __future__ import annotations

import tomllib
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUPTOOLS = PROJECT["tool"]["setuptools"]


def packages_of(folder: str, name: str) -> set[str]:
    inits = (ROOT / folder).rglob("__init__.py")
    parts = (p.parent.relative_to(ROOT / folder).parts for p in inits if "__pycache__" not in p.parts)
    return {".".join((name, *part)) for part in parts}


@pytest.mark.parametrize("name", SETUPTOOLS["package-dir"])
def test_every_package_is_declared(name: str) -> None:
    folder = SETUPTOOLS["package-dir"][name]
    declared = {p for p in SETUPTOOLS["packages"] if p == name or p.startswith(f"{name}.")}
    assert declared == packages_of(folder, name)


def test_no_name_is_too_general() -> None:
    tops = {p.split(".")[0] for p in SETUPTOOLS["packages"]}
    assert tops <= {"floorplan_core", "floorcast_app", "floorcast_plugins", "floorcast_resources"}


@pytest.mark.parametrize("name", SETUPTOOLS["packages"])
def test_every_package_can_be_imported(name: str) -> None:
    assert import_module(name).__name__ == name


def test_every_dependency_is_pinned() -> None:
    extras = PROJECT["project"]["optional-dependencies"].values()
    for requirement in [*PROJECT["project"]["dependencies"], *(r for group in extras for r in group)]:
        assert "==" in requirement or requirement.startswith("floorcast["), requirement
