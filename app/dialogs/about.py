"""What this is, which version, and whose work is in it under which licence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QAbstractItemView,
    QLabel,
    QPlainTextEdit,
    QSplitter,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from floorcast_app import icons, theme
from floorcast_app.dialogs.base import Dialog
from floorcast_app.dialogs.licences import Work, works
from floorcast_app.panels.base import GRID, column, label, row
from floorcast_app.translation import tr
from floorplan_core import __version__

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

PAPER = "Predictive and Semantic Layout Estimation for Robotic Applications in Manhattan Worlds"

SIZES = [440, 580]  # px of the list and of the text, in which most licences keep their lines
WIDTHS = (168, 108)  # px of the columns


class About(Dialog):
    """The list of licences fills the dialog; the one chosen can be read."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(tr("About Floorcast"), parent)
        mark = QLabel()
        mark.setPixmap(icons.pixmap("layout-panel-left", 40, theme.colours().accent))
        words = QWidget()
        lines = column(words, 0, 4)
        lines.addWidget(label("Floorcast", "title"))
        lines.addWidget(
            label(tr("Version {version} · Apache License 2.0").format(version=__version__), "muted")
        )
        top = row(mark, words, gap=2 * GRID)
        top.addStretch(1)
        self.body.addLayout(top)
        story = tr(
            "Floor plans with what was not seen, after the paper “{title}” by Shariati, Pfrommer and Taylor."
        )
        self.body.addWidget(label(story.format(title=PAPER), "", True))
        self.body.addWidget(label(tr("Made with"), "section"))
        self.works = works()
        self.list = self._list()
        self.text = QPlainTextEdit()
        self.text.setReadOnly(True)
        self.text.setProperty("role", "small")
        split = QSplitter(Qt.Orientation.Horizontal)
        split.addWidget(self.list)
        split.addWidget(self.text)
        split.setSizes(SIZES)
        split.setMinimumSize(QSize(sum(SIZES), 380))
        self.body.addWidget(split, 1)
        self.add_close(tr("Close"))
        self.list.setCurrentItem(self.list.topLevelItem(0))

    def _list(self) -> QTreeWidget:
        made = QTreeWidget()
        made.setRootIsDecorated(False)
        made.setAlternatingRowColors(True)
        made.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        made.setHeaderLabels([tr("Package"), tr("Version"), tr("Licence")])
        made.addTopLevelItems([QTreeWidgetItem([w.name, w.version, w.licence]) for w in self.works])
        for at, width in enumerate(WIDTHS):
            made.setColumnWidth(at, width)
        made.currentItemChanged.connect(lambda item, _: self._show(made.indexOfTopLevelItem(item)))
        return made

    def _show(self, at: int) -> None:
        if 0 <= at < len(self.works):
            self.text.setPlainText(_shown(self.works[at]))


def _shown(work: Work) -> str:
    return work.text() or tr("The package brings no text of its licence ({licence}).").format(
        licence=work.licence
    )


def show(window: MainWindow) -> About:
    """Open the box."""
    box = About(window)
    box.open_over(window)
    return box
