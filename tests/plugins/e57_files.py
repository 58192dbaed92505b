"""E57 files of chosen fields, by the library's lowest level."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pye57 import libe57

Field = tuple[Callable[[Any], Any], np.ndarray]  # makes the node of the prototype; (N,) what is written


def write_fields(path: Path, fields: Mapping[str, Field]) -> Path:
    """One scan with the given fields."""
    imf = libe57.ImageFile(str(path), "w")
    imf.extensionsAdd("", libe57.E57_V1_0_URI)
    root = imf.root()
    root.set("formatName", libe57.StringNode(imf, "ASTM E57 3D Imaging Data File"))
    root.set("guid", libe57.StringNode(imf, "{x}"))
    root.set("versionMajor", libe57.IntegerNode(imf, 1))
    root.set("versionMinor", libe57.IntegerNode(imf, 0))
    data = libe57.VectorNode(imf, True)
    root.set("data3D", data)
    scan = libe57.StructureNode(imf)
    scan.set("guid", libe57.StringNode(imf, "{y}"))
    prototype = libe57.StructureNode(imf)
    buffers = libe57.VectorSourceDestBuffer()
    for name, (make, column) in fields.items():
        prototype.set(name, make(imf))
        buffers.append(libe57.SourceDestBuffer(imf, name, column, len(column), True, True))
    node = libe57.CompressedVectorNode(imf, prototype, libe57.VectorNode(imf, True))
    scan.set("points", node)
    data.append(scan)
    writer = node.writer(buffers)
    writer.write(len(column))
    writer.close()
    imf.close()
    return path
