"""The command palette: type some letters, press Enter. All actions, and all settings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import Parameter, signature
from typing import TYPE_CHECKING

from PySide6.QtCore import QEvent, QObject, QRect, QSize, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence, QPainter
from PySide6.QtWidgets import (
    QFrame,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from floorcast_app import theme
from floorcast_app.actions.registry import Action
from floorcast_app.dialogs.fuzzy import score
from floorcast_app.icons import icon
from floorcast_app.panels.base import GRID, column
from floorcast_app.panels.setting_fields import setting_stages
from floorcast_app.translation import tr, tr_action
from floorcast_app.workbench import Workbench

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

SIZE = QSize(560, 380)  # px
ROW_HEIGHT = 34  # px
MOST = 60
DETAIL_ROLE = int(Qt.ItemDataRole.UserRole)
MENU_WORDS = {
    "file": "File",
    "edit": "Edit",
    "view": "View",
    "plan": "Plan",
    "tool": "Tools",
    "correct": "Correct",
    "measure": "Measure",
    "help": "Help",
}
MENU_ICONS = {"file": "file", "view": "eye", "measure": "ruler"}  # of actions that have none of their own


@dataclass(frozen=True)
class Command:
    """One line of the palette."""

    text: str  # "File: Open…"
    detail: str  # at the right: a shortcut, or where a setting stands
    icon: str
    run: Callable[[], object]
    id: str


def commands(workbench: Workbench) -> list[Command]:
    """Everything that can be done now without further arguments, and every setting."""
    ready = [
        a for a in workbench.actions if a.enabled(workbench) and _needs_nothing(a) and a.id != "help.palette"
    ]
    out = [_of_action(workbench, action) for action in ready]
    for stage in setting_stages():
        for field in stage.fields:
            text = tr("Setting: {stage}: {name}").format(stage=tr(stage.title), name=tr(field.title))
            out.append(Command(text, "", "sliders-horizontal", _asker(workbench, field.name), field.name))
    return out


def found(all_commands: list[Command], typed: str) -> list[Command]:
    """Those that fit what was typed, the best first; settings only where something was typed."""
    if not typed.strip():
        return [c for c in all_commands if c.icon != "sliders-horizontal"]
    scored = [(score(typed, c.text), i, c) for i, c in enumerate(all_commands)]
    fitting = [(-s, i, c) for s, i, c in scored if s is not None]
    return [c for _, _, c in sorted(fitting, key=lambda entry: entry[:2])][:MOST]


class Palette(QFrame):
    """A popup over the window."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Popup)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("palette")
        self._commands = commands(workbench)
        self._shown: list[Command] = []
        self.line = QLineEdit()
        self.line.setPlaceholderText(tr("Type a command or a setting"))
        self.list = QListWidget()
        self.list.setUniformItemSizes(True)
        self.list.setItemDelegate(_TwoSided(self.list))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        layout = column(self, GRID, GRID)
        layout.addWidget(self.line)
        layout.addWidget(self.list)
        self.resize(SIZE)
        self.line.textChanged.connect(self._search)
        self.line.returnPressed.connect(self.run_current)
        self.line.installEventFilter(self)
        self.list.itemClicked.connect(lambda _: self.run_current())
        self._search("")
        self.line.setFocus()

    def run_current(self) -> None:
        """Do what is chosen, after the palette is gone."""
        at = self.list.currentRow()
        if 0 <= at < len(self._shown):
            command = self._shown[at]
            self.close()
            command.run()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            steps = {Qt.Key.Key_Down: 1, Qt.Key.Key_Up: -1, Qt.Key.Key_PageDown: 8, Qt.Key.Key_PageUp: -8}
            if event.key() in steps:
                at = self.list.currentRow() + steps[Qt.Key(event.key())]
                self.list.setCurrentRow(min(max(at, 0), self.list.count() - 1))
                return True
        return super().eventFilter(watched, event)

    def _search(self, typed: str) -> None:
        self._shown = found(self._commands, typed)
        self.list.clear()
        for command in self._shown:
            item = QListWidgetItem(icon(command.icon, theme.colours().muted), command.text)
            item.setData(DETAIL_ROLE, command.detail)
            item.setSizeHint(QSize(0, ROW_HEIGHT))
            self.list.addItem(item)
        self.list.setCurrentRow(0)


class _TwoSided(QStyledItemDelegate):
    """Text at the left, a shortcut at the right."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: object) -> None:
        super().paint(painter, option, index)  # type: ignore[arg-type]
        detail = index.data(DETAIL_ROLE)  # type: ignore[attr-defined]
        if detail:
            chosen = bool(option.state & QStyle.StateFlag.State_Selected)  # type: ignore[attr-defined]
            painter.save()
            painter.setPen(theme.colours().text if chosen else theme.colours().muted)
            rect: QRect = option.rect.adjusted(0, 0, -12, 0)  # type: ignore[attr-defined]
            painter.drawText(rect, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, detail)
            painter.restore()


def show(window: MainWindow) -> Palette:
    """Open the palette near the top of the window."""
    palette = Palette(window.workbench, window)
    corner = window.mapToGlobal(window.rect().topLeft())
    palette.move(corner.x() + (window.width() - palette.width()) // 2, corner.y() + window.height() // 8)
    palette.show()
    palette.line.setFocus()
    return palette


def _of_action(workbench: Workbench, action: Action) -> Command:
    text, _ = tr_action(action)
    menu = action.id.partition(".")[0]
    first = action.shortcut.split(" | ")[0]
    keys = QKeySequence(first).toString(QKeySequence.SequenceFormat.NativeText)
    title = f"{tr(MENU_WORDS[menu])}: {text.rstrip('…')}"
    drawn = action.icon or MENU_ICONS.get(menu, "chevron-right")
    return Command(title, keys, drawn, lambda: workbench.try_run(action.id), action.id)


def _asker(workbench: Workbench, name: str) -> Callable[[], object]:
    return lambda: workbench.setting_asked.emit(name)


def _needs_nothing(action: Action) -> bool:
    """True where the action can be run with no argument but the workbench."""
    parameters = list(signature(action.run).parameters.values())[1:]
    return all(p.default is not Parameter.empty for p in parameters)
