"""Meshes: what trimesh writes is sampled evenly, wherever its parts stand and in whatever unit."""

from __future__ import annotations

import json
import struct

import numpy as np
import pytest
import trimesh

from tests.plugins.plugin_files import opened, refusal, survives, whole

SIZE = np.array([8.0, 5.0, 2.6])
AREA = 2 * (8 * 5 + 8 * 2.6 + 5 * 2.6)
KINDS = ("ply", "stl", "obj", "glb", "gltf", "off")


def box(scale=1.0):
    mesh = trimesh.creation.box(extents=SIZE * scale)
    mesh.apply_translation(SIZE * scale / 2)
    return mesh


def write_mesh(path, mesh):
    """With trimesh; glTF comes with a buffer beside it."""
    made = mesh.export(file_type=path.suffix[1:])
    if isinstance(made, dict):
        for name, data in made.items():
            (path if name.endswith(".gltf") else path.parent / name).write_bytes(data)
    else:
        path.write_bytes(made.encode() if isinstance(made, str) else made)
    return path


def on_box(points, size=SIZE):
    """Largest distance of the points from the surface of the box."""
    outside = np.maximum(np.maximum(-points, points - size), 0).max()
    inside = np.minimum(points, size - points).min(axis=1)
    return max(outside, np.abs(inside).max())


@pytest.mark.parametrize("kind", KINDS)
def test_points_lie_evenly_on_the_surface(tmp_path, kind):
    survey = opened(write_mesh(tmp_path / f"a.{kind}", box()))
    points, _ = whole(survey)
    assert survey.format == f"{kind.upper()} mesh"
    assert on_box(points) < 1e-5
    assert len(points) == pytest.approx(AREA / 0.025**2, rel=1e-3)
    assert abs(len(points) - survey.point_count) <= 2
    floor = points[np.abs(points[:, 2]) < 1e-6]
    counts = np.histogram2d(floor[:, 0], floor[:, 1], bins=(32, 20), range=((0, 8), (0, 5)))[0]
    assert counts.min() >= 85  # 100 on average in a cell of 0.25 m
    assert counts.max() <= 115


@pytest.mark.parametrize("kind", ["stl", "obj"])
def test_millimetres(tmp_path, kind):
    path = write_mesh(tmp_path / f"a.{kind}", box(1000.0))
    survey = opened(path, unit="auto", up="auto")
    points, _ = whole(survey)
    assert survey.local_frame.unit == "mm"
    assert on_box(points) < 1e-4
    assert len(points) == pytest.approx(AREA / 0.025**2, rel=1e-3)


@pytest.mark.parametrize("kind", ["glb", "gltf"])
def test_scene_graph(tmp_path, kind):
    scene = trimesh.Scene()
    parent = trimesh.transformations.translation_matrix([100, 0, 0])
    scene.add_geometry(box(), node_name="one", geom_name="room", transform=np.eye(4))
    scene.graph.update(frame_from="world", frame_to="wing", matrix=parent)
    scene.graph.update(
        frame_from="wing",
        frame_to="two",
        geometry="room",
        matrix=trimesh.transformations.translation_matrix([0, 20, 0]),
    )
    points, _ = whole(opened(write_mesh(tmp_path / f"a.{kind}", scene)))
    first = points[points[:, 0] < 50]
    assert on_box(first) < 1e-5
    assert on_box(points[points[:, 0] > 50] - [100, 20, 0]) < 1e-4
    assert len(first) == pytest.approx(len(points) / 2, rel=1e-3)


def test_the_same_every_time_and_in_chunks(tmp_path, monkeypatch):
    import floorcast_plugins.mesh as module

    path = write_mesh(tmp_path / "a.stl", box())
    once, again = whole(opened(path))[0], whole(opened(path))[0]
    np.testing.assert_array_equal(once, again)
    monkeypatch.setattr(module, "CHUNK_POINTS", 1000)
    monkeypatch.setattr(module, "BLOCK", 5)
    sizes = [len(c.points) for c in opened(path).chunks()]
    assert max(sizes) <= 1000
    assert abs(sum(sizes) - len(once)) <= 3


def test_points_without_faces(tmp_path):
    cloud = np.random.default_rng(1).uniform(0, 1, (500, 3)) * SIZE
    path = tmp_path / "a.obj"
    path.write_text("# points\n" + "".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in cloud))
    points, _ = whole(opened(path))
    np.testing.assert_allclose(points, cloud, atol=1e-5)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_lines_that_go_on_in_the_next_below_a_long_comment(tmp_path, end):
    mesh = box()
    lines = ["#" * 70] * 100 + ["v {} {} {}".format(*v) for v in mesh.vertices]
    lines += [f"f {a} \\{end}{b} {c}" for a, b, c in (mesh.faces + 1).tolist()]
    path = tmp_path / "a.obj"
    path.write_bytes(end.join(lines).encode())
    assert on_box(whole(opened(path))[0]) < 1e-5


@pytest.mark.parametrize(
    ("extension", "says"), [("KHR_draco_mesh_compression", "Draco"), ("EXT_meshopt_compression", "meshopt")]
)
def test_compressed_scenes_are_named(tmp_path, extension, says):
    path = write_mesh(tmp_path / "a.gltf", box())
    path.write_text(json.dumps(json.loads(path.read_text()) | {"extensionsRequired": [extension]}))
    assert f"compressed by {says}, which is not read" in refusal(path)


def test_a_mesh_in_a_ply_is_not_called_misnamed(tmp_path):
    survey = opened(write_mesh(tmp_path / "a.ply", box()))
    assert not any("named like" in sentence for sentence in survey.assumptions)


def test_clouds_stay_clouds(tmp_path):
    from tests.readers.reader_clouds import write_ply, xyz_columns

    cloud = np.random.default_rng(1).uniform(0, 1, (500, 3)) * SIZE
    assert opened(write_ply(tmp_path / "a.ply", "ascii", xyz_columns(cloud))).format == "PLY"


def test_names_that_gltf_escapes(tmp_path):
    path = write_mesh(tmp_path / "a.gltf", box())
    tree = json.loads(path.read_text())
    (tmp_path / tree["buffers"][0]["uri"]).rename(tmp_path / "Büro 1.bin")
    tree["buffers"][0]["uri"] = "B%C3%BCro%201.bin"
    path.write_text(json.dumps(tree))
    assert on_box(whole(opened(path))[0]) < 1e-5
    tree["buffers"][0]["uri"] = "..%2F..%2Fsecret.bin"
    path.write_text(json.dumps(tree))
    assert "outside its own folder" in refusal(path)


def test_stl_in_capitals(tmp_path):
    text = box().export(file_type="stl_ascii").upper()
    (tmp_path / "a.stl").write_text(text)
    assert on_box(whole(opened(tmp_path / "a.stl"))[0]) < 1e-5


def test_a_cloud_with_a_triangle_is_a_cloud(tmp_path):
    """Its other points are of no triangle and were lost when it was read as a mesh."""
    points = np.random.default_rng(2).uniform(0, 1, (500, 3)) * SIZE
    path = write_mesh(tmp_path / "a.ply", trimesh.Trimesh(points, [[0, 1, 2]], process=False))
    found, _ = whole(opened(path))
    np.testing.assert_allclose(found, points, atol=1e-5)


def test_nothing_outside_the_folder_is_read(tmp_path):
    inner = tmp_path / "inner"
    inner.mkdir()
    path = write_mesh(inner / "a.gltf", box())
    tree = json.loads(path.read_text())
    name = tree["buffers"][0]["uri"]
    (inner / name).rename(tmp_path / name)
    assert "not there" in refusal(path)
    for uri in (f"../{name}", str(tmp_path / name), f"file://{tmp_path / name}", "http://localhost/x.bin"):
        tree["buffers"][0]["uri"] = uri
        path.write_text(json.dumps(tree))
        assert "outside its own folder" in refusal(path)
    (inner / "link.bin").symlink_to(tmp_path / name)
    tree["buffers"][0]["uri"] = "link.bin"
    path.write_text(json.dumps(tree))
    assert "not there" in refusal(path)


def test_scenes_that_lie(tmp_path):
    path = write_mesh(tmp_path / "a.gltf", box())
    good = json.loads(path.read_text())
    bad = json.loads(path.read_text())
    bad["accessors"][0] = {"componentType": 5126, "count": 10**12, "type": "VEC3"}
    path.write_text(json.dumps(bad))
    assert "1,000,000,000,000 values without data" in refusal(path)
    bad = {**good, "nodes": [{"children": [1, 1]}, {"mesh": 0}]}
    path.write_text(json.dumps(bad))
    assert "two parents" in refusal(path)
    path.write_text('{"asset": {"version": "2.0"}, "meshes": []}')
    assert "without meshes" in refusal(path)


def test_counts_that_lie(tmp_path):
    stl = write_mesh(tmp_path / "a.stl", box())
    data = bytearray(stl.read_bytes())
    struct.pack_into("<I", data, 80, 1 << 31)
    stl.write_bytes(bytes(data))
    assert "promises 2,147,483,648 triangles" in refusal(stl)
    ply = write_mesh(tmp_path / "a.ply", box())
    ply.write_bytes(ply.read_bytes().replace(b"element vertex 8", b"element vertex 800000000000"))
    assert "truncated" in refusal(ply)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("value", [1e30, np.nan])
def test_a_corner_far_away_costs_its_triangles_only(tmp_path, value):
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=2.0)
    mesh.vertices[7, 1] = value
    path = write_mesh(tmp_path / "a.stl", mesh)
    survey = opened(path)
    points, _ = whole(survey)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 2.0, atol=0.05)
    assert any("absurdly far away" in text for text in survey.assumptions)


def test_no_surface(tmp_path):
    path = tmp_path / "a.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n")
    assert "without any surface" in refusal(path)


@pytest.mark.parametrize("kind", KINDS)
def test_damage(tmp_path, kind):
    mesh = trimesh.creation.icosphere(subdivisions=1, radius=1.0)
    path = write_mesh(tmp_path / f"a.{kind}", mesh)
    assert survives(path, tmp_path, limit=200_000) > 5


@pytest.mark.parametrize("kind", ["stl", "ply"])
def test_large_meshes_are_read_by_pieces(tmp_path, kind, monkeypatch):
    """The same points as from the mesh held whole, also where one corner lies absurdly far away."""
    mesh = trimesh.creation.box(extents=SIZE).subdivide().subdivide().subdivide()
    mesh.vertices[7] = 1e7, 0, 0
    path = write_mesh(tmp_path / f"a.{kind}", mesh)
    held, _ = whole(opened(path))
    monkeypatch.setattr("floorcast_plugins._mesh_pieces.LARGE", 0)
    monkeypatch.setattr("floorcast_plugins._mesh_pieces.PIECE", 100)
    monkeypatch.setattr(
        "floorcast_plugins.mesh.load_triangles", lambda *_: pytest.fail("the mesh was loaded whole")
    )
    survey = opened(path)
    read, _ = whole(survey)
    assert any("left out" in sentence for sentence in survey.assumptions)
    assert abs(len(read) - len(held)) <= 1
    count = min(len(read), len(held))
    assert np.abs(read[:count] - held[:count]).max() < 1e-3 or kind == "stl"
    assert np.quantile(np.abs(np.abs(read) - SIZE / 2).min(axis=1), 0.999) < 1e-5


def test_polygons_are_not_read_by_pieces(tmp_path, monkeypatch):
    text = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\n"
    text += b"".join(b"property float %c\n" % a for a in b"xyz")
    text += b"element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    corners = np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]], dtype="<f4")
    path = tmp_path / "a.ply"
    path.write_bytes(text + corners.tobytes() + struct.pack("<B4i", 4, 0, 1, 2, 3))
    monkeypatch.setattr("floorcast_plugins._mesh_pieces.LARGE", 0)
    points, _ = whole(opened(path))
    assert len(points) == pytest.approx(12 / 0.025**2, rel=1e-3)


def test_too_large_for_the_memory(tmp_path, monkeypatch):
    path = write_mesh(tmp_path / "a.obj", box())
    monkeypatch.setattr("floorcast_plugins._mesh_pieces.LARGE", 0)
    monkeypatch.setattr("floorcast_plugins._mesh_pieces.free_memory", lambda: 1000)
    assert "read by pieces" in refusal(path)
