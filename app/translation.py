"""Languages: Qt's translator with resources/translations/*.qm, and words for what Qt-free modules say.

Widgets call :func:`tr`. Actions, history entries and messages come from modules that know no Qt; their
English is looked up when it is shown: whole (:func:`tr_action`) or by the sentence that it was made from
(:func:`tr_text`: "Saved {0}." with the name put back). ``tools/translate.py`` collects the strings and builds
the ``.qm`` files.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QSettings, QTranslator

from floorcast_app import format, theme

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

    from floorcast_app.actions.registry import Action

CONTEXT = "Floorcast"
LANGUAGES = {"en": "English", "de": "Deutsch"}
SETTING = "language"  # in the user's settings
LANGUAGE_VARIABLE = "FLOORCAST_LANGUAGE"  # "de" or "en": before the user's choice and the system's language

_NUMBER = re.compile(r"-?[\d,]*\.\d+( \S+)?")
_MARKS = {"en": (".", ","), "de": (",", ".")}  # the decimal mark, and what parts thousands
_LOCALES = {"en": "en_GB", "de": "de_DE"}  # of the fields that numbers are typed into

_installed: list[QTranslator] = []


def tr(text: str) -> str:
    """``text`` in the language of the application."""
    return QCoreApplication.translate(CONTEXT, text)


def tr_n(text: str, n: int) -> str:
    """``text`` of ``n`` things, in the form that the language has for so many: "%Ln region(s)".

    English is its own catalogue: "(s)" is the plural's.
    """
    said = QCoreApplication.translate(CONTEXT, text, "", n)
    return said.replace("(s)", "" if n == 1 else "s")


def tr_action(action: Action) -> tuple[str, str]:
    """Text and tip of an action."""
    return tr(action.text), tr(action.tip) if action.tip else ""


def tr_text(text: str) -> str:
    """A whole sentence that a Qt-free module composed; unchanged where no sentence of the catalogue fits."""
    whole = tr(text)
    if whole != text or not _installed:
        return whole
    for pattern, source in _patterns():
        found = pattern.fullmatch(text)
        translated = tr(source) if found else source
        if found and translated != source:
            return _filled(translated, [_part(group) for group in found.groups()])
    return text


def choose_language(wanted: str = "") -> str:
    """A language of :data:`LANGUAGES`: of the environment, the wanted one, or the system's; else English."""
    for name in (os.environ.get(LANGUAGE_VARIABLE, ""), wanted, QLocale.system().name()):
        if name[:2] in LANGUAGES:
            return name[:2]
    return "en"


def install_translator(app: QApplication, wanted: str = "") -> str:
    """Show everything in the chosen language from now on; returns it."""
    while _installed:
        app.removeTranslator(_installed.pop())
    language = choose_language(wanted or str(QSettings().value(SETTING, "")))
    format.use_marks(*_MARKS[language])
    QLocale.setDefault(QLocale(_LOCALES[language]))
    if language == "en":
        return language
    qt_folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    for name, folder in (
        (f"qtbase_{language}", qt_folder),
        (f"floorcast_{language}", str(theme.resource("translations"))),
    ):
        translator = QTranslator(app)
        if translator.load(name, folder):
            app.installTranslator(translator)
            _installed.append(translator)
    return language


@lru_cache(maxsize=1)
def _patterns() -> tuple[tuple[re.Pattern[str], str], ...]:
    """The catalogue's sentences with gaps; the longest first, so that the most exact one wins."""
    sources = theme.resource("translations", "sentences.txt").read_text(encoding="utf-8").splitlines()
    return tuple((_as_pattern(s), s) for s in sorted(filter(None, sources), key=lambda s: (-len(s), s)))


def _as_pattern(source: str) -> re.Pattern[str]:
    parts = re.split(r"\{\d+\}", source)
    return re.compile("(.+?)".join(re.escape(p) for p in parts))


def _part(group: str) -> str:
    """What stood in a gap: another sentence, or a number with its unit."""
    return format.localised(group) if _NUMBER.fullmatch(group) else tr_text(group)


def _filled(translated: str, groups: Sequence[str]) -> str:
    return re.sub(r"\{(\d+)\}", lambda m: groups[int(m[1])], translated)
