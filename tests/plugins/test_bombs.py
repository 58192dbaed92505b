"""What unpacks without end, leads outside its folder, or would run as a program is refused."""

from __future__ import annotations

import bz2
import gzip
import pickle
import zipfile

import numpy as np
import pytest
from lz4 import frame as lz4
from rosbags.rosbag1 import Writer
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Writer2

from floorcast_plugins import _bounded
from floorcast_plugins._bounded import Bomb, BoundedFile, bound_rosbags, unpack
from tests.plugins.plugin_files import MEMORY, opened, peak_memory, refusal, whole
from tests.plugins.test_rosbag import ROS1, ROS2, START, Messages, local, parts, poses

ZEROS = 1 << 27  # bytes that a bomb holds


def packed_zeros(kind: str) -> bytes:
    """Many zeros, packed piece by piece."""
    piece = bytes(1 << 20)
    if kind == "bz2":
        packer = bz2.BZ2Compressor(9)
        return b"".join(packer.compress(piece) for _ in range(ZEROS >> 20)) + packer.flush()
    packer = lz4.LZ4FrameCompressor(auto_flush=True)
    return packer.begin() + b"".join(packer.compress(piece) for _ in range(ZEROS >> 20)) + packer.flush()


@pytest.mark.parametrize(("kind", "make"), [("bz2", bz2.BZ2Decompressor), ("lz4", lz4.LZ4FrameDecompressor)])
def test_zeros_without_end_are_refused_before_it_is_there(kind, make):
    data = packed_zeros(kind)
    before = peak_memory(reset=True)
    with pytest.raises(Bomb, match="unpack to more than"):
        unpack(make, data, 1 << 20)
    assert peak_memory() - before < ZEROS / 2


def test_what_is_no_bomb_comes_back_whole():
    one, two = b"one" * 1000, b"two" * 1000
    assert unpack(bz2.BZ2Decompressor, bz2.compress(one) + bz2.compress(two)) == one + two
    assert unpack(lz4.LZ4FrameDecompressor, lz4.compress(one)) == one
    with pytest.raises(ValueError, match="ends before its end"):
        unpack(bz2.BZ2Decompressor, bz2.compress(one)[:-5])


def test_a_file_without_end(tmp_path, monkeypatch):
    monkeypatch.setattr(_bounded, "MOST_BYTES", 1 << 20)
    path = tmp_path / "zeros.gz"
    with gzip.open(path, "wb") as file:
        for _ in range(64):
            file.write(bytes(1 << 20))
    with gzip.open(path) as file, BoundedFile(file, path.stat().st_size) as bounded, pytest.raises(Bomb):
        while bounded.read(1 << 20):
            pass


def messages(store):
    made = Messages(store)
    for k, (T, part) in enumerate(zip(poses(), parts(4.0), strict=True)):
        yield "/odom", START + k, made.odometry(T, START + k, "odom", "lidar")
        yield "/points", START + k, made.cloud(local(part, T), START + k)


def write_ros1(folder, kind):
    writer = Writer(folder / "run.bag")
    writer.set_compression(kind)
    with writer:
        _fill(writer, ROS1, ROS1.serialize_ros1)
    return folder / "run.bag"


def write_ros2(folder, mode, mcap=False):
    plugin = StoragePlugin.MCAP if mcap else StoragePlugin.SQLITE3
    writer = Writer2(folder / "run", version=9, storage_plugin=plugin)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        _fill(writer, ROS2, ROS2.serialize_cdr)
    return folder / "run"


def _fill(writer, store, serialize):
    connections = {}
    for topic, seconds, message in messages(store):
        name = message.__msgtype__
        if topic not in connections:
            connections[topic] = writer.add_connection(topic, name, typestore=store)
        writer.write(connections[topic], round(seconds * 1e9), bytes(serialize(message, name)))


RECORDINGS = {
    "bz2": lambda folder: write_ros1(folder, Writer.CompressionFormat.BZ2),
    "lz4": lambda folder: write_ros1(folder, Writer.CompressionFormat.LZ4),
    "zstd messages": lambda folder: write_ros2(folder, CompressionMode.MESSAGE),
    "zstd file": lambda folder: write_ros2(folder, CompressionMode.FILE),
    "zstd chunks": lambda folder: write_ros2(folder, CompressionMode.STORAGE, mcap=True),
}


@pytest.mark.parametrize("kind", RECORDINGS)
def test_compressed_recordings_are_read_and_their_chunks_have_an_end(tmp_path, monkeypatch, kind):
    bound_rosbags()
    path = RECORDINGS[kind](tmp_path)
    points, _ = whole(opened(path))
    assert len(points) == sum(map(len, parts(4.0)))
    monkeypatch.setattr(_bounded, "MOST_BYTES", 100)
    monkeypatch.setattr(_bounded, "MOST_RATIO", 0)
    assert "refused" in refusal(path)


def test_a_recording_that_names_files_outside_its_folder(tmp_path):
    path = write_ros2(tmp_path, CompressionMode.MESSAGE)
    (inner,) = path.glob("*.db3*")
    inner.rename(tmp_path / inner.name)
    sheet = path / "metadata.yaml"
    sheet.write_text(sheet.read_text().replace(f"- {inner.name}", f"- ../{inner.name}"))
    assert inner.name not in {p.name for p in path.iterdir()}
    refusal(path)


def test_pickled_arrays_are_refused(tmp_path):
    class Trap:
        def __reduce__(self):
            return (open, (str(tmp_path / "sprung"), "w"))

    objects = np.array([Trap()], dtype=object)
    np.save(tmp_path / "a.npy", objects, allow_pickle=True)
    np.savez(tmp_path / "b.npz", points=objects)
    (tmp_path / "c.pkl").write_bytes(pickle.dumps(Trap()))
    for name in ("a.npy", "b.npz", "c.pkl"):
        refusal(tmp_path / name)
    assert not (tmp_path / "sprung").exists()


def test_a_zip_bomb_among_arrays(tmp_path):
    pieces = 300  # MB: smaller arrays may shrink as they like
    head = {"descr": "<f4", "fortran_order": False, "shape": ((pieces << 20) // 12, 3)}
    with (
        zipfile.ZipFile(tmp_path / "a.npz", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive,
        archive.open("points.npy", "w", force_zip64=True) as member,
    ):
        np.lib.format.write_array_header_1_0(member, head)
        for _ in range(pieces):
            member.write(bytes(1 << 20))
    before = peak_memory(reset=True)
    assert "refused" in refusal(tmp_path / "a.npz")
    assert peak_memory() - before < MEMORY
