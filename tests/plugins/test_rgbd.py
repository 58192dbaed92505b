"""Folders of depth images: a simulated walk comes back, whichever way its poses are written."""

from __future__ import annotations

import json
import struct
import zlib

import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from floorplan_core.errors import InputError
from tests.plugins.plugin_files import opened, refusal, whole
from tests.readers.reader_clouds import Remembering

SIZE = np.array([8.0, 5.0, 2.6])
WIDTH, HEIGHT = 80, 60
F, CX, CY = 60.0, 39.5, 29.5
COUNT = 24
START = 1_305_031_100.0


def camera_poses():
    """(COUNT, 4, 4) camera to world, z up: walks sideways and turns, looking about level."""
    a = np.linspace(0, 1.6 * np.pi, COUNT)
    T = np.tile(np.eye(4), (COUNT, 1, 1))
    for k, angle in enumerate(a):
        T[k, :3, :3] = looking(angle, 0.1)
        T[k, :3, 3] = 4.0 + 1.5 * np.cos(angle + 2), 2.5 + 1.0 * np.sin(angle + 2), 1.4
    return T


def looking(yaw, pitch):
    """(3, 3) camera to world of a camera that looks along ``yaw``, up by ``pitch``, radians."""
    level = Rotation.from_matrix([[0, 0, 1], [-1, 0, 0], [0, -1, 0]])  # z ahead along x, y down
    return (Rotation.from_euler("z", yaw) * level * Rotation.from_euler("x", pitch)).as_matrix()


def pixel_rays():
    """(HEIGHT, WIDTH, 3) to where each pixel looks, one metre ahead of the camera."""
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    return np.stack([(u - CX) / F, (v - CY) / F, np.ones_like(u, dtype=float)], axis=-1)


def render(T):
    """(HEIGHT, WIDTH) metres along the camera's axis to the walls of the room."""
    rays = pixel_rays() @ T[:3, :3].T
    rays = np.where(np.abs(rays) < 1e-9, 1e-9, rays)
    return np.min(np.where(rays > 0, SIZE - T[:3, 3], -T[:3, 3]) / rays, axis=-1)


def write_images(folder, names, scale):
    folder.mkdir(parents=True, exist_ok=True)
    for name, T in zip(names, camera_poses(), strict=True):
        depth = np.round(render(T) * scale).astype(np.uint16)
        Image.fromarray(depth).save(folder / name)


def write_matrix(path, T):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(" ".join(f"{v:.9g}" for v in row) for row in T) + "\n")


K3 = np.array([[F, 0, CX], [0, F, CY], [0, 0, 1]])


def write_tum_folder(root, inverted=False, scale=5000.0):
    stamps = START + 0.1 * np.arange(COUNT)
    names = [f"{t:.6f}.png" for t in stamps]
    write_images(root / "depth", names, scale)
    lines = [f"{t:.6f} depth/{n}" for t, n in zip(stamps, names, strict=True)]
    (root / "depth.txt").write_text("# depth maps\n# timestamp filename\n" + "\n".join(lines) + "\n")
    rows = []
    for t, T in zip(stamps, camera_poses(), strict=True):
        T = np.linalg.inv(T) if inverted else T
        q = Rotation.from_matrix(T[:3, :3]).as_quat()
        rows.append(" ".join(f"{v:.9f}" for v in (t + 0.01, *T[:3, 3], *q)))
    (root / "groundtruth.txt").write_text("# timestamp tx ty tz qx qy qz qw\n" + "\n".join(rows) + "\n")
    write_matrix(root / "intrinsics.txt", K3)
    return root


def write_scannet(root, inverted=False, scale=1000.0):
    write_images(root / "depth", [f"{k}.png" for k in range(COUNT)], scale)
    for k, T in enumerate(camera_poses()):
        write_matrix(root / "pose" / f"{k}.txt", np.linalg.inv(T) if inverted else T)
    K = np.eye(4)
    K[:3, :3] = K3
    write_matrix(root / "intrinsic" / "intrinsic_depth.txt", K)
    return root


def write_scenes(root, inverted=False, scale=1000.0):
    write_images(root, [f"frame-{k:06d}.depth.png" for k in range(COUNT)], scale)
    for k, T in enumerate(camera_poses()):
        write_matrix(root / f"frame-{k:06d}.pose.txt", np.linalg.inv(T) if inverted else T)
    write_matrix(root / "intrinsics.txt", K3)
    return root


def write_intrinsic_json(root):
    tree = {"width": WIDTH, "height": HEIGHT, "intrinsic_matrix": K3.T.ravel().tolist()}
    (root / "camera_intrinsic.json").write_text(json.dumps(tree))


def write_redwood(root, inverted=False, scale=1000.0):
    write_images(root / "depth", [f"{k:06d}.png" for k in range(COUNT)], scale)
    text = ""
    for k, T in enumerate(camera_poses()):
        T = np.linalg.inv(T) if inverted else T
        text += f"{k} {k} {k + 1}\n" + "\n".join(" ".join(f"{v:.9f}" for v in row) for row in T) + "\n"
    (root / "scene").mkdir()
    (root / "scene" / "trajectory.log").write_text(text)
    write_intrinsic_json(root)
    return root


def write_open3d(root, inverted=True, scale=1000.0):
    write_images(root / "depth", [f"{k:05d}.png" for k in range(COUNT)], scale)
    poses = [np.linalg.inv(T) if inverted else T for T in camera_poses()]
    tree = {"parameters": [{"extrinsic": T.T.ravel().tolist()} for T in poses]}
    (root / "trajectory.json").write_text(json.dumps(tree))
    write_intrinsic_json(root)
    return root


WRITERS = (write_tum_folder, write_scannet, write_scenes, write_redwood, write_open3d)


def off_walls(points):
    inside = np.minimum(points, SIZE - points).min(axis=1)
    return float(np.abs(inside).max())


@pytest.mark.parametrize("write", WRITERS)
@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("scale", [1000.0, 4000.0, 5000.0])
def test_the_room_comes_back(tmp_path, write, inverted, scale):
    root = tmp_path / "run"
    root.mkdir()
    survey = opened(write(root, inverted, scale))
    points, ids = whole(survey)
    assert off_walls(points) < 0.01
    np.testing.assert_allclose(survey.trajectory.origins, camera_poses()[:, :3, 3], atol=1e-5)
    assert ids.max() == COUNT - 1
    words = "world-to-camera" if inverted else "camera-to-world"
    assert any(words in text and f"{scale:g} depth units" in text for text in survey.assumptions)


def test_images_that_turn_fast(tmp_path, monkeypatch):
    """Every third image shows nothing of the one before: neighbours are compared, or that is said."""
    import sys

    module = sys.modules[__name__]
    poses = camera_poses()[::2]
    monkeypatch.setattr(module, "camera_poses", lambda: poses)
    monkeypatch.setattr(module, "COUNT", len(poses))
    survey = opened(write_scannet(tmp_path / "run", inverted=True))
    assert off_walls(whole(survey)[0]) < 0.01
    assert any("world-to-camera and 1000 depth units as a metre: so " in s for s in survey.assumptions)
    poses = camera_poses()[::8]
    monkeypatch.setattr(module, "COUNT", len(poses))
    survey = opened(write_scannet(tmp_path / "sparse"))
    assert any("as is usual: no images show" in text for text in survey.assumptions)


def test_up_is_found(tmp_path):
    survey = opened(write_scannet(tmp_path / "run"), unit="auto", up="auto")
    assert survey.local_frame.up == "z"


def test_lost_poses_are_counted(tmp_path):
    root = write_scannet(tmp_path / "run")
    write_matrix(root / "pose" / "3.txt", np.full((4, 4), -np.inf))
    (root / "pose" / "5.txt").unlink()
    observer = Remembering()
    survey = opened(root, observer)
    assert len(survey.trajectory) == COUNT - 2
    assert any(text.startswith("2 depth images") for text in observer.warnings)


def test_images_that_a_list_names_and_nobody_has_are_counted(tmp_path):
    root = write_tum_folder(tmp_path / "run")
    images = sorted((root / "depth").glob("*.png"))
    for image in images[::3]:
        image.unlink()
    observer = Remembering()
    survey = opened(root, observer)
    left = len(images) - len(images[::3])
    assert len(survey.trajectory) == left
    assert len(np.unique(whole(survey)[1])) == left
    assert any(
        text.startswith(f"{len(images[::3])} depth images that run lists") for text in observer.warnings
    )


def test_images_that_did_not_move_are_left_out(tmp_path):
    root = write_scannet(tmp_path / "run")
    for k in (8, 9):
        for a, b in (("pose/7.txt", f"pose/{k}.txt"), ("depth/7.png", f"depth/{k}.png")):
            (root / b).write_bytes((root / a).read_bytes())
    assert len(opened(root).trajectory) == COUNT - 2


def test_without_poses_or_intrinsics(tmp_path):
    root = write_redwood(tmp_path / "run")
    (root / "camera_intrinsic.json").unlink()
    assert any("PrimeSense" in text for text in opened(root).assumptions)
    (root / "scene" / "trajectory.log").unlink()
    assert "24 depth images but no trajectory" in refusal(root)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "no PNG"),
        (
            b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\xff\xff\xff\x00\xff\xff\xff\x10\x00\x00\x00\x00",
            "no PNG|claims",
        ),
        (b"JFIF" * 20, "no PNG"),
    ],
)
def test_images_that_lie(tmp_path, content, says):
    import re

    root = write_scannet(tmp_path / "run")
    for image in (root / "depth").iterdir():
        image.write_bytes(content)
    assert re.search(says, refusal(root))


def test_more_pixels_than_the_image_has(tmp_path, capfd):
    """A small image that unpacks to a hundred megabytes."""

    def part(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = part(b"IHDR", struct.pack(">2I5B", 64, 48, 16, 0, 0, 0, 0))
    bomb = b"\x89PNG\r\n\x1a\n" + head + part(b"IDAT", zlib.compress(bytes(100 << 20))) + part(b"IEND", b"")
    folder = write_tum_folder(tmp_path, False, 5000.0)
    for path in (folder / "depth").glob("*.png"):
        path.write_bytes(bomb)
    assert "is damaged" in refusal(folder)
    assert capfd.readouterr().err == ""


def test_colour_is_no_depth(tmp_path):
    root = write_scannet(tmp_path / "run")
    Image.fromarray(np.zeros((HEIGHT, WIDTH, 3), np.uint8)).save(root / "depth" / "3.png")
    assert "not depth" in refusal(root)


def test_depth_lists_stay_in_their_folder(tmp_path):
    root = write_tum_folder(tmp_path / "run")
    (root / "depth.txt").write_text("1.0 ../secret.png\n")
    assert "Line 1 of depth.txt" in refusal(root)


def test_damaged_images_are_told_once(tmp_path, capfd):
    root = write_scannet(tmp_path / "run")
    good = (root / "depth" / "3.png").read_bytes()
    for bad in (good[: len(good) // 2], good[:60] + bytes([good[60] ^ 1]) + good[61:]):
        (root / "depth" / "3.png").write_bytes(bad)
        assert "is damaged" in refusal(root)
    assert capfd.readouterr().err == ""  # the library that decodes would say so, too


def test_damaged_images_and_texts(tmp_path):
    """Every file of the folder in turn, cut and changed."""
    from tests.plugins.plugin_files import damages

    root = write_tum_folder(tmp_path / "run")
    opened(root)
    for name in ("depth.txt", "groundtruth.txt", "intrinsics.txt", f"depth/{START + 0.5:.6f}.png"):
        file = root / name
        good = file.read_bytes()
        for bad in damages(good, cuts=6, flips=12):
            file.write_bytes(bad)
            try:
                whole(opened(root))
            except InputError as error:
                assert "\n" not in str(error)
                assert "switched off" not in str(error), str(error)
        file.write_bytes(good)


def test_a_left_handed_world_is_turned_into_the_building(tmp_path):
    """The images fix the camera's axes: poses that reflect them have a left-handed world."""
    usual = whole(opened(write_scannet(tmp_path / "run"), unit="auto", up="auto"))[0]
    root = write_scannet(tmp_path / "mirrored")
    for k, T in enumerate(camera_poses()):
        write_matrix(root / "pose" / f"{k}.txt", np.diag([1.0, -1.0, 1.0, 1.0]) @ T)
    survey = opened(root, unit="auto", up="auto")
    assert any("left-handed" in s for s in survey.assumptions)
    assert np.allclose(whole(survey)[0], usual, atol=1e-4)
    T = camera_poses()[3]
    write_matrix(root / "pose" / "3.txt", T)
    assert "Some poses of mirrored reflect the axes" in refusal(root)
