"""The lists: order, filter, marks, and a selection shared both ways."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow, QWidget
from pytestqt.qtbot import QtBot

from floorcast_app.panels.filter_field import SMALL, WIDE
from floorcast_app.panels.item_columns import COLUMNS, natural
from floorcast_app.panels.item_model import EYE, ITEM_ROLE, LOCK, OWN, ItemModel
from floorcast_app.panels.items_panel import DoorList, ItemTable, ListPanel, PlaneList, RegionList
from floorcast_app.panels.warnings_panel import WarningsPanel
from floorcast_app.selection import Item
from floorcast_app.workbench import Workbench
from tests.app.pump import settle

LEFT = Qt.MouseButton.LeftButton


def shown(make: type[ListPanel], workbench: Workbench, qtbot: QtBot) -> ListPanel:
    made = make(workbench)
    qtbot.addWidget(made)
    made.resize(900, 400)
    made.show()
    qtbot.waitUntil(lambda: not made.table.stale)  # lists are filled when they are seen
    return made


@pytest.fixture
def regions(planned: Workbench, qtbot: QtBot) -> ListPanel:
    return shown(RegionList, planned, qtbot)


@pytest.fixture
def doors(planned: Workbench, qtbot: QtBot) -> ListPanel:
    return shown(DoorList, planned, qtbot)


@pytest.fixture
def planes(planned: Workbench, qtbot: QtBot) -> ListPanel:
    return shown(PlaneList, planned, qtbot)


@pytest.fixture
def docked(planned: Workbench, qtbot: QtBot) -> QMainWindow:
    """A window with the three lists and another pane as tabs, the regions in front."""
    window = QMainWindow()
    qtbot.addWidget(window)
    panels = [RegionList(planned), DoorList(planned), PlaneList(planned), WarningsPanel(planned)]
    docks = []
    for panel in panels:
        dock = QDockWidget("", window)
        dock.setWidget(panel)
        dock.visibilityChanged.connect(getattr(panel, "seen", lambda _: None))
        window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, dock)
        if docks:
            window.tabifyDockWidget(docks[-1], dock)
        docks.append(dock)
        panel.refresh()
    docks[0].raise_()
    window.resize(900, 400)
    window.show()
    qtbot.waitUntil(lambda: in_front(window) == [panels[0]])
    return window


def dock_of(window: QMainWindow, kind: type[QWidget]) -> QDockWidget:
    return next(d for d in window.findChildren(QDockWidget) if isinstance(d.widget(), kind))


def in_front(window: QMainWindow) -> list[QWidget]:
    docks = window.findChildren(QDockWidget)
    return [d.widget() for d in docks if not d.visibleRegion().isEmpty()]


def _texts(table: ItemTable, column: int) -> list[str]:
    model = table.model()
    return [model.index(r, column).data() for r in range(model.rowCount())]


def _middle(table: ItemTable, row: int, column: int) -> QPoint:
    return table.visualRect(table.model().index(row, column)).center()


def test_all_things_of_the_plan_are_listed(regions: ListPanel, doors: ListPanel, planes: ListPanel) -> None:
    plan = regions.workbench.plan
    assert plan is not None
    assert [p.table.model().rowCount() for p in (regions, doors, planes)] == [
        len(plan.regions), len(plan.doors), len(plan.planes)
    ]  # fmt: skip


def test_tabs_say_how_long_the_lists_are(docked: QMainWindow, planned: Workbench) -> None:
    titles = [dock_of(docked, kind).windowTitle() for kind in (RegionList, DoorList, PlaneList)]
    plan = planned.plan
    assert plan is not None
    counts = len(plan.regions), len(plan.doors), len(plan.planes)
    wanted = [f"{t} ({n})" for t, n in zip(("Regions", "Doors", "Planes"), counts, strict=True)]
    assert titles == wanted


def test_names_are_sorted_as_people_count(regions: ListPanel) -> None:
    names = _texts(regions.table, OWN)
    assert names == sorted(names, key=natural)
    assert names.index("2") < names.index("10")


@pytest.mark.parametrize("make", [RegionList, DoorList, PlaneList])
def test_every_column_sorts_by_its_key(make: type[ListPanel], planned: Workbench, qtbot: QtBot) -> None:
    panel = shown(make, planned, qtbot)
    table = panel.table
    for at, column in enumerate(COLUMNS[panel.kind]):
        table.sortByColumn(OWN + at, Qt.SortOrder.DescendingOrder)
        items = [table.model().index(r, OWN).data(256 + 1) for r in range(table.model().rowCount())]
        keys = [column.key(panel.workbench.find(item)) for item in items]
        assert keys == sorted(keys, reverse=True), column.title


def test_a_click_on_a_heading_sorts(regions: ListPanel, qtbot: QtBot) -> None:
    table = regions.table
    header = table.horizontalHeader()
    at = QPoint(header.sectionViewportPosition(OWN + 2) + 20, header.height() // 2)
    qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    qtbot.mouseClick(header.viewport(), LEFT, pos=at)
    areas = [float(t.removesuffix(" m²")) for t in _texts(table, OWN + 2)]
    assert areas in (sorted(areas), sorted(areas, reverse=True))


def test_a_selection_outlives_order_and_filter(regions: ListPanel) -> None:
    table, selection = regions.table, regions.workbench.selection

    def chosen() -> list[Item]:
        return [index.data(ITEM_ROLE) for index in table.selectionModel().selectedRows(OWN)]

    item = table.model().index(3, OWN).data(ITEM_ROLE)
    selection.select(item)
    table.sortByColumn(OWN + 2, Qt.SortOrder.DescendingOrder)
    assert chosen() == [item] and selection.item == item
    regions.search.setText("no such words")
    assert table.model().rowCount() == 0 and selection.item == item
    regions.search.setText("")
    assert chosen() == [item]
    selection.select(None)


def test_rows_in_the_order_of_their_eyes_follow_them(regions: ListPanel) -> None:
    table, view = regions.table, regions.workbench.view
    last = table.rows.item(table.model().rowCount() - 1)
    table.sortByColumn(EYE, Qt.SortOrder.DescendingOrder)
    view.set(hidden=frozenset({(last.kind, last.id)}))
    assert table.rows.item(0) == last
    view.set(hidden=frozenset())
    table.sortByColumn(OWN, Qt.SortOrder.AscendingOrder)


def test_numbers_stand_at_the_right(regions: ListPanel) -> None:
    model = regions.table.model()
    alignment = model.index(0, OWN + 2).data(Qt.ItemDataRole.TextAlignmentRole)
    assert Qt.AlignmentFlag(alignment) & Qt.AlignmentFlag.AlignRight


def test_typed_words_filter_the_list(regions: ListPanel, qtbot: QtBot) -> None:
    regions.activateWindow()
    qtbot.keyClick(regions.table, Qt.Key.Key_F, Qt.KeyboardModifier.ControlModifier)
    regions.search.setFocus()
    qtbot.keyClicks(regions.search, "corr")
    kinds = _texts(regions.table, OWN + 1)
    assert kinds and set(kinds) == {"corridor"}
    qtbot.keyClick(regions.search, Qt.Key.Key_Escape)
    assert regions.workbench.plan is not None and regions.search.text() == ""
    assert regions.table.model().rowCount() == len(regions.workbench.plan.regions)


def test_the_filter_takes_the_room_that_there_is(regions: ListPanel, qtbot: QtBot) -> None:
    header, search = regions.table.horizontalHeader(), regions.search
    regions.resize(1300, 400)
    qtbot.waitUntil(lambda: search.width() == WIDE)
    right = search.mapTo(regions, search.rect().topRight()).x()
    assert header.width() - right < 20
    regions.resize(500, 400)
    qtbot.waitUntil(lambda: search.width() == SMALL)
    qtbot.keyClicks(search, "room")  # typed into: it is spelt out over the titles
    assert search.width() > 100
    search.clear()
    assert regions.rect().contains(search.geometry().translated(search.parentWidget().pos()))


def test_a_click_selects_everywhere_and_ctrl_adds(regions: ListPanel, qtbot: QtBot) -> None:
    table, selection = regions.table, regions.workbench.selection
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    first = table.model().index(1, OWN).data(256 + 1)
    assert selection.items == (first,)
    qtbot.mouseClick(table.viewport(), LEFT, Qt.KeyboardModifier.ControlModifier, _middle(table, 3, OWN))
    assert set(selection.items) == {first, table.model().index(3, OWN).data(256 + 1)}
    assert selection.item == table.model().index(3, OWN).data(256 + 1)


def test_keys_walk_through_the_list(regions: ListPanel, qtbot: QtBot) -> None:
    table = regions.table
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, OWN))
    qtbot.keyClick(table, Qt.Key.Key_Down)
    assert regions.workbench.selection.item == table.model().index(1, OWN).data(256 + 1)


def test_what_is_selected_elsewhere_is_brought_to_the_front(docked: QMainWindow, planned: Workbench) -> None:
    plan = planned.plan
    assert plan is not None
    wall = plan.planes[-1].id
    planned.selection.select(Item("plane", wall))
    (front,) = in_front(docked)
    assert isinstance(front, PlaneList)
    table = front.table
    chosen = table.selectionModel().selectedRows(OWN)
    assert [i.data() for i in chosen] == [wall]
    assert table.viewport().rect().intersects(table.visualRect(chosen[0]))
    planned.selection.select(None)
    assert not table.selectionModel().hasSelection()


def test_a_selection_does_not_hide_what_is_read(
    docked: QMainWindow, planned: Workbench, qtbot: QtBot
) -> None:
    assert planned.plan is not None
    last = dock_of(docked, WarningsPanel)
    last.raise_()
    qtbot.waitUntil(lambda: in_front(docked) == [last.widget()])
    planned.selection.select(Item("door", planned.plan.doors[0].id))
    assert in_front(docked) == [last.widget()]


def test_a_list_behind_is_filled_when_it_comes_forward(
    docked: QMainWindow, planned: Workbench, qtbot: QtBot
) -> None:
    dock = dock_of(docked, DoorList)
    panel = dock.widget()
    assert isinstance(panel, DoorList) and panel.table.stale
    dock.raise_()
    qtbot.waitUntil(lambda: not panel.table.stale)
    assert planned.plan is not None and panel.table.model().rowCount() == len(planned.plan.doors)


def test_the_pointer_lights_up_what_it_is_over(regions: ListPanel, qtbot: QtBot) -> None:
    table = regions.table
    qtbot.mouseMove(table.viewport(), _middle(table, 2, OWN))
    qtbot.waitUntil(lambda: regions.workbench.selection.hovered == table.model().index(2, OWN).data(256 + 1))


def test_a_double_click_asks_to_bring_it_into_view(regions: ListPanel, qtbot: QtBot) -> None:
    asked: list[Item] = []
    regions.workbench.selection.zoom_asked.connect(asked.append)
    table = regions.table
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    qtbot.mouseDClick(table.viewport(), LEFT, pos=_middle(table, 1, OWN))
    regions.workbench.selection.zoom_asked.disconnect(asked.append)
    assert asked == [table.model().index(1, OWN).data(256 + 1)]


def test_the_eye_hides_one_thing(regions: ListPanel, qtbot: QtBot) -> None:
    table = regions.table
    item = table.model().index(0, OWN).data(256 + 1)
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, EYE))
    assert regions.workbench.view.look.hidden == {(item.kind, item.id)}
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, EYE))
    assert regions.workbench.view.look.hidden == frozenset()


def test_the_lock_keeps_a_door_and_lets_it_go(doors: ListPanel, qtbot: QtBot) -> None:
    workbench, table = doors.workbench, doors.table
    item = table.model().index(0, OWN).data(256 + 1)
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, LOCK))
    settle(workbench)
    assert workbench.find(item).by_hand == "accepted"
    qtbot.waitUntil(lambda: table.model().index(0, LOCK).data(256) is True)
    model = doors.table.rows
    pinned = model.index(model.row_of(item), OWN)
    assert pinned.data(Qt.ItemDataRole.DecorationRole) is not None
    tip = pinned.data(Qt.ItemDataRole.ToolTipRole)
    assert "Accepted by hand" in tip and "The machine had said" in tip
    qtbot.mouseClick(table.viewport(), LEFT, pos=_middle(table, 0, LOCK))
    settle(workbench)
    assert workbench.find(item).by_hand == ""


def test_feet_and_inches_reach_the_cells(regions: ListPanel, qtbot: QtBot) -> None:
    regions.workbench.run("view.units")
    table = regions.table
    qtbot.waitUntil(lambda: "sq ft" in table.model().index(0, OWN + 2).data())


def test_the_context_menu_offers_what_fits(regions: ListPanel, qtbot: QtBot) -> None:
    table = regions.table
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
