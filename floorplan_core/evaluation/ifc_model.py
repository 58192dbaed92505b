"""An IFC model (``.ifc``) as ground truth: spaces, doors, windows and walls of its storeys.

Needs ``ifcopenshell``, an optional dependency (LGPL, used as it comes). The result has the form that
:mod:`floorplan_core.evaluation.ifc_truth` reads: metres, in axes along the walls of the model.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import InputError

Float = NDArray[np.float64]
Bounds = tuple[float, float, float, float]

LEVEL = 0.02  # m, a floor's triangles lie this near to the lowest point of the space
FLAT = 0.99  # cosine: a triangle that faces straight down
UPRIGHT = 0.01  # cosine: a face whose normal lies this level
STRAIGHT = 1e-4  # radians of yaw below which the model's own axes are those of the building


@dataclass(frozen=True)
class Product:
    """An element of the model with its body: a triangle mesh in metres, in the axes of the model."""

    element: Any
    vertices: Float  # (V, 3)
    faces: NDArray[np.int64]  # (F, 3)


def read_ifc(path: Path) -> dict[str, Any]:
    """The document of an IFC file; :class:`InputError` where it is none or ifcopenshell is missing.

    Keys ``spaces``, ``doors``, ``windows``, ``walls`` as in ``gt_ifc.json``, and ``yaw_deg``: the angle of
    the building's x axis in the model.
    """
    model = _open(path)
    try:
        return _document(model)
    except RuntimeError as error:  # what ifcopenshell raises for geometry that it cannot make
        raise InputError(f"The model {path.name} has a body that cannot be made: {error}.") from error
    except (AttributeError, TypeError, ValueError, IndexError, KeyError) as error:
        raise InputError(
            f"The model {path.name} is damaged: something that it refers to is missing or of another kind."
        ) from error


def _open(path: Path) -> Any:
    try:
        import ifcopenshell
    except ImportError:
        needs = f"Reading the IFC model {path.name} needs"
        raise InputError(
            f"{needs} the Python version of Floorcast, not this program: pip install 'floorcast[ifc]'."
            if getattr(sys, "frozen", False)
            else f"{needs} the package ifcopenshell: pip install 'floorcast[ifc]'."
        ) from None
    try:
        return ifcopenshell.open(str(path))
    except (OSError, RuntimeError, ifcopenshell.Error) as error:
        raise InputError(f"{path.name} is no IFC model: {str(error).splitlines()[0]}.") from error


def _document(model: Any) -> dict[str, Any]:
    walls = list(_products(model, "IfcWall"))
    yaw = _yaw(walls)
    turn = _rotation(-yaw)
    return {
        "yaw_deg": float(np.degrees(yaw)),
        "spaces": [_space(p, turn) for p in _products(model, "IfcSpace")],
        "doors": [_opening(p, turn, model) for p in _products(model, "IfcDoor")],
        "windows": [_opening(p, turn, model) for p in _products(model, "IfcWindow")],
        "walls": [{**_named(p.element), "bbox": _box(p, turn)} for p in walls],
    }


def _products(model: Any, kind: str) -> Iterator[Product]:
    """The elements of a kind that have a body, in the order of the file."""
    import ifcopenshell.geom

    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    for element in model.by_type(kind):
        if element.Representation is None:
            continue
        shape = ifcopenshell.geom.create_shape(settings, element)
        vertices = np.array(shape.geometry.verts, dtype=np.float64).reshape(-1, 3)
        faces = np.array(shape.geometry.faces, dtype=np.int64).reshape(-1, 3)
        if len(faces):
            yield Product(element, vertices, faces)


def _yaw(walls: list[Product]) -> float:
    """Angle of the walls to the axes of the model, -45 to 45 degrees: mean of their upright faces."""
    total = 0j
    for wall in walls:
        a, b, c = np.moveaxis(wall.vertices[wall.faces], 1, 0)
        normal = np.cross(b - a, c - a)  # as long as twice the face's area
        upright = normal[np.abs(normal[:, 2]) < UPRIGHT * np.linalg.norm(normal, axis=1)]
        areas = np.hypot(upright[:, 0], upright[:, 1])
        total += complex(np.sum(areas * np.exp(4j * np.arctan2(upright[:, 1], upright[:, 0]))))
    yaw = float(np.angle(total)) / 4 if total else 0.0
    return 0.0 if abs(yaw) < STRAIGHT else yaw


def _rotation(angle: float) -> Float:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _space(product: Product, turn: Float) -> dict[str, Any]:
    element, vertices = product.element, product.vertices @ turn.T
    outline = _floor(vertices, product.faces)
    return {
        **_named(element),
        "long_name": element.LongName or "",
        "z": [float(vertices[:, 2].min()), float(vertices[:, 2].max())],
        "polygon": np.round(np.array(outline.exterior.coords)[:-1], 6).tolist(),
        "holes": [np.round(np.array(ring.coords)[:-1], 6).tolist() for ring in outline.interiors],
    }


def _floor(vertices: Float, faces: NDArray[np.int64]) -> Any:
    """The outline of the lowest level faces; of all faces seen from above where the floor is not level."""
    import shapely

    triangles = vertices[faces]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.maximum(np.linalg.norm(normals, axis=1), 1e-12)
    level = np.abs(normals[:, 2]) > FLAT * lengths
    low = triangles[:, :, 2].max(axis=1) < vertices[:, 2].min() + LEVEL
    chosen = triangles[level & low] if (level & low).any() else triangles
    rings = np.concatenate([chosen, chosen[:, :1]], axis=1)[:, :, :2]
    shape = shapely.union_all(shapely.make_valid(shapely.polygons(rings)))
    parts = [p for p in shapely.get_parts(shape) if p.geom_type == "Polygon"]
    if not parts:
        raise RuntimeError("a space without any floor")
    return max(parts, key=lambda part: part.area).simplify(1e-6)


def _opening(product: Product, turn: Float, model: Any) -> dict[str, Any]:
    """A door or window: its bounding box, and the width that the model states, or that of the box."""
    from ifcopenshell.util.unit import calculate_unit_scale

    low, high = _box(product, turn)
    stated = product.element.OverallWidth
    box_width = max(high[0] - low[0], high[1] - low[1])
    width = float(stated) * calculate_unit_scale(model) if stated else box_width
    return {**_named(product.element), "bbox": [low, high], "overall_width": min(width, box_width)}


def _box(product: Product, turn: Float) -> list[list[float]]:
    vertices = product.vertices @ turn.T
    return [np.round(vertices.min(axis=0), 6).tolist(), np.round(vertices.max(axis=0), 6).tolist()]


def _named(element: Any) -> dict[str, Any]:
    """Name and storey of an element; a storey without a name goes by its number in the file."""
    from ifcopenshell.util.element import get_aggregate, get_container

    home = get_container(element) or get_aggregate(element)
    while home is not None and not home.is_a("IfcBuildingStorey"):
        home = get_aggregate(home)
    storey = "" if home is None else home.Name or f"#{home.id()}"
    return {"name": element.Name or f"#{element.id()}", "storey": storey}
