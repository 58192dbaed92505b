"""Collects the English strings of the application and builds resources/translations: .ts, .qm, sentences.

    python tools/translate.py            # update the .ts files (edit these) and build the rest from them
    python tools/translate.py --missing  # list what a language has no words for; exit status 1 where any

Qt's own lupdate does not know that menus, settings, presets and columns are data; this reads them where they
are declared. Strings: literals given to ``tr``, ``translate`` and the like; texts and tips of actions;
titles, tips and words in the tables of the panels; settings, preferences, presets. Sentences with gaps:
f-strings that modules without Qt give to ``tell``, ``change``, ``apply``, ``correct``, ``start`` and to
errors they raise; and all phrases of the core and the plugins, outside of what the window never shows.
"""

from __future__ import annotations

import ast
import itertools
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "resources" / "translations"
LANGUAGES = ("de",)
CONTEXT = "Floorcast"
PLURALS = {"tr_n"}  # of so many things: Qt picks the form (in German one, or more)
CALLS = {"tr", "_tr", "words", "_words"}  # their first argument is shown
SAID = {"tell", "change", "apply", "correct", "start", "reset", "ask_open", "ask_save", "ask_text", "ask_yes"}
ERRORS = {"UsageError", "InputError", "OutputError", "FloorPlanError", "Cancelled"}
DATA = {"Action", "Pane", "Column", "_word", "_tool"}  # classes and helpers whose texts are shown
TABLES = {  # module-level tables whose strings are shown: all of them, or the values of a dict
    "LAYER_TEXTS", "COLOUR_TEXTS", "SECTION_FIELDS", "FACINGS", "TABS", "TITLES", "TIPS", "STAGES",
    "EVIDENCE", "WORDS", "MENU_WORDS", "MENU_TITLES", "GESTURES", "SIZES",
    "SUBMENUS", "hint", "area_hint", "plane_hint", "door_hint", "nowhere", "empty",  # of tools and plan panes
}  # fmt: skip
UNSHOWN = (  # parts of the core whose words the window does not show, or shows as data
    "__init__.py",
    "cli",
    "config.py",
    "drawing_style.py",
    "evaluation",
    "exporters",
    "intermediates.py",
    "intermediates_tree.py",
    "open3d_import.py",
    "restart.py",
    "settings_table.py",
    "simulation",
)
_PHRASE = re.compile(  # two words, or one and a gap; no line of a header or a program
    r"(?s)\s?[^\W\d_]{2,} \{\d+\}|(?=.*([^\W\d_]{2}|\}),?:? [^\W\d_])(?!.*[<>_=]\{).*[a-z]{2}.*"
)
_COUNTS = re.compile(r"%L?n")
LETTERS = {"N", "E", "S", "W"}  # of the compass
EXTRA = (  # words of the core that lists show
    "Room", "Corridor", "Predicted floor", "Wall", "Guessed side", "Door", "Door, found shut", "Opening",
    "room", "corridor", "door", "opening", "north", "east", "south", "west", "predicted", "recess", "wall",
    "furniture", "auto", "greedy", "exact", "metres", "centimetres", "millimetres", "feet", "rejected",
    "resized",
    "door {0}", "region {0}", "wall {0}", "doors {0} and {1}", "regions {0} and {1}", "walls {0} and {1}",
    "{0} doors", "{0} regions", "{0} walls",
    "The input {0} does not exist.", "The trajectory {0} does not exist.", "input", "trajectory",
    "The input {0} is a link to something that does not exist.",
    "a folder", "a pipe", "a socket", "a device", "No such file or directory", "Permission denied",
    "{0} scans", "a plugin", "none", "GPS time",
    "Room {0}",
    "Corridor {0}",
    "floor to ceiling is then {0} m", "the height is then {0} m",
    "name {0}", "label {0}", "wall at {0}", "{0}, {1} wide, {2} sure",  # what the machine had said
    "{0} buildings stand apart from each other: each is planned by itself, in one frame.",
    "{0} m2 of free space are in no region: no rectangle of walls encloses them.",
    "the points are flat, so only their extent could tell",
)  # fmt: skip


def strings() -> set[str]:
    """Everything that is shown, in English."""
    found = set(EXTRA)
    for path in sorted((ROOT / "app").rglob("*.py")):
        found |= set(_of_module(ast.parse(path.read_text(encoding="utf-8"))))
    for folder in ("floorplan_core", "plugins"):
        for path in sorted((ROOT / folder).rglob("*.py")):
            if not any((ROOT / folder / name) in (path, *path.parents) for name in UNSHOWN):
                found |= set(_phrases_of(ast.parse(path.read_text(encoding="utf-8"))))
    shown = {
        s
        for s in (*found, *_actions(), *_settings(), *_preferences(), *_presets(), *_formats())
        if re.search(r"[^\W\d_]{2}", s)
    }
    return shown | LETTERS


def sentences() -> set[str]:
    """Those with numbered gaps."""
    return {s for s in strings() if "{0}" in s}


def _of_module(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            yield from _of_call(node)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            yield from _of_table(node)


def _phrases_of(tree: ast.Module) -> Iterator[str]:
    """Strings of two words and more, docstrings left out: what the core says, and the parts of it."""
    docs = {id(n.value) for n in ast.walk(tree) if isinstance(n, ast.Expr)}
    inner = {id(v) for n in ast.walk(tree) if isinstance(n, ast.JoinedStr) for v in n.values}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr | ast.Constant) and id(node) not in docs | inner:
            yield from (_numbered(s.strip()) for s in _texts(node) if _PHRASE.fullmatch(s))


def _numbered(template: str) -> str:
    """A template of ``str.format`` with numbered gaps, as those of f-strings are."""
    count = itertools.count()
    return re.sub(r"\{[^{}]*\}", lambda _: f"{{{next(count)}}}", template)


def _of_call(node: ast.Call) -> Iterator[str]:
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    if name in CALLS | PLURALS and node.args:
        yield from _literals(node.args[0])
    elif name == "translate" and len(node.args) > 1:
        yield from _literals(node.args[1])
    elif name in DATA:
        shown = node.args[1:] if name in ("Action", "_tool") else node.args
        named = (k.value for k in node.keywords if k.arg in ("text", "tip", "title"))
        wanted = (*shown, *named)
        yield from (s for a in wanted for s in _texts(a) if _is_words(s))
    elif name in SAID | ERRORS:
        yield from (s for a in node.args[:3] for s in _texts(a) if _is_words(s))


def _of_table(node: ast.Assign | ast.AnnAssign) -> Iterator[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    names = {t.id for t in targets if isinstance(t, ast.Name)}
    if not names & TABLES or node.value is None:
        return
    values = node.value.values if isinstance(node.value, ast.Dict) else [node.value]
    for value in values:
        yield from (
            n.value for n in ast.walk(value) if isinstance(n, ast.Constant) and isinstance(n.value, str)
        )


def _literals(node: ast.expr) -> Iterator[str]:
    """String constants among the values that ``node`` can have (also both arms of a condition)."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from _literals(node.body)
        yield from _literals(node.orelse)


def _texts(node: ast.expr) -> Iterator[str]:
    """The same, with f-strings as sentences with numbered gaps."""
    if isinstance(node, ast.JoinedStr):
        parts, gaps = [], 0
        for piece in node.values:
            if isinstance(piece, ast.Constant):
                parts.append(str(piece.value))
            else:
                parts.append(f"{{{gaps}}}")
                gaps += 1
        yield "".join(parts)
    elif isinstance(node, ast.IfExp):
        yield from _texts(node.body)
        yield from _texts(node.orelse)
    else:
        yield from _literals(node)


def _is_words(text: str) -> bool:
    """False for ids, shortcuts, names of icons and file patterns."""
    plain = re.sub(r"\{\d+\}", "", text)
    if "*." in plain or re.fullmatch(r"[a-z0-9_.\-/]*|[\w.]+:\w+", plain):
        return False
    keys = r"((Ctrl|Shift|Alt)\+)+\S*( \| \S+)*|\S|F\d+|Home|Escape|Delete|Del|[\W\d]*"
    return not re.fullmatch(keys, plain)


def _actions() -> Iterator[str]:
    from floorcast_app.actions import all_actions

    for action in all_actions():
        yield action.text
        yield action.tip


def _settings() -> Iterator[str]:
    from floorcast_app.panels.setting_fields import setting_stages

    for stage in setting_stages():
        yield from (stage.title, stage.help)
        for field in stage.fields:
            yield from (field.title, field.help)


def _preferences() -> Iterator[str]:
    from floorcast_app.preferences import PREFERENCES

    for preference in PREFERENCES:
        yield from (preference.group, preference.title, preference.help, preference.zero)
        yield from (text for _, text in preference.choices)


def _presets() -> Iterator[str]:
    from floorcast_app.presets import presets

    for preset in presets():
        yield from (preset.name, preset.reason)


def _formats() -> Iterator[str]:
    from floorplan_core.plugins import default_registry

    for exporter in default_registry().exporters:
        yield exporter.description


def contexts() -> set[str]:
    """The contexts that ``QCoreApplication.translate`` is called with, and our own."""
    found = {CONTEXT}
    for path in (ROOT / "app").rglob("*.py"):
        found |= set(re.findall(r"\btranslate\(\s*\"(\w+)\"", path.read_text(encoding="utf-8")))
    return found


def read(language: str) -> dict[str, str]:
    """The translations of a .ts file."""
    path = FOLDER / f"floorcast_{language}.ts"
    if not path.exists():
        return {}
    messages = ElementTree.parse(path).iter("message")
    return {m.findtext("source") or "": _translation(m) for m in messages}


def _translation(message: ElementTree.Element) -> str:
    """The words of a message; several forms in lines of their own, "" where one is missing."""
    forms = [form.text or "" for form in message.iter("numerusform")]
    if forms:
        return "\n".join(forms) if all(forms) else ""
    return message.findtext("translation") or ""


def write(language: str, translations: dict[str, str]) -> None:
    """The .ts file: one set of messages for each context, as Qt looks them up."""
    root = ElementTree.Element("TS", version="2.1", language=language, sourcelanguage="en")
    for name in sorted(contexts()):
        context = ElementTree.SubElement(root, "context")
        ElementTree.SubElement(context, "name").text = name
        for source in sorted(translations):
            message = ElementTree.SubElement(context, "message")
            ElementTree.SubElement(message, "source").text = source
            target = ElementTree.SubElement(message, "translation")
            _fill(message, target, source, translations[source])
            if not translations[source]:
                target.set("type", "unfinished")
    ElementTree.indent(root, " ")
    path = FOLDER / f"floorcast_{language}.ts"
    body = ElementTree.tostring(root, encoding="unicode")
    path.write_text(f'<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n{body}\n', encoding="utf-8")


def _fill(message: ElementTree.Element, target: ElementTree.Element, source: str, text: str) -> None:
    if not _COUNTS.search(source):
        target.text = text
        return
    message.set("numerus", "yes")
    for form in text.split("\n") if text else ("", ""):
        ElementTree.SubElement(target, "numerusform").text = form


def build(language: str) -> None:
    """The .qm file, by Qt's lrelease."""
    source = FOLDER / f"floorcast_{language}.ts"
    import PySide6

    tool = Path(PySide6.__file__).parent / ("lrelease.exe" if sys.platform == "win32" else "lrelease")
    command = [str(tool), "-silent", str(source), "-qm", str(source.with_suffix(".qm"))]
    subprocess.run(command, check=True)


def missing(language: str) -> list[str]:
    """Strings without words in ``language``."""
    known = read(language)
    return sorted(s for s in strings() if not known.get(s))


def main() -> int:
    if "--missing" in sys.argv:
        lacking = [f"{language}: {text}" for language in LANGUAGES for text in missing(language)]
        print("\n".join(lacking))  # noqa: T201
        return 1 if lacking else 0
    FOLDER.mkdir(exist_ok=True)
    for language in LANGUAGES:
        known = read(language)
        write(language, {s: known.get(s, "") for s in strings()})
        build(language)
    (FOLDER / "sentences.txt").write_text("\n".join(sorted(sentences())) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
