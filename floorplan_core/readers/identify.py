"""What a file is that no reader wants: by its first bytes, so that the message can say it."""

from __future__ import annotations

from pathlib import Path

from floorplan_core.readers.trajectory import looks_like_trajectory

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
    (b"ISO-10303-21", "a STEP or IFC model, for which no reader is installed"),
    (b"solid ", "an STL mesh, for which no reader is installed"),
    (b"OFF", "an OFF mesh, for which no reader is installed"),
    (b"SQLite format 3", "an SQLite database (a ROS 2 bag perhaps), for which no reader is installed"),
    (b"\x7fELF", "a program"),
    (b"MZ", "a program"),
    (b"\x80\x04\x95", "a pickled Python object, which is refused because reading it could run code"),
)
HTML = (b"<!doctype html", b"<html", b"<head", b"<?xml")


def identify(head: bytes, path: Path) -> str:
    """A phrase that follows "X is", or "" where we cannot tell."""
    for magic, phrase in MAGIC:
        if head.startswith(magic):
            return phrase
    start = head.lstrip(b"\xef\xbb\xbf \t\r\n")[:64].lower()
    if start.startswith(HTML[:3]):
        return "a web page (HTML), not a point cloud: the download probably failed"
    if start.startswith(HTML[3]):
        return "an XML document, not a point cloud"
    if start.startswith((b"{", b"[")) and path.suffix.lower() in (".json", ".geojson"):
        return "a JSON document, not a point cloud"
    if path.is_file() and looks_like_trajectory(path):
        return "a trajectory, not a point cloud; open the cloud and name this file with --trajectory"
    return ""
