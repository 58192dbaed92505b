"""E57 files of chosen fields, by the library's lowest level."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pye57 import libe57
from scipy.spatial.transform import Rotation

Field = tuple[Callable[[Any], Any], np.ndarray]  # makes the node of the prototype; (N,) what is written


def write_fields(path: Path, fields: Mapping[str, Field]) -> Path:
    """One scan with the given fields."""
    return write_scans(path, [(fields, None)])


def write_scans(path: Path, scans: Sequence[tuple[Mapping[str, Field], np.ndarray | None]]) -> Path:
    """Scans of given fields, each with its (4, 4) pose in the file or with none."""
    imf = libe57.ImageFile(str(path), "w")
    imf.extensionsAdd("", libe57.E57_V1_0_URI)
    root = imf.root()
    root.set("formatName", libe57.StringNode(imf, "ASTM E57 3D Imaging Data File"))
    root.set("guid", libe57.StringNode(imf, "{x}"))
    root.set("versionMajor", libe57.IntegerNode(imf, 1))
    root.set("versionMinor", libe57.IntegerNode(imf, 0))
    data = libe57.VectorNode(imf, True)
    root.set("data3D", data)
    for number, (fields, pose) in enumerate(scans):
        _add_scan(imf, data, f"{{y{number}}}", fields, pose)
    imf.close()
    return path


def _add_scan(
    imf: libe57.ImageFile,
    data: libe57.VectorNode,
    name: str,
    fields: Mapping[str, Field],
    pose: np.ndarray | None,
) -> None:
    scan = libe57.StructureNode(imf)
    scan.set("guid", libe57.StringNode(imf, name))
    if pose is not None:
        quaternion = np.roll(Rotation.from_matrix(pose[:3, :3]).as_quat(), 1)
        parts = {
            "rotation": zip("wxyz", quaternion, strict=True),
            "translation": zip("xyz", pose[:3, 3], strict=True),
        }
        placed = libe57.StructureNode(imf)
        for part, numbers in parts.items():
            node = libe57.StructureNode(imf)
            for axis, value in numbers:
                node.set(axis, libe57.FloatNode(imf, float(value)))
            placed.set(part, node)
        scan.set("pose", placed)
    prototype = libe57.StructureNode(imf)
    buffers = libe57.VectorSourceDestBuffer()
    for field, (make, column) in fields.items():
        prototype.set(field, make(imf))
        buffers.append(libe57.SourceDestBuffer(imf, field, column, len(column), True, True))
    node = libe57.CompressedVectorNode(imf, prototype, libe57.VectorNode(imf, True))
    scan.set("points", node)
    data.append(scan)
    writer = node.writer(buffers)
    writer.write(len(column))
    writer.close()
