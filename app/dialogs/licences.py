"""Whose work is in Floorcast, and under which licence: read off the installed packages. No Qt."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import Distribution, PackageNotFoundError, distribution

from floorcast_app import theme

OWN = "floorcast"
LICENCE_FILE = re.compile(r"(^|/)(licen[cs]e|copying|notice)[^/]*$", re.IGNORECASE)
LONGEST = 200_000  # characters of a licence text that are shown
# Qt's packages bring no text; its licence wants both beside the program (LGPL-3.0, section 4).
LGPL = ("QT.txt", "LGPL-3.0.txt", "GPL-3.0.txt")
OF_QT = ("PySide6_Essentials", "shiboken6")
DATA = (
    ("Inter", "4.1", "OFL-1.1", "fonts/LICENSE.inter"),
    ("Lucide", "1.62.0", "ISC", "icons/LICENSE.lucide"),
)


@dataclass(frozen=True)
class Work:
    """One package, font or set of icons."""

    name: str
    version: str
    licence: str  # SPDX where the package says so, else what it says
    file: str = ""  # in the resources folder, for what is no package

    def text(self) -> str:
        """The licence itself; "" where the package brings none."""
        if self.file:
            return theme.resource(*self.file.split("/")).read_text(encoding="utf-8")
        if self.name in OF_QT:
            return "\n".join(theme.resource("licences", name).read_text(encoding="utf-8") for name in LGPL)
        return _text(distribution(self.name))


def works() -> list[Work]:
    """Everything that Floorcast needs, by name; what is not installed is left out."""
    packages = [_work(d) for d in _closure(OWN, {})]
    return sorted([*packages, *(Work(*data) for data in DATA)], key=lambda w: w.name.casefold())


def _closure(name: str, seen: dict[str, bool]) -> Iterator[Distribution]:
    """The packages that ``name`` requires, and those that they require."""
    for required in _required(name):
        key = re.sub(r"[-_.]+", "-", required).lower()
        if key in seen or key == OWN:
            continue
        seen[key] = True
        try:
            found = distribution(required)
        except PackageNotFoundError:
            continue
        yield found
        yield from _closure(required, seen)


def _required(name: str) -> list[str]:
    try:
        lines = distribution(name).requires or []
    except PackageNotFoundError:
        return []
    out = []
    for line in lines:
        wanted, _, marker = line.partition(";")
        if "extra" not in marker:
            out.append(re.match(r"[\w.-]+", wanted.strip())[0])  # type: ignore[index]
    return out


def _work(found: Distribution) -> Work:
    data = found.metadata
    licence = data.get("License-Expression") or _from_classifiers(data.get_all("Classifier") or [])
    licence = licence or (data.get("License") or "").strip().splitlines()[0:1]
    text = licence if isinstance(licence, str) else "".join(licence)
    return Work(data["Name"], found.version, text[:60] or "see its text")


def _from_classifiers(classifiers: list[str]) -> str:
    found = [c.rpartition(" :: ")[2] for c in classifiers if c.startswith("License ::")]
    return ", ".join(f for f in found if f != "OSI Approved")


def _text(found: Distribution) -> str:
    for path in found.files or ():
        if LICENCE_FILE.search(str(path)) and path.suffix not in (".py", ".pyc"):
            try:
                return path.read_text(encoding="utf-8")[:LONGEST]
            except (OSError, UnicodeDecodeError):
                continue
    return ""
