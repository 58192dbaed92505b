"""The plan into a file: its format, and of formats with words in them the title, units and language."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QComboBox, QFormLayout, QLineEdit

from floorcast_app.dialogs.base import Dialog
from floorcast_app.panels.base import GRID, label
from floorcast_app.translation import LANGUAGES, tr
from floorplan_core.errors import UsageError

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

UNITS = (("metric", "Metres"), ("imperial", "Feet and inches"))
OF_WINDOW = {"m": "metric", "ft-in": "imperial"}  # units of the window, and those of drawings
WIDTH = 440  # px


class ExportDialog(Dialog):
    """Begins with the units and the language of the window."""

    def __init__(self, window: MainWindow, suffix: str) -> None:
        from floorplan_core.plugins import default_registry

        super().__init__(tr("Export the plan"), window)
        self._workbench = window.workbench
        self._exporters = default_registry().exporters
        self.format, self.units, self.language = QComboBox(), QComboBox(), QComboBox()
        for exporter in self._exporters:
            self.format.addItem(f"{exporter.name} · {exporter.suffixes[0]}", exporter.suffixes[0])
        for value, text in UNITS:
            self.units.addItem(tr(text), value)
        for value, text in LANGUAGES.items():
            self.language.addItem(text, value)
        self.title = QLineEdit()
        self.title.setPlaceholderText(window.workbench.plan.source if window.workbench.plan else "")
        self.about, self.note = label("", "small", wrap=True), label("", "small", wrap=True)
        self._fill()
        self.save = self.add_button(tr("Export…"), primary=True)
        self.add_close(tr("Cancel"))
        self.setMinimumWidth(WIDTH)
        self.format.setCurrentIndex(max(self.format.findData(suffix), 0))
        self.units.setCurrentIndex(self.units.findData(OF_WINDOW[self._workbench.view.look.units]))
        self.language.setCurrentIndex(max(self.language.findData(QLocale().name()[:2]), 0))
        self.format.currentIndexChanged.connect(lambda _: self._chosen())
        self.save.clicked.connect(self.export)
        self._chosen()

    def export(self) -> None:
        """Ask for the file, and write it."""
        suffix = self.format.currentData()
        plan = self._workbench.plan
        if plan is None:
            return
        name = f"{Path(plan.source).stem}{suffix}"
        path = self._workbench.ui.ask_save("Export the plan", "export", name)
        if path is None:
            return
        style = {"units": self.units.currentData(), "language": self.language.currentData()}
        if title := self.title.text().strip():
            style["title"] = title
        self._workbench.try_run("file.export", path=path, **style)
        self.accept()

    # ---- inside -----------------------------------------------------------------------------------------

    def _fill(self) -> None:
        form = QFormLayout()
        form.setSpacing(GRID)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Format"), self.format)
        form.addRow("", self.about)
        form.addRow(tr("Title"), self.title)
        form.addRow(tr("Lengths"), self.units)
        form.addRow(tr("Language"), self.language)
        form.addRow("", self.note)
        self.body.addLayout(form)
        for words in (self.about, self.note):
            words.ensurePolished()
            words.setMinimumHeight(2 * words.fontMetrics().lineSpacing())

    def _chosen(self) -> None:
        exporter = self._exporters[self.format.currentIndex()]
        styled = getattr(exporter, "has_style", False)
        self.about.setText(tr(exporter.description))
        self.note.setText(
            tr("Lengths, areas and words as the drawing writes them.")
            if styled
            else tr("This format has metres and English words for every reader.")
        )
        for box in (self.title, self.units, self.language):
            box.setEnabled(styled)


def show(window: MainWindow, suffix: str = ".svg") -> ExportDialog:
    """Open the dialog with a format; :class:`UsageError` where nobody is there to answer."""
    if window.unattended:
        raise UsageError("Export the plan: give the path as an argument; a script has nobody to ask.")
    dialog = ExportDialog(window, suffix)
    if dialog.units.isEnabled():
        dialog.open_over(window)
    else:  # nothing to choose: on to the name of the file
        dialog.export()
        dialog.deleteLater()
    return dialog
