"""Plugins of all three origins; those that fail are named, switched off, and never take the program down."""

from __future__ import annotations

import importlib.metadata
import textwrap
from pathlib import Path

import numpy as np
import pytest

from floorplan_core import plugin_discovery
from floorplan_core.config import Config
from floorplan_core.errors import InputError, OutputError, UsageError
from floorplan_core.model import PointChunk, Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import PluginRegistry, PluginStatus, ReadOptions, default_registry
from tests import factories

HEAD = "from floorplan_core.api import hookimpl\n"
WORKING = """
class Csv:
    name, suffixes, description = "csv", (".csv",), "Areas as a table."

    def write(self, plan, path):
        path.write_text("\\n".join(f"{r.name},{r.area:.2f}" for r in plan.regions))


@hookimpl
def floorcast_exporters():
    return [Csv()]
"""


def put(folder: Path, name: str, code: str) -> None:
    (folder / f"{name}.py").write_text(HEAD + textwrap.dedent(code))


def status(registry: PluginRegistry, name: str) -> PluginStatus:
    return next(s for s in registry.statuses if s.name == name)


def test_what_ships_is_found_and_works() -> None:
    registry = default_registry()
    shipped = {s.name: s for s in registry.statuses if s.origin == "shipped"}
    assert set(shipped) >= {"geojson", "svg", "figures", "paper_classifier", "point_clouds"}
    assert [s for s in shipped.values() if s.error] == []
    assert {e.name for e in registry.exporters} >= {"GeoJSON", "SVG"}
    assert registry.classifier("paper").description
    assert {suffix for reader in registry.readers for suffix in reader.suffixes} >= {".ply", ".pcd", ".npz"}


def test_a_plugin_of_the_user_writes_a_plan(plugin_folder: Path, tmp_path: Path) -> None:
    put(plugin_folder, "table", WORKING)
    registry = default_registry()
    assert status(registry, "table") == PluginStatus(
        "table", "user folder", ["exporter csv"], ["Areas as a table."]
    )
    registry.exporter(Path("rooms.csv")).write(factories.small_flat(), tmp_path / "rooms.csv")
    assert (tmp_path / "rooms.csv").read_text().startswith("Living & dining,14.28")


def test_a_package_in_the_folder_may_have_modules_of_its_own(plugin_folder: Path) -> None:
    (plugin_folder / "table").mkdir()
    (plugin_folder / "table" / "__init__.py").write_text("from .inner import *\n")
    (plugin_folder / "table" / "inner.py").write_text(HEAD + WORKING)
    (plugin_folder / "_private.py").write_text("raise RuntimeError('never imported')")
    (plugin_folder / "notes.txt").write_text("no plugin")
    registry = default_registry()
    assert [(s.name, s.error) for s in registry.statuses if s.origin == "user folder"] == [("table", "")]


class FakeEntryPoint:
    name, value = "elsewhere", "elsewhere:plugin"

    def __init__(self, loaded: object) -> None:
        self.loaded = loaded

    def load(self) -> object:
        if isinstance(self.loaded, BaseException):
            raise self.loaded
        return self.loaded


def test_a_plugin_of_an_installed_package(monkeypatch: pytest.MonkeyPatch) -> None:
    from floorcast_plugins import svg

    def points(group: str) -> list[FakeEntryPoint]:
        assert group == "floorcast.plugins"
        return [FakeEntryPoint(svg), FakeEntryPoint(ModuleNotFoundError("No module named 'heavy'"))]

    monkeypatch.setattr(importlib.metadata, "entry_points", points)
    good, bad = [s for s in PluginRegistry().discover().statuses if s.origin == "installed"]
    assert good.enabled and "exporter SVG" in good.brings
    assert bad.error == "ModuleNotFoundError: No module named 'heavy'"


BROKEN = {
    "raises": "1 / 0",
    "exits": "import sys; sys.exit('I leave')",
    "syntax": "def",
    "no_hooks": "x = 1",
    "misspelt": "@hookimpl\ndef floorcast_exporter():\n    return []",
    "hook_raises": "@hookimpl\ndef floorcast_readers():\n    raise KeyError('gone')",
    "brings_none": "@hookimpl\ndef floorcast_readers():\n    return [None]",
    "brings_class": WORKING.replace("[Csv()]", "[Csv]"),
    "half_exporter": WORKING.replace("def write", "def writes"),
    "no_list": "@hookimpl\ndef floorcast_readers():\n    return 7",
}
REASONS = {
    "raises": "ZeroDivisionError: division by zero",
    "exits": "SystemExit: I leave",
    "syntax": "SyntaxError",
    "no_hooks": "it has none of the hooks",
    "misspelt": "unknown hook",
    "hook_raises": "KeyError: 'gone'",
    "brings_none": "None is not a reader",
    "brings_class": "is not an exporter",
    "half_exporter": "is not an exporter",
    "no_list": "TypeError",
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_plugin_that_cannot_be_loaded_is_named_and_the_others_load(plugin_folder: Path, name: str) -> None:
    put(plugin_folder, name, BROKEN[name])
    put(plugin_folder, "table", WORKING)
    registry = default_registry()
    assert REASONS[name] in status(registry, name).error
    assert not status(registry, name).enabled and status(registry, "table").enabled
    assert registry.exporter(Path("x.csv")).name == "csv"
    (sentence,) = registry.failures()
    assert sentence.startswith(f"The plugin '{name}' (user folder) was switched off: ")


def test_ctrl_c_while_a_plugin_loads_is_not_the_plugins_failure(
    plugin_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(plugin_folder, "slow", "raise KeyboardInterrupt")
    with pytest.raises(KeyboardInterrupt):
        default_registry()


class Failing:
    """Reader, exporter and classifier whose every method raises what it was given."""

    name, suffixes, description = "bad", (".bad",), "Fails."

    def __init__(self, error: Exception) -> None:
        self.error = error


class FailingReader(Failing):
    def sniff(self, path: Path, head: bytes) -> float:
        if head == b"sniff":
            raise self.error
        return 1.0

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        if path.name == "open":
            raise self.error
        return Reconstruction("x", self.chunks)

    def chunks(self):
        yield PointChunk(np.zeros((1, 3)))
        raise self.error


class FailingExporter(Failing):
    def write(self, plan: object, path: Path) -> None:
        if self.error.args != ("silent",):
            raise self.error


class FailingClassifier(Failing):
    def classify(self, region: object, plan: object, config: object) -> str:
        if self.error.args == ("silent",):
            return ""
        raise self.error


def registered(thing: Failing) -> tuple[PluginRegistry, PluginStatus]:
    registry, state = PluginRegistry(), PluginStatus("theirs", "installed")
    registry.add(state, [thing])  # type: ignore[list-item]
    return registry, state


OPTIONS = ReadOptions(Config().input)


def test_a_reader_that_fails_while_looking_leaves_the_file_to_others() -> None:
    registry, state = registered(FailingReader(ValueError("oops")))
    (reader,) = registry.readers
    assert reader.sniff(Path("x.bad"), b"fine") == 1.0 and state.enabled
    assert reader.sniff(Path("x.bad"), b"sniff") == 0.0
    assert state.error == "ValueError: oops (while looking at x.bad)"
    assert registry.readers == []


def test_a_reader_that_fails_while_opening_or_between_chunks() -> None:
    registry, state = registered(FailingReader(ValueError("oops")))
    with pytest.raises(InputError, match=r"plugin 'theirs' failed while reading open \(ValueError: oops\)"):
        registry.readers[0].open(Path("open"), OPTIONS, Observer())
    assert registry.readers == []
    registry, state = registered(FailingReader(ValueError("oops")))
    chunks = registry.readers[0].open(Path("x.bad"), OPTIONS, Observer()).chunks()
    assert next(chunks).points.shape == (1, 3)
    with pytest.raises(InputError, match="was switched off"):
        next(chunks)
    assert not state.enabled


@pytest.mark.parametrize("error", [RuntimeError("oops"), RuntimeError("silent")])
def test_an_exporter_that_fails_or_writes_nothing(error: Exception, tmp_path: Path) -> None:
    registry, _ = registered(FailingExporter(error))
    with pytest.raises(OutputError, match=r"plugin 'theirs' failed while writing x\.bad"):
        registry.exporter(Path("x.bad")).write(factories.small_flat(), tmp_path / "x.bad")
    with pytest.raises(UsageError, match="There is no exporter"):
        registry.exporter(Path("x.bad"))


@pytest.mark.parametrize("error", [RuntimeError("oops"), RuntimeError("silent")])
def test_a_classifier_that_fails_or_says_nothing_is_replaced_by_the_papers(error: Exception) -> None:
    registry, state = registered(FailingClassifier(error))
    plan = factories.small_flat()
    classifier = registry.classifier("bad")
    assert [classifier.classify(r, plan.regions, plan.config) for r in plan.regions] == ["room", "room"]
    assert state.error.endswith("(while labelling region Living & dining)")
    with pytest.raises(UsageError, match="no region classifier 'bad'"):
        registry.classifier("bad")


@pytest.mark.parametrize("error", [InputError("The file is odd."), OSError(28, "No space"), MemoryError()])
def test_errors_on_purpose_and_of_the_system_do_not_switch_a_plugin_off(error: Exception) -> None:
    registry, state = registered(FailingReader(error))
    with pytest.raises(type(error)):
        registry.readers[0].open(Path("open"), OPTIONS, Observer())
    assert state.enabled


def test_the_right_exporter_is_chosen_by_name_then_longest_suffix_then_order() -> None:
    registry = PluginRegistry()
    for name, suffix in (("PNG", ".png"), ("Planes PNG", ".planes.png"), ("other", ".png")):
        exporter = FailingExporter(RuntimeError())
        exporter.name, exporter.suffixes = name, (suffix,)
        registry.add(PluginStatus(name, "installed"), [exporter])
    assert registry.exporter(Path("planes.png")).name == "Planes PNG"
    assert registry.exporter(Path("mine.planes.png")).name == "Planes PNG"
    assert registry.exporter(Path("aeroplanes.png")).name == "PNG"
    assert registry.exporter(Path("Some.PNG")).name == "PNG"
    assert registry.exporter(Path("x.dat"), "OTHER").name == "other"
    with pytest.raises(
        UsageError, match=r"for 'x\.dat'; known: PNG \(\.png\), Planes PNG \(\.planes\.png\), other"
    ):
        registry.exporter(Path("x.dat"))
    with pytest.raises(UsageError, match="called 'svg'"):
        registry.exporter(Path("x.png"), "svg")


def test_the_users_folder_follows_the_platform_unless_told_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FLOORCAST_PLUGINS", "/somewhere/else")
    assert plugin_discovery.user_plugin_folder() == Path("/somewhere/else")
    monkeypatch.delenv("FLOORCAST_PLUGINS")
    assert plugin_discovery.user_plugin_folder().parts[-2:] == ("floorcast", "plugins")
