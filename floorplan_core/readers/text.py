"""XYZ, PTS, TXT and CSV text: columns told apart by content, with or without header, count or comments."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from floorplan_core.errors import InputError
from floorplan_core.model import Reconstruction
from floorplan_core.observer import Observer
from floorplan_core.plugins import ReadOptions
from floorplan_core.readers.assemble import assemble
from floorplan_core.readers.fields import SCAN_ID_NAMES, STAMP_NAMES, find_name, find_xyz
from floorplan_core.readers.source import PointSource
from floorplan_core.readers.text_rows import (
    TextLayout,
    text_chunks,
    text_sample,
    text_scan_ids,
)

HEAD_BYTES = 1 << 16
MIN_ROWS = 3  # of the first lines that must be points before a file is called a text cloud
COMMENTS = ("#", "//", "%")
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
MOST_TITLES = 30  # lines of words that may stand above the points of a file that is named like a cloud
COUNT_LINE = re.compile(r"^\s*[0-9]{1,15}\s*$")
UNIT = re.compile(r"[\[(](?:m|mm|cm|ft)[\])]")  # after the name of a column
DECIMAL_COMMA = re.compile(r"^[+-]?\d+,\d+$")


@dataclass(frozen=True)
class TextForm:
    """How a text file is laid out, read from its first lines."""

    names: tuple[str, ...]  # of the columns; () where there is no header line
    columns: int
    separator: str
    decimal_comma: bool
    count: int | None  # of a line with a single number before the points
    offset: int  # bytes before the first row
    titles: int = (
        0  # lines above it that are neither names of columns that we know, nor a count, nor comments
    )


class TextReader:
    """Text with one point a line."""

    name = "XYZ"
    suffixes: tuple[str, ...] = (".xyz", ".pts", ".txt", ".csv", ".asc", ".xyzrgb", ".xyzn")
    description = "Text, one point a line: XYZ, PTS, TXT, CSV"

    def sniff(self, path: Path, head: bytes) -> float:
        """0.6 with one of our suffixes, else 0.3, where the first lines are rows of three numbers or more."""
        form = _form_of(path, head)
        if form is None or path.suffix.lower() == ".tum":
            return 0.0
        return 0.6 if path.suffix.lower() in self.suffixes else 0.3

    def open(self, path: Path, options: ReadOptions, observer: Observer) -> Reconstruction:
        """Open the file; :class:`InputError` where its lines are no points."""
        return assemble(text_source(path), options, observer)


def text_source(path: Path) -> PointSource:
    """The points of a text file."""
    with path.open("rb") as handle:
        form = _form_of(path, handle.read(HEAD_BYTES))
    if form is None:
        raise InputError(f"{path.name} holds no lines of three numbers or more.")
    layout = _layout(path, form)
    notes: tuple[str, ...] = ()
    if form.count is not None:
        notes = (f"{path.name} announces {form.count:,} points; what its lines hold is what counts.",)
    if form.decimal_comma:
        notes = (*notes, f"Commas in {path.name} are decimal commas.")
    if form.titles and not form.names:
        notes = (*notes, f"The first three columns of {path.name} are taken as x, y and z.")
    return PointSource(
        path,
        "XYZ",
        partial(text_chunks, path, layout),
        partial(text_sample, path, layout),
        None,
        layout.scan_id is not None,
        text_scan_ids(path, layout),
        notes=notes,
    )


def _form_of(path: Path, head: bytes) -> TextForm | None:
    """Titles are skipped only where the name says that points follow: a table in any text is no cloud."""
    return read_form(head, MOST_TITLES if path.suffix.lower() in TextReader.suffixes else 0)


def read_form(head: bytes, most_titles: int = 0) -> TextForm | None:
    """The layout of the first lines; None where they are no rows of numbers."""
    if b"\x00" in head:
        return None
    offset = len(BYTE_ORDER_MARK) if head.startswith(BYTE_ORDER_MARK) else 0
    names: tuple[str, ...] = ()
    count: int | None = None
    titles = 0
    lines = _complete_lines(head[offset:])
    for place, line in enumerate(lines):
        if _numbers(line.strip(), names) is not None:
            return _form(lines[place:], names, count, offset, titles)
        words = _header_words(line)
        if find_xyz(words) is not None:
            names = words
        elif COUNT_LINE.match(line):
            count = int(line)
        elif words and not line.lstrip().startswith(COMMENTS):
            titles += 1
            if titles > most_titles:
                return None
        offset += len(line)
    return None


def _form(
    lines: list[str], names: tuple[str, ...], count: int | None, offset: int, titles: int
) -> TextForm | None:
    """The layout where at least half of the lines from the first row on are rows, too."""
    held = [line.strip() for line in lines if line.strip() and not line.lstrip().startswith(COMMENTS)]
    good = [form for form in (_numbers(line, names) for line in held) if form is not None]
    if len(good) < min(MIN_ROWS, len(held)) or 2 * len(good) < len(held):
        return None
    separator, comma, columns = good[0]
    return TextForm(names, columns, separator, comma, count, offset, titles)


def _complete_lines(head: bytes) -> list[str]:
    """Lines with their ends, one character a byte; the last one only where the text is not cut off in it."""
    lines = [line.decode("latin-1") for line in head.splitlines(keepends=True)]
    cut = len(lines) > 1 and not lines[-1].endswith(("\n", "\r"))
    return lines[:-1] if cut else lines


def _numbers(line: str, names: tuple[str, ...] = ()) -> tuple[str, bool, int] | None:
    """(separator, decimal comma?, columns) of a line that begins with three finite numbers; else None.

    Where ``names`` of columns say that x, y and z come later, words may stand before them (names of points).
    """
    if '"' in line:
        if ";" not in line and any("," in quoted for quoted in line.split('"')[1::2]):
            return None  # "1,5","2,5": between quotes a comma is a decimal one, which rows do not tell
        line = line.replace('"', "")
    for separator, comma in _readings(line):
        words = line.replace(separator, " ").split() if separator != " " else line.split()
        if comma:
            words = [word.replace(",", ".") for word in words]
        if len(words) >= 3 and all(map(_is_number, words[:3])):
            return separator, comma, len(words)
        if (xyz := find_xyz(names)) is not None:
            cells = words if separator == " " else line.rstrip(f"{separator} ").split(separator)
            cells = [cell.replace(",", ".") for cell in cells] if comma else cells
            if len(cells) == len(names) and all(_is_number(cells[names.index(name)]) for name in xyz):
                return separator, comma, len(cells)
    return None


def _readings(line: str) -> list[tuple[str, bool]]:
    """Separators and decimal signs that a line allows, the likeliest first."""
    if ";" in line:
        return [(";", "," in line)]
    if "," not in line:
        return [(" ", False)]
    words = line.split()
    commas_are_decimal = len(words) >= 3 and all(DECIMAL_COMMA.match(w) or _is_number(w) for w in words[:3])
    return [(" ", True)] if commas_are_decimal else [(",", False)]


def _is_number(word: str) -> bool:
    try:
        return not math.isnan(float(word)) or word.lower() == "nan"
    except ValueError:
        return False


def _header_words(line: str) -> tuple[str, ...]:
    with suppress(UnicodeDecodeError):  # else it is what Windows writes, and latin-1 is right
        line = line.encode("latin-1").decode("utf-8")
    clean = UNIT.sub("", line).lstrip("#/% ").replace('"', "")
    separator = next((s for s in ";,\t" if s in clean), None)
    return tuple(word.strip() for word in clean.split(separator) if word.strip())


def _layout(path: Path, form: TextForm) -> TextLayout:
    x, y, z, scan_id, stamp = 0, 1, 2, None, None
    if form.names and len(form.names) <= form.columns:
        found = find_xyz(form.names)
        if found is not None:
            x, y, z = (form.names.index(name) for name in found)
        scan_name, stamp_name = find_name(form.names, SCAN_ID_NAMES), find_name(form.names, STAMP_NAMES)
        scan_id = None if scan_name is None else form.names.index(scan_name)
        stamp = None if stamp_name is None else form.names.index(stamp_name)
    return TextLayout(
        form.offset, form.columns, (x, y, z), scan_id, stamp, form.separator, form.decimal_comma
    )
