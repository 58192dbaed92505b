"""German is complete, its files are fresh, and sentences are found by what they were made from."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QTranslator
from PySide6.QtWidgets import QApplication

from floorcast_app import translation
from floorcast_app.actions import all_actions
from tools import translate

FOLDER = Path(__file__).resolve().parents[2] / "resources" / "translations"


@pytest.fixture
def german(qapp: QApplication, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv(translation.LANGUAGE_VARIABLE, "de")
    assert translation.install_translator(qapp) == "de"
    yield
    monkeypatch.setenv(translation.LANGUAGE_VARIABLE, "en")
    assert translation.install_translator(qapp) == "en"


def test_no_string_is_without_german_words() -> None:
    assert translate.missing("de") == []


def test_the_collector_finds_what_is_shown() -> None:
    found = translate.strings()
    assert {"Open…", "Layout planes", "Search settings", "Saved {0}.", "Max width"} <= found
    assert not any(s.startswith(("file.", "panels.")) or "*." in s for s in found)


def test_gaps_are_kept() -> None:
    for source, target in translate.read("de").items():
        assert sorted(re.findall(r"\{\w*\}", source)) == sorted(re.findall(r"\{\w*\}", target)), source


def test_german_is_not_english() -> None:
    long_ones = {s: t for s, t in translate.read("de").items() if len(s.split()) > 2 and "{" not in s}
    assert [s for s, t in long_ones.items() if s == t] == []


def test_the_built_file_says_what_the_source_says(qapp: QApplication) -> None:
    built = QTranslator()
    assert built.load("floorcast_de", str(FOLDER))
    for source, target in translate.read("de").items():
        for n, form in enumerate(target.split("\n"), start=1):
            assert built.translate("Floorcast", source, "", n if "%" in source else -1) == form, source


def test_one_is_one_and_two_are_two(german: None) -> None:
    assert translation.tr_n("%Ln region(s)", 1) == "1 Region"
    assert translation.tr_n("%Ln region(s)", 2) == "2 Regionen"
    assert translation.tr_n("%Ln point(s)", 340000) == "340.000 Punkte"


def test_english_counts_too(qapp: QApplication) -> None:
    assert [translation.tr_n("%Ln door(s)", n) for n in (0, 1, 2)] == ["0 doors", "1 door", "2 doors"]


def test_history_names_things_in_german(german: None) -> None:
    assert translation.tr_text("Reject door d1") == "Tür d1 verwerfen"
    assert translation.tr_text("Label region 3 as lobby") == "Region 3 als lobby bezeichnen"


def test_the_list_of_sentences_is_fresh() -> None:
    kept = (FOLDER / "sentences.txt").read_text(encoding="utf-8").splitlines()
    assert kept == sorted(translate.sentences())


def test_actions_and_sentences_are_translated(german: None) -> None:
    opening = next(a for a in all_actions() if a.id == "file.open")
    assert translation.tr_action(opening)[0] == "Öffnen…"
    assert translation.tr_text("Saved office.floorcast.") == "office.floorcast gespeichert."
    assert translation.tr_text("Set doors.max_width to 1.6") == "doors.max_width auf 1,6 setzen"
    guess = "Coordinates are taken as metres (floor to ceiling is then 2.65 m); force it with input.unit."
    assert translation.tr_text(guess).startswith("Die Koordinaten gelten als Meter (vom Boden zur Decke")
    assert translation.tr_text("Nothing of the kind.") == "Nothing of the kind."


def test_every_sentence_with_gaps_is_found_again(german: None) -> None:
    known = translate.read("de")
    for source in translate.sentences():
        said, shown = (re.sub(r"\{(\d+)\}", r"Xy\1", text) for text in (source, known[source]))
        assert translation.tr_text(said) == shown


def test_what_the_core_says_is_collected_from_it_and_shown_in_german(german: None, tmp_path: Path) -> None:
    from floorplan_core.errors import InputError
    from floorplan_core.readers import open_survey

    broken = tmp_path / "broken.ply"
    broken.write_bytes(b"ply\nformat ascii 1.0\nelement vertex 4\n")
    said = []
    for path in (tmp_path / "my scan.ply", broken):
        with pytest.raises(InputError) as failure:
            open_survey(path)
        said.append(translation.tr_text(str(failure.value)))
    assert said == [
        f"Die Eingabe {tmp_path / 'my scan.ply'} gibt es nicht.",
        "broken.ply gibt sich als PLY aus, aber der Kopf endet nicht ('end_header' fehlt).",
    ]


def test_sentences_in_a_row_and_within_each_other(german: None) -> None:
    assert (
        translation.tr_text(
            "9,204 lines of a.xyz hold no point; they were left out. The trajectory is b.tum."
        )
        == "9.204 Zeilen von a.xyz enthalten keinen Punkt; sie wurden weggelassen. Die Trajektorie ist b.tum."
    )
    assert (
        translation.tr_text("The plugin 'p' failed while reading a.xyz (KeyError) and was switched off.")
        == "Die Erweiterung 'p' scheiterte, während sie a.xyz las (KeyError), und wurde abgeschaltet."
    )


def test_qt_itself_speaks_german_where_its_translation_is_installed(german: None) -> None:
    from PySide6.QtCore import QCoreApplication, QLibraryInfo

    folder = Path(QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))
    if not (folder / "qtbase_de.qm").exists():
        pytest.skip("this build of Qt brings no translations")
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Abbrechen"


def test_numbers_have_a_comma_in_german_and_a_point_in_files(german: None, tmp_path: Path) -> None:
    from PySide6.QtWidgets import QDoubleSpinBox

    from floorcast_app.actions.measure_actions import table_csv
    from floorcast_app.format import area, count, length, parse_length
    from floorcast_app.state import Check

    assert (length(3.2), area(1234.5), count(18204)) == ("3,200 m", "1.234,50 m²", "18.204")
    assert parse_length(length(1234.5)) == parse_length("1.234,500") == 1234.5
    assert translation.tr_text("Measure 3.412 m").endswith("3,412 m messen")
    assert translation.tr_text("door, 0.914 m wide, 98% sure") == "Tür, 0,914 m breit, 98% sicher"
    assert translation.tr_text("wall at -3.200 m") == "Wand bei -3,200 m"
    assert [translation.tr_text(s) for s in ("name 1", "label corridor")] == ["Name 1", "Art Flur"]
    spin = QDoubleSpinBox()
    spin.setValue(2.5)
    assert spin.text() == "2,50"
    assert "3.4120" in table_csv((Check("c1", (0.0, 0.0), (3.4, 0.0), 3.412),))


def test_english_is_left_as_it_is(qapp: QApplication) -> None:
    assert translation.tr_text("Saved a.floorcast.") == "Saved a.floorcast."
    assert translation.tr("Open…") == "Open…"


def test_a_language_is_chosen_by_environment_wish_and_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(translation.LANGUAGE_VARIABLE, "de_AT")
    assert translation.choose_language("en") == "de"
    monkeypatch.delenv(translation.LANGUAGE_VARIABLE)
    assert translation.choose_language("de") == "de"
    assert translation.choose_language("xx") in translation.LANGUAGES
