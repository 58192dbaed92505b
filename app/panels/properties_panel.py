"""The selected thing explains itself: what it is, why it is there, how sure we are, what made it."""

from __future__ import annotations

import re

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from floorcast_app import icons, theme
from floorcast_app.panels.base import GRID, Panel, clear, column, label, scrolling
from floorcast_app.panels.facts import Fact, Portrait, Section, portrait
from floorcast_app.panels.item_menu import fitting
from floorcast_app.translation import tr, tr_action, tr_text
from floorcast_app.workbench import Workbench

MOST_FACTS = 60  # lines: a hall of two hundred sides would stall the window


class PropertiesPanel(Panel):
    """Follows the selection."""

    def __init__(self, workbench: Workbench, parent: QWidget | None = None) -> None:
        super().__init__(workbench, parent)
        self.shown: Portrait | None = None
        self._inner = QWidget()
        self._layout = column(self._inner, 2 * GRID, GRID)
        column(self, 0, 0).addWidget(scrolling(self._inner))
        self.listen(workbench.selection.changed, workbench.plan_changed, workbench.view.changed)
        self.listen(workbench.document.saved_changed, theme.changed)
        self._last: object = ()
        self.refresh()

    def refresh(self) -> None:
        workbench = self.workbench
        items = workbench.selection.items
        self.shown = portrait(workbench, workbench.selection.item, tr_text)
        actions = fitting(workbench, workbench.selection.item)
        now = (self.shown, len(items), [a.id for a in actions], theme.name())
        if now == self._last:
            return
        self._last = now
        clear(self._layout)
        if self.shown is None:
            self._layout.addWidget(label(tr("There is no plan yet."), "muted", wrap=True))
        else:
            self._show(self.shown, len(items))
            self._add_actions([a.id for a in actions])
        self._layout.addStretch(1)
        self._lay_out()

    # ---- parts ------------------------------------------------------------------------------------------

    def _lay_out(self) -> None:
        """At once: Qt would show the lines squeezed into the room of those before them, for a moment."""
        if not self.isVisible():
            return
        for child in self._inner.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly):
            if not child.testAttribute(Qt.WidgetAttribute.WA_WState_ExplicitShowHide):
                child.show()  # the others are those before, on their way out
        self._layout.activate()
        QApplication.sendEvent(self._inner, QEvent(QEvent.Type.LayoutRequest))

    def _show(self, shown: Portrait, selected: int) -> None:
        self._layout.addWidget(label(shown.title, "heading", wrap=True))
        if shown.subtitle:
            self._layout.addWidget(label(shown.subtitle, "small", wrap=True))
        if selected > 1:
            self._layout.addWidget(label(tr("and {n} more").format(n=selected - 1), "small"))
        if shown.chips:
            line = QHBoxLayout()
            line.setSpacing(4)
            for text, role in shown.chips:
                line.addWidget(label(text, role))
            line.addStretch(1)
            self._layout.addLayout(line)
        for section in shown.sections:
            if section.facts:
                self._layout.addWidget(self._section(section))

    def _section(self, section: Section) -> QWidget:
        holder = QFrame()
        layout = QVBoxLayout(holder)
        layout.setContentsMargins(0, GRID, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(label(section.title, "section"))
        grid = QGridLayout()
        grid.setHorizontalSpacing(GRID)
        grid.setVerticalSpacing(4)
        grid.setColumnStretch(1, 1)
        for i, fact in enumerate(section.facts[:MOST_FACTS]):
            self._add_fact(grid, i, fact)
        layout.addLayout(grid)
        return holder

    def _add_fact(self, grid: QGridLayout, at: int, fact: Fact) -> None:
        if not fact.name:
            line = label(f"· {fact.value}", wrap=True)
            grid.addWidget(line, at, 0, 1, 2)
            return
        name = label(fact.name, "muted")
        grid.addWidget(name, at, 0, Qt.AlignmentFlag.AlignTop)
        value = self._value(fact)
        grid.addWidget(value, at, 1, Qt.AlignmentFlag.AlignTop)
        tip = "\n".join(filter(None, (fact.tip, _setting_tip(fact))))
        for widget in (name, value):
            widget.setToolTip(tip)

    def _value(self, fact: Fact) -> QWidget:
        if fact.item is None and not fact.setting:
            plain = QLabel(_unbroken(fact.value))
            plain.setFont(theme.font(figures=fact.value[:1].isdigit() and fact.value.count(" ") < 2))
            return _right(plain)
        link = Link(_unbroken(fact.value))
        if fact.item is not None:
            item = fact.item
            link.clicked.connect(lambda: self.workbench.selection.select(item))
            link.hovered.connect(lambda on: self.workbench.selection.hover(item if on else None))
        else:
            link.plain()
            link.clicked.connect(lambda: self.workbench.setting_asked.emit(fact.setting))
        return _right(link)

    def _add_actions(self, ids: list[str]) -> None:
        if not ids:
            return
        self._layout.addSpacing(GRID)
        self._layout.addWidget(label(tr("Correct"), "section"))
        for id in ids:
            action = self.workbench.actions[id]
            text, tip = tr_action(action)
            button = QToolButton()
            button.setObjectName(id)
            button.setText(text)
            button.setToolTip(tip)
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            if action.icon:
                icons.set_icon(button, action.icon)
            button.clicked.connect(lambda _=False, id=id: self.workbench.try_run(id))
            self._layout.addWidget(button)


class Link(QLabel):
    """A value that leads somewhere."""

    clicked = Signal()
    hovered = Signal(bool)

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setProperty("role", "link")

    def plain(self) -> None:
        """It leads to a setting: it looks like any value until the pointer is over it."""
        self.setProperty("role", "quiet-link")

    def mouseReleaseEvent(self, event: object) -> None:
        self.clicked.emit()

    def enterEvent(self, event: object) -> None:
        self.hovered.emit(True)

    def leaveEvent(self, event: object) -> None:
        self.hovered.emit(False)


def _right(made: QLabel) -> QLabel:
    made.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop)
    made.setWordWrap(True)
    if not isinstance(made, Link):
        made.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return made


def _unbroken(text: str) -> str:
    """A number and its unit stay on one line."""
    return re.sub(r"(?<=\d) (?=[^\W\d]|%)", "\N{NO-BREAK SPACE}", text)


def _setting_tip(fact: Fact) -> str:
    return tr("Setting: {name}").format(name=fact.setting) if fact.setting else ""
