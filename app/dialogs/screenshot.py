"""A picture of one pane at any resolution: chosen, looked at, copied or saved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QImage, QPixmap
from PySide6.QtWidgets import QCheckBox, QComboBox, QFormLayout, QLabel, QSpinBox, QWidget

from floorcast_app.dialogs.base import Dialog
from floorcast_app.panels.base import GRID, row
from floorcast_app.panes import PANES
from floorcast_app.translation import tr
from floorplan_core.errors import FloorPlanError

if TYPE_CHECKING:
    from floorcast_app.main_window import MainWindow

PICTURED = ("floor_plan", "planes", "free_space", "space", "evidence", "window")
PLANS = ("floor_plan", "planes", "free_space")  # panes with a scale bar
SIZES = (  # pixels, and what they are good for
    (1600, 1200, "Page"),
    (1920, 1080, "Screen"),
    (3840, 2160, "Large screen"),
    (4961, 3508, "A3 at 300 dpi"),
)
PREVIEW = QSize(440, 300)  # px
DELAY = 200  # ms after the last change until the preview is drawn
SMALLEST, LARGEST = 64, 16384  # pixels a side


class Screenshot(Dialog):
    """The preview is drawn small; the picture itself only when it is asked for."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(tr("Picture of a pane"), window)
        self._window = window
        self.pane, self.size_box = QComboBox(), QComboBox()
        titles = {p.id: tr(p.title) for p in PANES} | {"window": tr("Whole window")}
        for id in PICTURED:
            self.pane.addItem(titles[id], id)
        for width, height, use in SIZES:
            self.size_box.addItem(f"{tr(use)} · {width} × {height}", (width, height))
        self.size_box.addItem(tr("Own size"), None)
        self.width_box, self.height_box = self._pixels(), self._pixels()
        self.bar = QCheckBox(tr("Scale bar"))
        self.bar.setChecked(window.workbench.view.look.scale_bar)
        self.preview = QLabel()
        self.preview.setFixedSize(PREVIEW)
        self.preview.setAlignment(Qt.AlignmentFlag.AlignCenter)
        form = QFormLayout()
        form.setSpacing(GRID)
        form.addRow(tr("Pane"), self.pane)
        form.addRow(tr("Size"), self.size_box)
        form.addRow("", row_widget(self.width_box, QLabel("×"), self.height_box))
        form.addRow("", self.bar)
        self.body.addWidget(self.preview)
        self.body.addLayout(form)
        self.save = self.add_button(tr("Save…"), primary=True)
        self.copy = self.add_button(tr("Copy"))
        self.add_close(tr("Close"))
        self._soon = QTimer(self)
        self._soon.setSingleShot(True)
        self._soon.timeout.connect(self.draw_preview)
        self._connect()
        self._size_chosen()
        self.draw_preview()

    def picture(self) -> QImage:
        """The picture as it is asked for."""
        size = self.width_box.value(), self.height_box.value()
        return self._window.picture(self.pane.currentData(), *size, self.bar.isChecked())

    def draw_preview(self) -> None:
        """The same picture, small."""
        width, height = self.width_box.value(), self.height_box.value()
        share = min(PREVIEW.width() / width, PREVIEW.height() / height)
        id = self.pane.currentData()
        try:
            image = (
                self._window.picture(id, width, height) if id == "window" else self._small(id, width, height)
            )
        except FloorPlanError as error:
            self.preview.setText(str(error))
            return
        share *= self.devicePixelRatioF()
        size = QSize(max(1, round(width * share)), max(1, round(height * share)))
        smooth = Qt.TransformationMode.SmoothTransformation
        small = QPixmap.fromImage(image.scaled(size, Qt.AspectRatioMode.KeepAspectRatio, smooth))
        small.setDevicePixelRatio(self.devicePixelRatioF())
        self.preview.setPixmap(small)

    # ---- inside -----------------------------------------------------------------------------------------

    def _small(self, id: str, width: int, height: int) -> QImage:
        """Twice the preview's size: lines and letters look as they will."""
        share = min(1.0, 2 * PREVIEW.width() / width, 2 * PREVIEW.height() / height)
        size = round(width * share), round(height * share)
        return self._window.picture(id, *size, self.bar.isChecked())

    def _pixels(self) -> QSpinBox:
        box = QSpinBox()
        box.setRange(SMALLEST, LARGEST)
        box.setSingleStep(100)
        box.setSuffix(" px")
        box.setKeyboardTracking(False)
        box.setAlignment(Qt.AlignmentFlag.AlignRight)
        return box

    def _connect(self) -> None:
        self.pane.activated.connect(lambda _: self._pane_chosen())
        self.bar.toggled.connect(lambda _: self._soon.start(0))
        self.size_box.activated.connect(lambda _: self._size_chosen())
        for box in (self.width_box, self.height_box):
            box.valueChanged.connect(self._typed)
        self.copy.clicked.connect(self._copy)
        self.save.clicked.connect(self._save)

    def _pane_chosen(self) -> None:
        self.bar.setEnabled(self.pane.currentData() in PLANS)
        self._soon.start(0)

    def _size_chosen(self) -> None:
        size = self.size_box.currentData()
        if size is not None:
            for box, pixels in zip((self.width_box, self.height_box), size, strict=True):
                box.blockSignals(True)
                box.setValue(pixels)
                box.blockSignals(False)
            self._soon.start(DELAY)

    def _typed(self) -> None:
        self.size_box.setCurrentIndex(len(SIZES))
        self._soon.start(DELAY)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setImage(self.picture())
        self._window.tell(tr("The picture is in the clipboard."))

    def _save(self) -> None:
        workbench = self._window.workbench
        suggested = f"{self.pane.currentData()}.png"
        path = workbench.ui.ask_save(tr("Save the picture"), "PNG (*.png);;JPEG (*.jpg)", suggested)
        if path is not None:
            self._write(Path(path))

    def _write(self, path: Path) -> None:
        width, height = self.width_box.value(), self.height_box.value()
        target = path if path.suffix else path.with_suffix(".png")
        arguments = {"path": target, "pane": self.pane.currentData(), "width": width, "height": height}
        if self.bar.isEnabled():
            arguments["scale_bar"] = self.bar.isChecked()
        self._window.workbench.try_run("file.picture", **arguments)


def row_widget(*widgets: QWidget) -> QWidget:
    """Widgets beside each other as one."""
    holder = QWidget()
    line = row(*widgets)
    line.addStretch(1)
    holder.setLayout(line)
    return holder


def show(window: MainWindow) -> Screenshot:
    """Open the dialog."""
    dialog = Screenshot(window)
    dialog.open_over(window)
    return dialog
