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

_NUMBER = re.compile(r"-?[\d,]*\.\d+( \S+)?|-?\d{1,3}(,\d{3})+")
_GAP = re.compile(r"\{(\d+)\}")
_BETWEEN = re.compile(r"(?<=[.!?]) +(?=\S)")  # two sentences
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
    """What a Qt-free module composed, the core's errors and warnings too: by its sentence of the catalogue.

    Where none fits the whole, sentence by sentence; unchanged where none fits.
    """
    whole = tr(text)
    if whole != text or not _installed:
        return whole
    for pattern, source in _patterns():
        found = pattern.fullmatch(text)
        translated = tr(source) if found else source
        if found and translated != source:
            return _filled(translated, [_part(group) for group in found.groups()])
    sentences = _BETWEEN.split(text)
    return " ".join(map(tr_text, sentences)) if len(sentences) > 1 else text


def choose_language(wanted: str = "") -> str:
    """A language of :data:`LANGUAGES`: of the environment, the wanted one, or the system's; else English."""
    for name in (os.environ.get(LANGUAGE_VARIABLE, ""), wanted, QLocale.system().name()):
        if name[:2] in LANGUAGES:
            return name[:2]
    return "en"


def install_translator(app: QApplication, wanted: str = "") -> str:
    """Show what is made from now on in a language: the one wanted, else the chosen one; returns it."""
    while _installed:
        app.removeTranslator(_installed.pop())
    language = wanted if wanted in LANGUAGES else choose_language(str(QSettings().value(SETTING, "")))
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
    """The catalogue's sentences with gaps; the one with most of its own words first: it says most exactly."""
    sources = theme.resource("translations", "sentences.txt").read_text(encoding="utf-8").splitlines()
    return tuple((_as_pattern(s), s) for s in sorted(sources, key=lambda s: (-len(_GAP.sub("", s)), s)))


def _as_pattern(source: str) -> re.Pattern[str]:
    parts = re.split(r"\{\d+\}", source)
    return re.compile("(.+?)".join(re.escape(p) for p in parts), re.DOTALL)


def _part(group: str) -> str:
    """What stood in a gap: another sentence, or a number with its unit."""
    return format.localised(group) if _NUMBER.fullmatch(group) else tr_text(group)


def _filled(translated: str, groups: Sequence[str]) -> str:
    return _GAP.sub(lambda m: groups[int(m[1])], translated)
