"""A small IFC model, written with ifcopenshell: two storeys, two rooms a door and a window below."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

WALL, HEIGHT, STOREY = 0.2, 2.6, 3.0
DOOR = (4.0, 1.5, 0.9)  # x of its wall's middle, y of its middle, width
ROOMS = {"A": (0.1, 0.1, 3.9, 2.9), "B": (4.1, 0.1, 7.9, 2.9)}
WALLS = ((0, 0, 8, 0), (0, 3, 8, 3), (0, 0, 0, 3), (8, 0, 8, 3), (4, 0, 4, 3))


class Model:
    """Boxes as products of an IFC4 model, turned by ``yaw``, in units of ``unit`` metres."""

    def __init__(self, yaw_deg: float = 0.0, prefix: str | None = None) -> None:
        import ifcopenshell.api.aggregate
        import ifcopenshell.api.context
        import ifcopenshell.api.project
        import ifcopenshell.api.root
        import ifcopenshell.api.unit

        api = ifcopenshell.api
        self.api, self.yaw = api, np.radians(yaw_deg)
        self.per_metre = {None: 1.0, "MILLI": 1000.0}[prefix]
        self.file = api.project.create_file()
        project = api.root.create_entity(self.file, ifc_class="IfcProject", name="house")
        length = api.unit.add_si_unit(self.file, unit_type="LENGTHUNIT", prefix=prefix)
        api.unit.assign_unit(self.file, units=[length])
        context = api.context.add_context(self.file, context_type="Model")
        self.body = api.context.add_context(
            self.file,
            context_type="Model",
            context_identifier="Body",
            target_view="MODEL_VIEW",
            parent=context,
        )
        building = api.root.create_entity(self.file, ifc_class="IfcBuilding", name="B")
        api.aggregate.assign_object(self.file, products=[building], relating_object=project)
        self.storeys = [
            api.root.create_entity(self.file, ifc_class="IfcBuildingStorey", name=name)
            for name in ("Ground", "Upper")
        ]
        api.aggregate.assign_object(self.file, products=self.storeys, relating_object=building)

    def box(self, kind: str, name: str, low: Any, high: Any, storey: int = 0, **values: Any) -> None:
        """One product whose body is an axis-parallel box of the building, metres."""

        low, high = np.array(low, dtype=float), np.array(high, dtype=float)
        product = self.api.root.create_entity(self.file, ifc_class=kind, name=name)
        for key, value in values.items():
            setattr(product, key, value)
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        place = np.eye(4)
        place[:2, :2] = [[c, -s], [s, c]]
        place[:3, 3] = place[:3, :3] @ (low + np.array([0, 0, STOREY * storey]))
        self.api.geometry.edit_object_placement(self.file, product=product, matrix=place, is_si=True)
        corners = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        body = self.api.geometry.add_mesh_representation(
            self.file,
            context=self.body,
            vertices=[(np.array(corners) * (high - low)).tolist()],
            faces=[sides],
        )
        self.api.geometry.assign_representation(self.file, product=product, representation=body)
        home = self.storeys[storey]
        if kind == "IfcSpace":
            self.api.aggregate.assign_object(self.file, products=[product], relating_object=home)
        else:
            self.api.spatial.assign_container(self.file, products=[product], relating_structure=home)


def write_house(path: Path, yaw_deg: float = 0.0, prefix: str | None = None) -> Path:
    """Two rooms below, one above."""
    model = Model(yaw_deg, prefix)
    half = WALL / 2
    for number, (x0, y0, x1, y1) in enumerate(WALLS):
        model.box("IfcWall", f"w{number}", (x0 - half, y0 - half, 0), (x1 + half, y1 + half, HEIGHT))
    for name, (x0, y0, x1, y1) in ROOMS.items():
        long_name = "Corridor" if name == "B" else "Office"
        model.box("IfcSpace", name, (x0, y0, 0), (x1, y1, HEIGHT), LongName=long_name)
    model.box("IfcSpace", "C", (0.1, 0.1, 0), (7.9, 2.9, HEIGHT), storey=1)
    x, y, width = DOOR
    wide = width * model.per_metre
    low, high = (x - half, y - width / 2 - 0.05, 0), (x + half, y + width / 2 + 0.05, 2.1)
    model.box("IfcDoor", "d", low, high, OverallWidth=wide)  # the frame is 5 cm wider on both sides
    model.box("IfcWindow", "f", (1.0, -half, 0.9), (2.0, half, 2.0))
    model.file.write(str(path))
    return path
