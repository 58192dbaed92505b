"""The same scene in Open3D's own viewer, in a process of its own: the window stays free, a crash stays there.

Open3D's legacy viewer is used: it needs OpenGL 3 only and runs on software drivers, too. It knows no
translucency, so planes are drawn from the side on which they were seen; from behind one looks through them.
"""

from __future__ import annotations

import multiprocessing
import os
import shutil
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from floorcast_app.colours import THEMES
from floorcast_app.rendering import ramps
from floorcast_app.rendering.cloud import facing_colours, storey_height
from floorcast_app.rendering.cloud_loader import CloudMaker, Wanted
from floorcast_app.rendering.scene import DOOR_HEIGHT
from floorcast_app.rendering.shapes import on_wall, outline, quad, raised, triangles_of
from floorplan_core.errors import UsageError
from floorplan_core.model import Door, FloorPlan, LayoutPlane, Region
from floorplan_core.model.layout import turned

if TYPE_CHECKING:
    from floorcast_app.workbench import Workbench

Float = NDArray[np.float64]

MOST_POINTS = 3_000_000  # of the cloud that are handed over
SLAB = 0.12  # metres below the floor to which regions are extruded
THINNEST_DOOR = 0.04  # metres
PROUD = 0.01  # metres by which doors stand out of their walls, so that the two do not flicker
POINT_SIZE = 2.0  # pixels
TITLE = "Floorcast in Open3D"
NO_OPENGL = 3  # exit status of the viewer's process
_FILE = "scene.npz"


@dataclass(frozen=True)
class Part:
    """Points (``index`` has no rows), lines (two columns) or triangles (three) with a colour each vertex."""

    vertices: Float  # (N, 3) metres, scene frame
    index: NDArray[np.int32]  # (K, 0), (K, 2) or (K, 3) rows of vertices
    colours: Float  # (N, 3) 0 to 1


def open_in_open3d(workbench: Workbench) -> None:
    """Show the plan and its points in Open3D's viewer.

    :raises UsageError: without a plan, or where there is no display.
    """
    from floorcast_app.rendering.cloud import plan_origin

    plan, session = workbench.plan, workbench.session
    if plan is None:
        raise UsageError("There is no plan to show in Open3D yet; open a survey first.")
    if not has_display():
        raise UsageError(
            "Open3D's viewer needs a display with OpenGL, and there is none here; the 3D pane shows the same."
        )
    origin = plan_origin(plan, None if session is None else session.reconstruction.local_frame)
    look = workbench.view.look
    wanted = Wanted(workbench.points, plan, look.point_colour, "light", origin)

    def start() -> None:
        loaded = CloudMaker().load(wanted)
        xyz, colours = loaded.cloud.xyz[:MOST_POINTS], loaded.paint.colours[:MOST_POINTS]
        keep = slice(None) if look.ceiling_cut is None else xyz[:, 2] <= look.ceiling_cut
        parts = [_cloud_part(xyz[keep], colours[keep]), *plan_parts(plan, look.ceiling_cut)]
        status = _view(parts)
        if status:
            workbench.post(lambda: workbench.ui.tell(_failure(status), "error"))

    threading.Thread(target=start, name="Open3D viewer", daemon=True).start()


def plan_parts(plan: FloorPlan, cut: float | None = None) -> tuple[Part, ...]:
    """Planes, regions (slabs with the edges of their rooms) and doors; ``cut`` metres high at most."""
    height = storey_height(plan) if cut is None else max(min(storey_height(plan), cut), SLAB)
    made = [
        *(_plane_part(plane, height) for plane in plan.all_planes),
        *(part for region in plan.regions for part in _region_parts(region, height)),
        *(_door_part(door, height) for door in plan.doors),
    ]
    return tuple(part for part in made if len(part.vertices))


def geometry_of(part: Part) -> Any:
    """The Open3D geometry of a part: PointCloud, LineSet or TriangleMesh."""
    from floorplan_core.open3d_import import load_open3d

    o3d = load_open3d()
    vertices, colours = (o3d.utility.Vector3dVector(a) for a in (part.vertices, part.colours))
    if part.index.shape[1] == 0:
        cloud = o3d.geometry.PointCloud(vertices)
        cloud.colors = colours
        return cloud
    if part.index.shape[1] == 2:
        lines = o3d.geometry.LineSet(vertices, o3d.utility.Vector2iVector(part.index))
        lines.colors = o3d.utility.Vector3dVector(part.colours[part.index[:, 0]])
        return lines
    mesh = o3d.geometry.TriangleMesh(vertices, o3d.utility.Vector3iVector(part.index))
    mesh.vertex_colors = colours
    mesh.compute_vertex_normals()
    return mesh


def has_display() -> bool:
    """True where windows can be shown at all."""
    if sys.platform.startswith("linux"):
        return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
    return True


# ---- parts ------------------------------------------------------------------------------------------------


def _cloud_part(xyz: NDArray[np.floating[Any]], colours: NDArray[np.uint32]) -> Part:
    return Part(np.asarray(xyz, dtype=np.float64), np.zeros((0, 0), dtype=np.int32), _unit(colours))


def _plane_part(plane: LayoutPlane, height: float) -> Part:
    """Upright rectangles that look into the free space."""
    runs = plane.walls if len(plane.walls) else plane.observed
    lines = [turned(on_wall(plane.facing.axis, plane.offset, run), plane.turn) for run in runs]
    made = [_facing(quad(line, 0.0, height), plane) for line in lines]
    return _mesh(_stacked(made), int(facing_colours("light")[plane.facing]))


def _facing(triangles: Float, plane: LayoutPlane) -> Float:
    """The triangles with their corners in the order that makes them look along the plane's normal."""
    a, b, c = triangles[0]
    normal = turned(np.cross(b - a, c - a)[None, :2], -plane.turn)[0]
    return triangles if normal[plane.facing.axis] * plane.facing.sign > 0 else triangles[:, ::-1]


def _region_parts(region: Region, height: float) -> tuple[Part, ...]:
    """The floor as a slab, and the edges of the room above it."""
    fill = THEMES["light"].region(region.label)
    colour, ink = ramps.packed(fill), ramps.shifted(fill, -0.3)
    floor, edges = triangles_of(region.polygon, 0.0), outline(region.polygon, 0.0)
    up = np.cross(floor[:, 1] - floor[:, 0], floor[:, 2] - floor[:, 0])[:, 2] > 0
    floor = np.where(up[:, None, None], floor, floor[:, ::-1])
    below = floor[:, ::-1] - [0.0, 0.0, SLAB]
    sides = np.concatenate([quad(edge[:, :2], -SLAB, 0.0) for edge in edges])
    upper = edges + np.array([0.0, 0.0, height])
    posts = np.stack([edges[:, 0], upper[:, 0]], axis=1)
    return (
        _mesh(np.concatenate([floor, below, sides, sides[:, ::-1]]), colour),
        _lines(np.concatenate([edges, upper, posts]), ink),
    )


def _door_part(door: Door, height: float) -> Part:
    """A box in the wall, seen from everywhere."""
    top = min(door.height or DOOR_HEIGHT, height)
    half = np.zeros(2)
    half[door.axis] = max(door.thickness, THINNEST_DOOR) / 2 + PROUD
    half = door.in_plan(half[None])[0]
    near, far = (door.line() + side for side in (-half, half))
    jambs = [quad(np.array([near[k], far[k]]), 0.0, top) for k in (0, 1)]
    corners = raised(np.array([near[0], near[1], far[1], far[0]]), top)
    lid = np.array([corners[[0, 1, 2]], corners[[0, 2, 3]]])
    faces = np.concatenate([quad(near, 0.0, top), quad(far, 0.0, top), *jambs, lid])
    return _mesh(np.concatenate([faces, faces[:, ::-1]]), ramps.packed(THEMES["light"].door))


def _mesh(triangles: Float, colour: int) -> Part:
    index = np.arange(3 * len(triangles), dtype=np.int32).reshape(-1, 3)
    return _one_colour(triangles.reshape(-1, 3), index, colour)


def _lines(ends: Float, colour: int) -> Part:
    index = np.arange(2 * len(ends), dtype=np.int32).reshape(-1, 2)
    return _one_colour(ends.reshape(-1, 3), index, colour)


def _one_colour(vertices: Float, index: NDArray[np.int32], colour: int) -> Part:
    return Part(vertices, index, np.repeat(_unit(np.array([colour], dtype=np.uint32)), len(vertices), axis=0))


def _stacked(triangles: list[Float]) -> Float:
    return np.concatenate(triangles) if triangles else np.zeros((0, 3, 3))


def _unit(colours: NDArray[np.uint32]) -> Float:
    """(N, 3) 0 to 1."""
    return np.stack([(colours >> shift) & 255 for shift in (16, 8, 0)], axis=1) / 255.0


# ---- the viewer's process ---------------------------------------------------------------------------------


def save_parts(parts: list[Part], path: Path) -> None:
    """Write parts for the viewer's process."""
    arrays = {}
    for k, part in enumerate(parts):
        arrays |= {f"vertices{k}": part.vertices, f"index{k}": part.index, f"colours{k}": part.colours}
    np.savez(path, **arrays)  # type: ignore[arg-type]


def load_parts(path: Path) -> list[Part]:
    """Read what :func:`save_parts` wrote."""
    with np.load(path) as data:
        count = len(data.files) // 3
        return [Part(data[f"vertices{k}"], data[f"index{k}"], data[f"colours{k}"]) for k in range(count)]


def _view(parts: list[Part]) -> int:
    """Run the viewer until its window is closed; the exit status of its process."""
    folder = Path(tempfile.mkdtemp(prefix="floorcast-"))
    try:
        save_parts(parts, folder / _FILE)
        process = multiprocessing.get_context("spawn").Process(
            target=show_file, args=(str(folder / _FILE),), daemon=True
        )
        process.start()
        process.join()
        return process.exitcode or 0
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def show_file(path: str) -> None:
    """What the viewer's process does: a window with the scene, until it is closed."""
    from floorplan_core.open3d_import import load_open3d

    o3d = load_open3d()
    o3d.utility.set_verbosity_level(o3d.utility.VerbosityLevel.Error)
    geometries = [geometry_of(part) for part in load_parts(Path(path))]
    shutil.rmtree(Path(path).parent, ignore_errors=True)  # here, too: the window may be closed before us
    viewer = o3d.visualization.Visualizer()
    if not viewer.create_window(TITLE, 1280, 800):
        sys.exit(NO_OPENGL)
    for geometry in geometries:
        viewer.add_geometry(geometry)
    viewer.get_render_option().point_size = POINT_SIZE
    control = viewer.get_view_control()
    control.set_front([0.45, -0.65, 0.6])
    control.set_up([0.0, 0.0, 1.0])
    control.set_zoom(0.7)
    viewer.run()
    viewer.destroy_window()


def _failure(status: int) -> str:
    if status == NO_OPENGL:
        return "Open3D's viewer found no OpenGL on this display; the 3D pane shows the same."
    return f"Open3D's viewer ended with status {status}; its driver for OpenGL may be the cause."
