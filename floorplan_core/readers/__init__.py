"""Readers: from a file or folder to a :class:`~floorplan_core.model.Reconstruction`."""

from floorplan_core.readers.npz import NpzReader
from floorplan_core.readers.opening import builtin_readers, open_survey
from floorplan_core.readers.pcd import PcdReader
from floorplan_core.readers.ply import PlyReader
from floorplan_core.readers.scans import ScanFolderReader
from floorplan_core.readers.text import TextReader

__all__ = [
    "NpzReader",
    "PcdReader",
    "PlyReader",
    "ScanFolderReader",
    "TextReader",
    "builtin_readers",
    "open_survey",
]
