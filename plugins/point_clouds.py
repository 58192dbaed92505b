"""Readers that ship: PLY, PCD, text, NPZ and folders of scans."""

from floorplan_core.api import Reader, hookimpl


@hookimpl
def floorcast_readers() -> list[Reader]:
    from floorplan_core.readers import NpzReader, PcdReader, PlyReader, ScanFolderReader, TextReader

    return [PlyReader(), PcdReader(), TextReader(), NpzReader(), ScanFolderReader()]
