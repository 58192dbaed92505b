"""The lists: order, filter, marks, and a selection shared both ways."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from pytestqt.qtbot import QtBot

from floorcast_app.panels.item_columns import COLUMNS, natural
from floorcast_app.panels.item_model import EYE, LOCK, OWN, ItemModel
from floorcast_app.panels.items_panel import ItemsPanel, ItemTable
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench
from tests.app.pump import settle

LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def panel(planned: Workbench, qtbot: QtBot) -> ItemsPanel:
    made = ItemsPanel(planned)
    qtbot.addWidget(made)
    made.resize(900, 400)
    made.show()
    for kind in ("door", "plane", "region"):  # lists are filled when they are seen
        made.tabs.setCurrentWidget(made.tables[kind])
    return made


def _texts(table: ItemTable, column: int) -> list[str]:
    model = table.model()
    return [model.index(r, column).data() for r in range(model.rowCount())]


def _middle(table: ItemTable, row: int, column: int) -> QPoint:
    return table.visualRect(table.model().index(row, column)).center()


def test_all_things_of_the_plan_are_listed(panel: ItemsPanel) -> None:
    plan = panel.workbench.plan
    assert plan is not None
    counts = {kind: table.model().rowCount() for kind, table in panel.tables.items()}
    assert counts == {"region": len(plan.regions), "door": len(plan.doors), "plane": len(plan.planes)}
    assert panel.tabs.tabText(0) == f"Regions {len(plan.regions)}"


def test_names_are_sorted_as_people_count(panel: ItemsPanel) -> None:
    names = _texts(panel.tables["region"], OWN)
    assert names == sorted(names, key=natural)
    assert names.index("2") < names.index("10")


@pytest.mark.parametrize("kind", ["region", "door", "plane"])
def test_every_column_sorts_by_its_key(panel: ItemsPanel, kind: str) -> None:
    table = panel.tables[kind]
    for at, column in enumerate(COLUMNS[kind]):
        table.sortByColumn(OWN + at, Qt.SortOrder.DescendingOrder)
        items = [table.model().index(r, OWN).data(256 + 1) for r in range(table.model().rowCount())]
        keys = [column.key(panel.workbench.find(item)) for item in items]
        assert keys == sorted(keys, reverse=True), column.title


def test_a_click_on_a_heading_sorts(panel: ItemsPanel, qtbot: QtBot) -> None:
    table = panel.tables["region"]
    header = table.horizontalHeader()
    at = QPoint(header.sectionViewportPosition(OWN + 2) + 20, header.height() // 2)
    qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    areas = [float(t.removesuffix(" m²")) for t in _texts(table, OWN + 2)]
    assert areas in (sorted(areas), sorted(areas, reverse=True))


def test_numbers_stand_at_the_right(panel: ItemsPanel) -> None:
    model = panel.tables["region"].model()
    alignment = model.index(0, OWN + 2).data(Qt.ItemDataRole.TextAlignmentRole)
    assert Qt.AlignmentFlag(alignment) & Qt.AlignmentFlag.AlignRight


def test_typed_words_filter_all_lists(panel: ItemsPanel, qtbot: QtBot) -> None:
    qtbot.keyClicks(panel.search, "corr")
    kinds = _texts(panel.tables["region"], OWN + 1)
    assert kinds and set(kinds) == {"corridor"}
    panel.search.clear()
    assert panel.workbench.plan is not None
    assert panel.tables["region"].model().rowCount() == len(panel.workbench.plan.regions)


def test_a_click_selects_everywhere_and_ctrl_adds(panel: ItemsPanel, qtbot: QtBot) -> None:
    table, selection = panel.tables["region"], panel.workbench.selection
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    first = table.model().index(1, OWN).data(256 + 1)
    assert selection.items == (first,)
    qtbot.mouseClick(table.viewport(), LEFT, Qt.KeyboardModifier.ControlModifier, _middle(table, 3, OWN))
    assert set(selection.items) == {first, table.model().index(3, OWN).data(256 + 1)}
    assert selection.item == table.model().index(3, OWN).data(256 + 1)


def test_keys_walk_through_the_list(panel: ItemsPanel, qtbot: QtBot) -> None:
    table = panel.tables["region"]
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, OWN))
    qtbot.keyClick(table, Qt.Key.Key_Down)
    assert panel.workbench.selection.item == table.model().index(1, OWN).data(256 + 1)


def test_what_is_selected_elsewhere_is_brought_to_the_front(panel: ItemsPanel) -> None:
    plan = panel.workbench.plan
    assert plan is not None
    wall = plan.planes[-1].id
    panel.workbench.selection.select(Item("plane", wall))
    table = panel.tables["plane"]
    assert panel.tabs.currentWidget() is table
    chosen = table.selectionModel().selectedRows(OWN)
    assert [i.data() for i in chosen] == [wall]
    assert table.viewport().rect().intersects(table.visualRect(chosen[0]))
    panel.workbench.selection.select(None)
    assert not table.selectionModel().hasSelection()


def test_the_pointer_lights_up_what_it_is_over(panel: ItemsPanel, qtbot: QtBot) -> None:
    table = panel.tables["region"]
    qtbot.mouseMove(table.viewport(), _middle(table, 2, OWN))
    qtbot.waitUntil(lambda: panel.workbench.selection.hovered == table.model().index(2, OWN).data(256 + 1))


def test_a_double_click_asks_to_bring_it_into_view(panel: ItemsPanel, qtbot: QtBot) -> None:
    asked: list[Item] = []
    panel.workbench.selection.zoom_asked.connect(asked.append)
    table = panel.tables["region"]
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    qtbot.mouseDClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    panel.workbench.selection.zoom_asked.disconnect(asked.append)
    assert asked == [table.model().index(1, OWN).data(256 + 1)]


def test_the_eye_hides_one_thing(panel: ItemsPanel, qtbot: QtBot) -> None:
    table = panel.tables["region"]
    item = table.model().index(0, OWN).data(256 + 1)
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, EYE))
    assert panel.workbench.view.look.hidden == {(item.kind, item.id)}
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, EYE))
    assert panel.workbench.view.look.hidden == frozenset()


def test_the_lock_keeps_a_door_and_lets_it_go(panel: ItemsPanel, qtbot: QtBot) -> None:
    workbench, table = panel.workbench, panel.tables["door"]
    panel.tabs.setCurrentWidget(table)
    item = table.model().index(0, OWN).data(256 + 1)
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, LOCK))
    settle(workbench)
    assert workbench.find(item).by_hand == "accepted"
    qtbot.waitUntil(lambda: table.model().index(0, LOCK).data(256) is True)
    model = panel.tables["door"].rows
    pinned = model.index(model.row_of(item), OWN)
    assert pinned.data(Qt.ItemDataRole.DecorationRole) is not None
    tip = pinned.data(Qt.ItemDataRole.ToolTipRole)
    assert "Accepted by hand" in tip and "The machine had said" in tip
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, LOCK))
    settle(workbench)
    assert workbench.find(item).by_hand == ""


def test_feet_and_inches_reach_the_cells(panel: ItemsPanel, qtbot: QtBot) -> None:
    panel.workbench.run("view.units")
    table = panel.tables["region"]
    qtbot.waitUntil(lambda: "sq ft" in table.model().index(0, OWN + 2).data())


def test_the_context_menu_offers_what_fits(panel: ItemsPanel, qtbot: QtBot) -> None:
    table = panel.tables["region"]
    table.customContextMenuRequested.emit(_middle(table, 0, OWN))
    from PySide6.QtWidgets import QMenu

    menu = table.findChild(QMenu)
    assert menu is not None
    texts = [a.text() for a in menu.actions()]
    assert any("Rename" in t for t in texts) and any("Relabel" in t for t in texts)
    assert not any("door" in t.lower() for t in texts)
    assert not any("Release" in t for t in texts)  # nothing was said of it
    menu.close()


def test_the_model_of_nothing_is_empty(workbench: Workbench, qapp: object) -> None:
    model = ItemModel(workbench, "plane")
    assert model.rowCount() == 0
    assert model.row_of(Item("plane", "p1")) == -1
