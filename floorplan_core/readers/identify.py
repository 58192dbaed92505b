"""What a file is that no reader wants: by its first bytes, so that the message can say it."""

from __future__ import annotations

from pathlib import Path

from floorplan_core.readers.trajectory import looks_like_trajectory

PICKLED = "a pickled Python object, which is refused because reading it could run code"
MAGIC: tuple[tuple[bytes, str], ...] = (
    (b"\xff\xd8\xff", "a JPEG picture, not a point cloud"),
    (b"\x89PNG\r\n", "a PNG picture, not a point cloud"),
    (b"GIF8", "a GIF picture, not a point cloud"),
    (b"II*\x00", "a TIFF picture, not a point cloud"),
    (b"MM\x00*", "a TIFF picture, not a point cloud"),
    (b"BM", "a BMP picture, not a point cloud"),
    (b"%PDF", "a PDF document, not a point cloud"),
    (b"PK\x03\x04", "a ZIP archive without arrays of points; unpack it first"),
    (b"PK\x05\x06", "an empty ZIP archive"),
    (b"\x1f\x8b", "a gzip archive; unpack it first"),
    (b"7z\xbc\xaf", "a 7-Zip archive; unpack it first"),
    (b"Rar!", "a RAR archive; unpack it first"),
    (b"\xfd7zXZ", "an xz archive; unpack it first"),
    (b"BZh", "a bzip2 archive; unpack it first"),
    (b"ASTM-E57", "an E57 file, for which no reader is installed"),
    (b"LASF", "a LAS or LAZ file, for which no reader is installed"),
    (b"#ROSBAG", "a ROS bag, for which no reader is installed"),
    (b"\x89MCAP", "an MCAP recording, for which no reader is installed"),
    (b"# Octomap OcTree", "an OctoMap, for which no reader is installed"),
    (b"glTF", "a glTF scene, for which no reader is installed"),
    (b"ISO-10303-21", "a STEP or IFC model: a truth for the command evaluate, not a survey"),
    (b"\xff\xfe", "text in UTF-16; save it as UTF-8"),
    (b"\xfe\xff", "text in UTF-16; save it as UTF-8"),
    (b"\x28\xb5\x2f\xfd", "a Zstandard archive; unpack it first"),
    (b"version https://git-lfs", "the pointer of Git LFS to a file, not the file; get it with git lfs pull"),
    (b"Kaydara FBX", "an FBX scene; export it as glTF, OBJ or PLY"),
    (b"# vtk DataFile", "a VTK file; export it as PLY or PCD"),
    (b"\x89HDF", "an HDF5 file; export its points as LAS, PLY or NPZ"),
    (b"AC10", "a DWG drawing, not a point cloud"),
    (b"\xd0\xcf\x11\xe0", "a document or a project of another program; export its points as E57 or LAS"),
    (b"{\\rtf", "a text document with formats, not a point cloud; save it as plain text"),
    (b"<svg", "an SVG picture, not a point cloud"),
    (b"solid ", "an STL mesh, for which no reader is installed"),
    (b"OFF", "an OFF mesh, for which no reader is installed"),
    (b"SQLite format 3", "an SQLite database (a ROS 2 bag perhaps), for which no reader is installed"),
    (b"\x7fELF", "a program"),
    (b"MZ", "a program"),
    *((bytes([0x80, n, 0x95]), PICKLED) for n in (4, 5)),
)
BY_SUFFIX = {
    ".rcp": "a project of ReCap, whose format is not open; export it as E57 or PTS",
    ".rcs": "a scan of ReCap, whose format is not open; export it as E57 or PTS",
    ".fls": "a raw scan of FARO, whose format is not open; export it as E57",
    ".dxf": "a DXF drawing, not a point cloud",
    ".bin": "numbers without a header (a scan of KITTI?); name the folder of the scans, with its trajectory",
}
TAR_AT, TAR = 257, b"ustar"
HTML = (b"<!doctype html", b"<html", b"<head", b"<?xml")


def identify(head: bytes, path: Path) -> str:
    """A phrase that follows "X is", or "" where we cannot tell."""
    for magic, phrase in MAGIC:
        if head.startswith(magic):
            return phrase
    if head[TAR_AT:].startswith(TAR):
        return "a tar archive; unpack it first"
    start = head.lstrip(b"\xef\xbb\xbf \t\r\n")[:64].lower()
    if start.startswith(HTML[:3]):
        return "a web page (HTML), not a point cloud: the download probably failed"
    if start.startswith(HTML[3]):
        return "an XML document, not a point cloud"
    if start.startswith((b"{", b"[")) and path.suffix.lower() in (".json", ".geojson"):
        return "a JSON document, not a point cloud"
    if path.is_file() and looks_like_trajectory(path):
        return "a trajectory, not a point cloud; open the cloud and name this file with --trajectory"
    return BY_SUFFIX.get(path.suffix.lower(), "")
