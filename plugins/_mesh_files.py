"""Which mesh a file is, whether its header can be true, and its triangles through trimesh."""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

import numpy as np

from floorplan_core.api import (
    SCAN_ID_NAMES,
    FloorPlanError,
    InputError,
    PlyHeader,
    damaged,
    find_name,
    import_library,
    parse_ply_header,
)

STL_HEAD, STL_RECORD = 84, 50  # bytes
MAX_JSON = 256 << 20  # bytes of a glTF scene's description
MAX_BESIDE = 4 << 30  # bytes of a glTF buffer in a file of its own
MAX_FILLED = 1 << 24  # values of an accessor without data of its own, which would be filled with zeros
MAX_PLY_HEADER = 1 << 20
PACKINGS = {"KHR_draco_mesh_compression": "Draco", "EXT_meshopt_compression": "meshopt"}
OBJ_LINE = re.compile(rb"^(?:#|(?:v|vn|vt|vp|f|l|p|o|g|s|mtllib|usemtl)(?:\s|$))")
OFF_LINE = re.compile(rb"^(?:ST|C|N|4|n)*OFF\b")


def mesh_kind(path: Path, head: bytes) -> str:
    """ "ply", "stl", "glb", "gltf", "off", "obj", or "" for what is no mesh."""
    if head.startswith(b"glTF"):
        return "glb"
    if head[:4] in (b"ply\n", b"ply\r"):
        return "ply" if _ply_has_faces(head) else ""
    if OFF_LINE.match(head):
        return "off"
    if _is_stl(path, head):
        return "stl"
    if head.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{") and b'"asset"' in head and b'"meshes"' in head:
        return "gltf"
    if path.suffix.lower() == ".gltf" and head.lstrip().startswith(b"{"):
        return "gltf"
    return "obj" if _is_obj(path, head) else ""


def check_mesh(path: Path, kind: str) -> None:
    """:class:`InputError` where the header promises more than the file can hold."""
    size = path.stat().st_size
    if kind == "ply":
        _check_ply(path, size)
    elif kind == "stl":
        with path.open("rb") as handle:
            head = handle.read(STL_HEAD)
        count = struct.unpack("<I", head[80:84])[0] if len(head) == STL_HEAD else 0
        if not is_text_stl(head) and STL_HEAD + STL_RECORD * count > size:
            raise InputError(
                f"{path.name} is truncated: its header promises {count:,} triangles, "
                f"{max(0, size - STL_HEAD) // STL_RECORD:,} of them exist."
            )
    elif kind in ("glb", "gltf"):
        _check_gltf(path, _gltf_tree(path, kind))


def load_triangles(path: Path, kind: str) -> list[tuple[Any, Any]]:
    """Each part of the scene: (V, 3) float64 vertices in the scene's frame and (F, 3) faces.

    F is 0 for clouds of points. Parts that occur in several places come once for each.
    """
    trimesh = import_library("trimesh", "trimesh", "meshes")
    with path.open("rb") as handle, damaged(path.name, f"{kind.upper()} mesh"):
        handle.seek(3 if handle.read(3) == b"\xef\xbb\xbf" else 0)
        scene = trimesh.load_scene(
            handle, file_type=kind, resolver=_Beside(path.parent), process=False, skip_materials=True
        )
        return [part for node in sorted(scene.graph.nodes_geometry) for part in _placed(scene, node)]


def _placed(scene: Any, node: str) -> Iterator[tuple[Any, Any]]:
    """The geometry of one node, moved to where it stands."""
    T, name = scene.graph[node]
    geometry = scene.geometry[name]
    if not hasattr(geometry, "vertices"):
        return
    with np.errstate(over="ignore", invalid="ignore"):
        vertices = np.asarray(geometry.vertices, dtype=np.float64).reshape(-1, 3) @ T[:3, :3].T + T[:3, 3]
    faces = np.asarray(getattr(geometry, "faces", np.empty((0, 3))), dtype=np.int64).reshape(-1, 3)
    if len(faces) and not (faces.min() >= 0 and faces.max() < len(vertices)):
        raise ValueError(f"a triangle refers to corner {int(faces.max())} of {len(vertices)}")
    yield vertices, faces


class _Beside(Mapping[str, bytes]):
    """Files that a scene refers to: only those in its own folder or below."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def __getitem__(self, uri: str) -> bytes:
        if "%" in uri and not (self._folder / PurePosixPath(uri).name).is_file():
            uri = unquote(uri)  # glTF writes spaces and letters beyond ASCII as %20 and the like
        parts = PurePosixPath(uri)
        if parts.is_absolute() or ".." in parts.parts or ":" in uri or "\\" in uri:
            raise InputError(f"The scene refers to {uri[:60]!r} outside its own folder, which is refused.")
        path = self._folder / parts
        if not path.resolve().is_relative_to(self._folder.resolve()) or not path.is_file():
            raise InputError(f"The scene needs the file {uri[:60]!r} beside it, which is not there.")
        if path.stat().st_size > MAX_BESIDE:
            raise InputError(
                f"The file {uri[:60]!r} beside the scene is too large ({path.stat().st_size:,} bytes)."
            )
        return path.read_bytes()

    def get(self, uri: str, default: Any = None) -> Any:  # the name that trimesh's resolvers have
        return self[uri]

    def __iter__(self) -> Iterator[str]:
        return iter(())

    def __len__(self) -> int:
        return 0


def _ply_has_faces(head: bytes) -> bool:
    """True for a mesh; a few triangles among many points, or points with scan ids, are a cloud's."""
    faces, corners = (
        int(match.group(1))
        if (match := re.search(rb"^element\s+%s\s+([0-9]{1,18})" % name, head, re.M))
        else 0
        for name in (b"face", b"vertex")
    )
    if faces == 0 or 2 * 3 * faces < corners:  # most corners are of no triangle and would be lost
        return False
    names = re.findall(rb"^property\s+\w+\s+(\w+)\s*$", head, re.MULTILINE)
    return find_name([name.decode("latin-1") for name in names], SCAN_ID_NAMES) is None


def _check_ply(path: Path, size: int) -> None:
    with path.open("rb") as handle:
        header: PlyHeader = parse_ply_header(handle.read(MAX_PLY_HEADER), path.name)
    least = 0
    for element in header.elements:
        widths = [np.dtype(p.count_type or p.type).itemsize for p in element.properties]
        least += element.count * (sum(widths) if header.byte_order else 2 * len(widths))
    if least > size - header.size + 1:  # the last line of a text may lack its end
        raise InputError(
            f"{path.name} is truncated: its header promises at least {least:,} bytes of elements, "
            f"{size - header.size:,} follow it."
        )


def is_text_stl(head: bytes) -> bool:
    """True for the first word of a text STL; some programs write it in capitals."""
    return head.lstrip()[:5].lower() == b"solid"


def _is_stl(path: Path, head: bytes) -> bool:
    if is_text_stl(head) and re.search(rb"\bfacet\s+normal\b", head, re.IGNORECASE):
        return True
    if len(head) < STL_HEAD or b"\x00" not in head:
        return False
    count = struct.unpack("<I", head[80:84])[0]
    size = path.stat().st_size
    exact = size == STL_HEAD + STL_RECORD * count and count > 0
    return exact or path.suffix.lower() == ".stl"


def _is_obj(path: Path, head: bytes) -> bool:
    """Most lines begin with the words of the format, and some are corners (or comments, in an ``.obj``)."""
    if b"\x00" in head:
        return False
    text = re.sub(rb"\\\r?\n", b" ", head)  # a line may go on in the next
    lines = [line.strip() for line in text.splitlines()[:-1] if line.strip()]
    corners = [line for line in lines if re.match(rb"^v\s+[-+.0-9]", line)]
    known = sum(bool(OBJ_LINE.match(line)) for line in lines)
    begins = len(corners) >= 1 or (bool(lines) and path.suffix.lower() == ".obj")
    return begins and known >= 0.9 * len(lines)


def _gltf_tree(path: Path, kind: str) -> dict[str, Any]:
    """The JSON of a scene."""
    with path.open("rb") as handle:
        length = path.stat().st_size
        if kind == "glb":
            head = handle.read(20)
            total, length = struct.unpack_from("<II", head, 8) if len(head) == 20 else (0, 0)
            if total > path.stat().st_size or length > total or length == 0:
                raise InputError(
                    f"{path.name} is truncated or damaged: its glTF header says {total:,} bytes."
                )
        if length > MAX_JSON:
            raise InputError(
                f"The description of the glTF scene {path.name} is too large ({length:,} bytes)."
            )
        text = handle.read(length)
    try:
        tree = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path.name} is damaged: the description of its glTF scene is no JSON.") from error
    if not isinstance(tree, dict):
        raise InputError(f"{path.name} is damaged: the description of its glTF scene is no object.")
    return tree


def _check_gltf(path: Path, tree: dict[str, Any]) -> None:
    """No arrays that would be made of nothing; nodes form a tree, so that nothing multiplies."""
    try:
        packed = set(tree.get("extensionsRequired", [])) & PACKINGS.keys()
        empty = [int(a["count"]) for a in tree.get("accessors", []) if "bufferView" not in a]
        children = [child for node in tree.get("nodes", []) for child in node.get("children", [])]
        meshes = tree.get("meshes", [])
        if not meshes or not all(mesh["primitives"] for mesh in meshes):
            raise InputError(f"{path.name} is a glTF scene without meshes.")
        twice = len(set(children)) != len(children)
    except FloorPlanError:
        raise
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(f"{path.name} is damaged: its glTF scene is not as the format says.") from error
    if packed:
        raise InputError(
            f"The meshes of {path.name} are compressed by {PACKINGS[min(packed)]}, which is not read; "
            "save the scene without mesh compression."
        )
    if sum(empty) > MAX_FILLED or min(empty, default=0) < 0:
        raise InputError(f"{path.name} is damaged: its glTF scene has {sum(empty):,} values without data.")
    if twice:
        raise InputError(f"{path.name} is damaged: a node of its glTF scene has two parents.")
