"""How the records of the scans of an E57 file are stored: its description (XML) for :mod:`_e57_packets`.

Only what is certain is given; a scan that is described in any other way is left to libE57.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from xml.etree import ElementTree

from floorcast_plugins._e57_packets import Field, Records

NAMESPACE = "{http://www.astm.org/COMMIT/E57/2010-e57-v1.0}"
LEAVES = ("Float", "Integer", "ScaledInteger", "String")
LEAST, MOST = -(1 << 63), (1 << 63) - 1  # of an integer whose bounds are not given
MAX_FIELDS = 200


def stored_records(xml: bytes) -> list[Records | None]:
    """One for each scan of the file, in its order; None for those that libE57 must read."""
    try:
        root = ElementTree.fromstring(xml)
    except ElementTree.ParseError:
        return []
    return [_records(scan) for scan in root.iterfind(f"{NAMESPACE}data3D/{NAMESPACE}vectorChild")]


def _records(scan: ElementTree.Element) -> Records | None:
    points = scan.find(f"{NAMESPACE}points")
    prototype = None if points is None else points.find(f"{NAMESPACE}prototype")
    if points is None or prototype is None or not 0 < len(prototype) <= MAX_FIELDS:
        return None
    if any(leaf.get("type") not in LEAVES or len(leaf) for leaf in prototype):
        return None
    try:
        place, count = int(points.get("fileOffset", "-1")), int(points.get("recordCount", "-1"))
        fields = dict(_fields(prototype))
    except ValueError:
        return None
    if place < 0 or count < 0:
        return None
    return Records(place, count, len(prototype), fields)


def _fields(prototype: ElementTree.Element) -> Iterator[tuple[str, Field]]:
    """The numbers among the fields by name; those of extensions keep their namespace."""
    for stream, leaf in enumerate(prototype):
        name, kind = leaf.tag.removeprefix(NAMESPACE), leaf.get("type")
        if kind == "Float":
            size = 4 if leaf.get("precision", "double") == "single" else 8
            yield name, Field(stream, size, 8 * size)
        elif kind != "String":
            low, high = int(leaf.get("minimum", LEAST)), int(leaf.get("maximum", MOST))
            scale, offset = float(leaf.get("scale", "1")), float(leaf.get("offset", "0"))
            if not (LEAST <= low <= high <= MOST and math.isfinite(scale) and math.isfinite(offset)):
                raise ValueError(name)
            yield name, Field(stream, 0, (high - low).bit_length(), low, scale, offset)
