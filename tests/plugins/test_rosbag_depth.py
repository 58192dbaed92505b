"""Depth images in recordings: every encoding gives the room back, placed by transforms."""

from __future__ import annotations

import io
import struct

import numpy as np
import pytest
from PIL import Image

from tests.plugins.plugin_files import opened, refusal, survives, whole
from tests.plugins.test_rgbd import COUNT, CX, CY, HEIGHT, SIZE, WIDTH, F, camera_poses, render
from tests.plugins.test_rosbag import START, Messages, mount, write_recording

QUANTISED = (10_000.0, 5.0)  # of inverse depth: a and b in depth = a / (value - b)


def png_bytes(pixels):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, format="PNG")
    return file.getvalue()


class DepthMessages:
    """Images and cameras of one ROS."""

    def __init__(self, m: Messages, frame: str = "optical"):
        self.m, self.frame = m, frame

    def info(self, seconds):
        t = self.m.t
        k = np.array([F, 0, CX, 0, F, CY, 0, 0, 1.0])
        names = (
            ("d", "k", "r", "p") if "k" in t["sensor_msgs/msg/CameraInfo"].__dataclass_fields__ else "DKRP"
        )
        values = dict(zip(names, (np.zeros(5), k, np.eye(3).ravel(), np.zeros(12)), strict=True))
        return t["sensor_msgs/msg/CameraInfo"](
            header=self.m.header(seconds, self.frame),
            height=HEIGHT,
            width=WIDTH,
            distortion_model="plumb_bob",
            binning_x=0,
            binning_y=0,
            roi=t["sensor_msgs/msg/RegionOfInterest"](0, 0, 0, 0, False),
            **values,
        )

    def image(self, metres, seconds, encoding):
        pixels = np.round(metres * 1000).astype(">u2") if encoding == "16UC1" else metres.astype("<f4")
        padded = np.zeros((HEIGHT, WIDTH * pixels.itemsize + 8), np.uint8)  # rows may be longer
        padded[:, : WIDTH * pixels.itemsize] = pixels.view(np.uint8)
        big, step = encoding == "16UC1", padded.shape[1]
        return self.m.t["sensor_msgs/msg/Image"](
            self.m.header(seconds, self.frame), HEIGHT, WIDTH, encoding, int(big), step, padded.ravel()
        )

    def compressed(self, metres, seconds, encoding):
        a, b = QUANTISED
        pixels = metres * 1000 if encoding == "16UC1" else a / metres + b
        png = png_bytes(np.round(pixels).astype(np.uint16))
        data = struct.pack("<iff", 0, a, b) + png
        return self.m.t["sensor_msgs/msg/CompressedImage"](
            self.m.header(seconds, self.frame),
            f"{encoding}; compressedDepth png",
            np.frombuffer(data, np.uint8),
        )


def recording(kind, encoding, topic="/camera/depth/image_raw", with_info=True, repeat=1):
    """A walk whose depth images are of ``kind`` (image or compressed); each is written ``repeat`` times."""

    def build(m):
        depth = DepthMessages(m)
        yield "/tf_static", START - 1.0, m.transform(mount(), START - 1.0, "base", "optical")
        if with_info:
            yield "/camera/depth/camera_info", START - 1.0, depth.info(START - 1.0)
        for k, T in enumerate(np.repeat(camera_poses(), repeat, axis=0)):
            at = START + 0.5 * k
            yield "/tf", at, m.transform(T @ np.linalg.inv(mount()), at, "odom", "base")
            yield topic, at, getattr(depth, kind)(render(T), at, encoding)

    return build


def farthest_from_walls(points):
    gaps = np.minimum(np.abs(points), np.abs(SIZE - points))
    return gaps.min(axis=1).max()


@pytest.mark.parametrize("form", ["bag", "mcap"])
@pytest.mark.parametrize(
    ("kind", "encoding", "near"),
    [
        ("image", "16UC1", 2e-3),
        ("image", "32FC1", 1e-4),
        ("compressed", "16UC1", 2e-3),
        ("compressed", "32FC1", 3e-3),
    ],
)
def test_depth_images_give_the_room_back(tmp_path, form, kind, encoding, near):
    topic = "/camera/depth/image_raw" + ("/compressedDepth" if kind == "compressed" else "")
    survey = opened(write_recording(tmp_path, form, recording(kind, encoding, topic)))
    points, ids = whole(survey)
    world = points + survey.local_frame.shift
    assert farthest_from_walls(world) < near
    assert len(np.unique(ids)) == COUNT
    np.testing.assert_allclose(
        survey.trajectory.T_world_sensor[:, :3, 3] + survey.local_frame.shift,
        camera_poses()[:, :3, 3],
        atol=1e-6,
    )


def test_images_taken_from_the_same_place_are_left_out(tmp_path):
    survey = opened(write_recording(tmp_path, "mcap", recording("image", "32FC1", repeat=3)))
    assert len(survey.trajectory) == COUNT
    assert f"{COUNT} images that moved are used." in survey.assumptions
    assert sorted(np.unique(whole(survey)[1])) == list(range(COUNT))


def test_without_a_camera_the_topics_are_named(tmp_path):
    path = write_recording(tmp_path, "bag", recording("image", "16UC1", with_info=False))
    assert "no camera_info beside them" in refusal(path)


def test_colour_images_are_not_taken_for_depth(tmp_path):
    assert "its topics:" in refusal(write_recording(tmp_path, "mcap", recording("image", "rgb8")))


def test_damaged_depth_images(tmp_path):
    assert survives(write_recording(tmp_path, "mcap", recording("compressed", "16UC1")), tmp_path) > 15
