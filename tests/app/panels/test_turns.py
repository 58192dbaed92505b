"""Panels that are told the same refresh one after the other, so that the window is never busy for long."""

from __future__ import annotations

from pytestqt.qtbot import QtBot

from floorcast_app.panels.base import TURN, Panel, catch_up
from tests.app.pump import make_workbench


class Counting(Panel):
    """Notes each refresh."""

    def __init__(self, name: str, seen: list[str]) -> None:
        super().__init__(make_workbench())
        self.name, self.seen = name, seen

    def refresh(self) -> None:
        self.seen.append(self.name)


def panels(qtbot: QtBot, seen: list[str], count: int) -> list[Counting]:
    made = [Counting(str(k), seen) for k in range(count)]
    for panel in made:
        qtbot.addWidget(panel)
    return made


def test_each_has_its_turn(qtbot: QtBot) -> None:
    catch_up()  # panels of other tests
    seen: list[str] = []
    made = panels(qtbot, seen, 3)
    for panel in made:
        panel.refresh_soon()
    assert [p._soon.interval() for p in made] == [0, TURN, 2 * TURN]
    made[0].refresh_soon()  # told again before its turn: it keeps it
    qtbot.waitUntil(lambda: len(seen) == 3)
    assert seen == ["0", "1", "2"]


def test_nobody_waits_for_those_who_are_done(qtbot: QtBot) -> None:
    catch_up()
    seen: list[str] = []
    first, second = panels(qtbot, seen, 2)
    first.refresh_soon()
    qtbot.waitUntil(lambda: seen == ["0"])
    second.refresh_soon()
    assert second._soon.interval() == 0


def test_a_script_waits_for_nobody(qtbot: QtBot) -> None:
    catch_up()
    seen: list[str] = []
    made = panels(qtbot, seen, 4)
    for panel in made:
        panel.refresh_soon()
    catch_up()
    assert sorted(seen) == ["0", "1", "2", "3"]
    qtbot.wait(5 * TURN)
    assert len(seen) == 4
