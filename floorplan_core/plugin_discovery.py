"""Where plugins are looked for: the shipped folder, the entry points of packages, the user's folder.

A plugin that raises while it is imported or asked what it brings is reported with its reason; others load.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import importlib.util
import os
import pkgutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pluggy

from floorplan_core.errors import let_interrupt_through
from floorplan_core.plugins import PROJECT, Exporter, Hooks, PluginStatus, Reader, RegionClassifier

ENTRY_POINT_GROUP = "floorcast.plugins"
SHIPPED_PACKAGE = "floorcast_plugins"
USER_PACKAGE = "floorcast_user_plugins"  # name in sys.modules of what comes from the user's folder
FOLDER_VARIABLE = "FLOORCAST_PLUGINS"

Source = tuple[str, str, Callable[[], Any]]  # name, origin, how to import it
_KINDS = {
    "floorcast_readers": ("a reader", Reader),
    "floorcast_exporters": ("an exporter", Exporter),
    "floorcast_classifiers": ("a classifier", RegionClassifier),
}


def user_plugin_folder() -> Path:
    """The folder for one's own plugins: ``$FLOORCAST_PLUGINS``, else the platform's data folder."""
    if os.environ.get(FOLDER_VARIABLE):
        return Path(os.environ[FOLDER_VARIABLE])
    import platformdirs

    return Path(platformdirs.user_data_dir("floorcast", appauthor=False)) / "plugins"


def load_all(user_folder: Path | None = None) -> Iterator[tuple[PluginStatus, list[Any]]]:
    """Every plugin that is found, in a stated order: shipped, installed, user folder; by name within each."""
    for source in (*_shipped(), *_installed(), *_of_user(user_folder or user_plugin_folder())):
        yield _load(*source)


def _load(name: str, origin: str, importer: Callable[[], Any]) -> tuple[PluginStatus, list[Any]]:
    status = PluginStatus(name, origin)
    try:
        things = _ask(importer(), status)
    except (KeyboardInterrupt, MemoryError):
        raise
    except BaseException as error:  # noqa: BLE001 - whatever a plugin does, even sys.exit(), the program goes on
        let_interrupt_through(error)
        status.error = reason(error)
        return status, []
    return status, things


def reason(error: BaseException) -> str:
    """Type and first line of ``error``, for the list of plugins."""
    lines = str(error).strip().splitlines()
    return f"{type(error).__name__}: {lines[0].rstrip('.')}" if lines else type(error).__name__


def _ask(plugin: Any, status: PluginStatus) -> list[Any]:
    """Call the plugin's hooks; what it brings must have the attributes of its protocol."""
    manager = pluggy.PluginManager(PROJECT)
    manager.add_hookspecs(Hooks)
    manager.register(plugin, name=status.name)
    manager.check_pending()  # a misspelt hook would otherwise never be called
    things = []
    for hook, (kind, protocol) in _KINDS.items():
        for thing in (t for result in getattr(manager.hook, hook)() for t in result):
            _check(thing, kind, protocol)
            status.brings.append(f"{kind.split()[-1]} {thing.name}")
            status.about.append(str(thing.description))
            things.append(thing)
    if not manager.get_hookcallers(plugin):
        raise TypeError("it has none of the hooks " + ", ".join(_KINDS))
    return things


def _check(thing: Any, kind: str, protocol: Any) -> None:
    if isinstance(thing, type) or not isinstance(thing, protocol):
        raise TypeError(f"{thing!r} is not {kind}: it lacks a name, a description or a method")


def _shipped() -> list[Source]:
    """The modules of the shipped package (``plugins/`` in a checkout); pkgutil lists them when frozen too."""
    try:
        package = importlib.import_module(SHIPPED_PACKAGE)
    except ImportError:
        return []
    names = sorted(m.name for m in pkgutil.iter_modules(package.__path__) if not m.name.startswith("_"))
    return [(name, "shipped", _importer(f"{SHIPPED_PACKAGE}.{name}")) for name in names]


def _installed() -> list[Source]:
    points = importlib.metadata.entry_points(group=ENTRY_POINT_GROUP)
    return [(p.name, "installed", p.load) for p in sorted(points, key=lambda p: (p.name, p.value))]


def _of_user(folder: Path) -> list[Source]:
    """Modules ``NAME.py`` and packages ``NAME/__init__.py`` of ``folder``; none where it does not exist."""
    try:
        entries = sorted(folder.iterdir()) if folder.is_dir() else []
    except OSError:
        return []
    files = [(e.stem, e / "__init__.py" if e.is_dir() else e) for e in entries if e.name[0] not in "._"]
    return [
        (name, "user folder", _file_importer(name, file))
        for name, file in files
        if file.suffix == ".py" and file.is_file()
    ]


def _importer(module: str) -> Callable[[], Any]:
    return lambda: importlib.import_module(module)


def _file_importer(name: str, file: Path) -> Callable[[], Any]:
    def load() -> Any:
        full = f"{USER_PACKAGE}.{name}"
        folders = [str(file.parent)] if file.name == "__init__.py" else None
        spec = importlib.util.spec_from_file_location(full, file, submodule_search_locations=folders)
        if spec is None or spec.loader is None:
            raise ImportError(f"{file.name} cannot be imported")
        module = importlib.util.module_from_spec(spec)
        sys.modules[full] = module
        spec.loader.exec_module(module)
        return module

    return load
