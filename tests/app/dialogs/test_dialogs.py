"""The palette, sheets and boxes above the window, with real keys."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QColor, QGuiApplication, QImage
from PySide6.QtWidgets import QApplication, QMainWindow
from pytestqt.qtbot import QtBot

from floorcast_app import theme
from floorcast_app.dialogs import about, palette, screenshot, shortcuts, thumbnails
from floorcast_app.dialogs.fuzzy import score
from floorcast_app.dialogs.licences import works
from floorcast_app.dialogs.thumbnails import ThumbnailKeeper, keep_thumbnail, thumbnail
from floorcast_app.workbench import Workbench

LEFT = Qt.MouseButton.LeftButton


class Window(QMainWindow):
    """As much of the main window as dialogs need."""

    unattended = True

    def __init__(self, workbench: Workbench) -> None:
        super().__init__()
        self.workbench = workbench
        self.told: list[str] = []
        self.drawn: list[tuple[str, int, int]] = []
        self.bars: list[bool | None] = []

    def picture(self, pane: str, width: int, height: int, scale_bar: bool | None = None) -> QImage:
        self.drawn.append((pane, width, height))
        self.bars.append(scale_bar)
        image = QImage(width, height, QImage.Format.Format_RGB32)
        image.fill(QColor("#336699"))
        return image

    def tell(self, text: str, kind: str = "info") -> None:
        self.told.append(text)


@pytest.fixture
def window(workbench: Workbench, qtbot: QtBot, qapp: QApplication) -> Iterator[Window]:
    if not qapp.styleSheet():
        theme.apply_theme(qapp, "light")
    made = Window(workbench)
    qtbot.addWidget(made)
    made.resize(1000, 700)
    made.show()
    yield made


# ---- fuzzy matching -----------------------------------------------------------------------------------


@given(st.text(st.characters(codec="ascii", categories=["L"]), min_size=1, max_size=12), st.data())
def test_letters_of_a_text_in_order_always_match_it(text: str, data: st.DataObject) -> None:
    keep = data.draw(st.lists(st.booleans(), min_size=len(text), max_size=len(text)))
    typed = "".join(c for c, k in zip(text, keep, strict=True) if k)
    assert score(typed, text) is not None
    assert score(typed + "1", text) is None


def test_beginnings_of_words_win() -> None:
    texts = ["View: Zoom to selection", "View: Points by plane", "Plan: Plan again", "File: Open"]
    assert max(texts, key=lambda t: score("pa", t) or -99) == "Plan: Plan again"
    assert max(texts, key=lambda t: score("again plan", t) or -99) == "Plan: Plan again"


# ---- palette ------------------------------------------------------------------------------------------


def test_a_command_is_found_and_run_by_keys(window: Window, qtbot: QtBot) -> None:
    box = palette.show(window)  # type: ignore[arg-type]
    qtbot.keyClicks(box.line, "dark")
    assert "Dark" in box.list.currentItem().text()
    qtbot.keyClick(box.line, Qt.Key.Key_Return)
    assert window.workbench.view.look.theme == "dark"


def test_arrows_choose_another_line(window: Window, qtbot: QtBot) -> None:
    box = palette.show(window)  # type: ignore[arg-type]
    qtbot.keyClick(box.line, Qt.Key.Key_Down)
    qtbot.keyClick(box.line, Qt.Key.Key_Down)
    assert box.list.currentRow() == 2
    qtbot.keyClick(box.line, Qt.Key.Key_Up)
    assert box.list.currentRow() == 1
    box.close()


def test_settings_are_found_and_shown(window: Window, qtbot: QtBot) -> None:
    asked: list[str] = []
    window.workbench.setting_asked.connect(asked.append)
    box = palette.show(window)  # type: ignore[arg-type]
    qtbot.keyClicks(box.line, "doors max width")
    qtbot.keyClick(box.line, Qt.Key.Key_Return)
    assert asked == ["doors.max_width"]


def test_only_what_can_be_done_now_is_offered(window: Window) -> None:
    ids = {c.id for c in palette.commands(window.workbench)}
    assert "file.open" in ids and "file.export" not in ids  # there is no plan
    assert "plan.set" not in ids  # it needs arguments
    assert "help.palette" not in ids


# ---- sheets and boxes ---------------------------------------------------------------------------------


def test_the_sheet_has_every_shortcut_once(window: Window, qtbot: QtBot) -> None:
    shown = [
        keys for title, rows in shortcuts.groups(window.workbench) for keys, _ in rows if title != "Mouse"
    ]
    wanted = [a.shortcut for a in window.workbench.actions if a.shortcut]
    assert sorted(shown) == sorted(wanted)
    sheet = shortcuts.show(window)  # type: ignore[arg-type]
    assert sheet.isVisible() and not sheet.isModal()
    qtbot.keyClick(sheet, Qt.Key.Key_Escape)
    qtbot.waitUntil(lambda: window.findChild(shortcuts.ShortcutsSheet) is None)


def test_no_two_actions_share_a_shortcut(window: Window) -> None:
    keys = [k for a in window.workbench.actions for k in re.split(r" \| ", a.shortcut) if k]
    assert sorted(k for k in set(keys) if keys.count(k) > 1) == []


def test_every_package_that_is_required_is_named_with_its_licence() -> None:
    found = {w.name.lower().replace("_", "-"): w for w in works()}
    assert {"numpy", "pydantic", "scipy", "pyside6-essentials", "inter", "lucide"} <= set(found)
    assert all(w.licence and w.version for w in found.values())
    assert "SIL OPEN FONT LICENSE" in found["inter"].text().upper()
    assert "ISC" in found["lucide"].text()
    assert "Redistribution" in found["numpy"].text()
    for qt in ("pyside6-essentials", "shiboken6"):  # under the LGPL, which wants both texts and a notice
        said = found[qt].text()
        assert all(word in said for word in ("used unmodified", "GNU LESSER GENERAL", "GNU GENERAL PUBLIC"))


def test_about_shows_the_licence_of_what_is_chosen(window: Window, qtbot: QtBot) -> None:
    box = about.show(window)  # type: ignore[arg-type]
    at = next(i for i, w in enumerate(box.works) if w.name == "Inter")
    box.list.setCurrentItem(box.list.topLevelItem(at))
    assert "SIL Open Font License" in box.text.toPlainText()
    box.close()


# ---- pictures -----------------------------------------------------------------------------------------


def test_a_picture_is_copied_at_the_size_that_was_asked(window: Window, qtbot: QtBot) -> None:
    dialog = screenshot.show(window)  # type: ignore[arg-type]
    dialog.width_box.setValue(800)
    dialog.height_box.setValue(500)
    assert dialog.size_box.currentText() == "Own size"
    qtbot.mouseClick(dialog.copy, LEFT)
    image = QGuiApplication.clipboard().image()
    assert (image.width(), image.height()) == (800, 500)
    assert window.drawn[-1] == ("floor_plan", 800, 500)
    dialog.close()


def test_a_picture_is_saved_through_the_action(
    window: Window, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ran: list[tuple[str, dict[str, object]]] = []
    monkeypatch.setattr(window.workbench, "try_run", lambda id, **a: ran.append((id, a)))
    monkeypatch.setattr(window.workbench.ui, "ask_save", lambda *a: tmp_path / "plan")
    dialog = screenshot.show(window)  # type: ignore[arg-type]
    qtbot.mouseClick(dialog.save, LEFT)
    arguments = {"path": tmp_path / "plan.png", "pane": "floor_plan", "width": 1600, "height": 1200}
    assert ran == [("file.picture", {**arguments, "scale_bar": True})]
    dialog.close()


def test_the_scale_bar_is_switched_for_plans_only(window: Window, qtbot: QtBot) -> None:
    dialog = screenshot.show(window)  # type: ignore[arg-type]
    dialog.bar.click()
    qtbot.mouseClick(dialog.copy, LEFT)
    assert window.bars[-1] is False
    qtbot.keyClicks(dialog.pane, "3D")
    dialog.pane.activated.emit(dialog.pane.currentIndex())
    assert dialog.pane.currentData() == "space"
    assert not dialog.bar.isEnabled()
    dialog.close()


def test_the_preview_is_drawn_small(window: Window, qtbot: QtBot) -> None:
    dialog = screenshot.show(window)  # type: ignore[arg-type]
    dialog.size_box.setCurrentIndex(3)
    dialog.size_box.activated.emit(3)
    qtbot.waitUntil(lambda: len(window.drawn) >= 2)
    assert all(width <= 2 * screenshot.PREVIEW.width() for _, width, _ in window.drawn)
    dialog.close()


# ---- thumbnails ---------------------------------------------------------------------------------------


def test_a_thumbnail_is_kept_for_the_survey(
    window: Window, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(thumbnails.platformdirs, "user_cache_dir", lambda name: str(tmp_path / name))
    survey = tmp_path / "a.ply"
    assert thumbnail(survey, QSize(168, 104)) is None
    keep_thumbnail(survey, window.picture("floor_plan", 504, 312))
    shown = thumbnail(survey, QSize(168, 104))
    assert shown is not None and (shown.width(), shown.height()) == (168, 104)
    (tmp_path / "b.floorcast").write_bytes(b"no zip at all")
    assert thumbnail(tmp_path / "b.floorcast", QSize(168, 104)) is None
    ThumbnailKeeper(window).keep()  # no plan yet: nothing to draw
    assert len(window.drawn) == 1
