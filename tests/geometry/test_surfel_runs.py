"""Surfels that outgrow their room: on disk they are bit for bit what they would be in memory."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import numpy as np
import pytest

from floorplan_core.errors import OutputError
from floorplan_core.geometry import scratch
from floorplan_core.geometry.scratch import disk_array, let_go, scratch_folder
from floorplan_core.geometry.surfel_map import MOST_POINTS, SurfelMap

SIZE, LIMITS, ROOM = 0.05, (0.05, 30.0), 4e6
ORIGINS = np.array([[0.0, 0.0, 1.5], [3.0, -2.0, 1.2]])


def _scans(seed: int = 3, scans: int = 6, points: int = 60_000) -> list[tuple[np.ndarray, np.ndarray]]:
    """Scans that overlap, so that voxels are met in several parts."""
    rng = np.random.default_rng(seed)
    places = [rng.normal(k % 3, 1.2, (points, 3)) for k in range(scans)]
    return [(p, rng.integers(-1, 2, points).astype(np.int32)) for p in places]


def _filled(scans, room=None) -> SurfelMap:
    table = SurfelMap(SIZE, room)
    for points, scan in scans:
        table.insert(points, scan, ORIGINS, LIMITS)
    return table


def _bytes(table: SurfelMap) -> list[bytes]:
    found, turn = table.surfels(), np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    arrays = (found.centroid, found.count, found.variance, found.view, *table.turned(turn, 0.3))
    return [a.tobytes() for a in arrays]


def test_surfels_on_disk_are_those_in_memory_bit_for_bit():
    inside, outside = _filled(_scans()), _filled(_scans(), ROOM)
    assert not inside.on_disk and outside.on_disk
    assert len(inside) == len(outside) > 150_000  # of 65,536 that there is room for
    assert inside.points == outside.points
    assert _bytes(inside) == _bytes(outside)


def test_a_look_between_scans_changes_nothing():
    scans = _scans(scans=4)
    looked = SurfelMap(SIZE, ROOM)
    for points, scan in scans:
        looked.insert(points, scan, ORIGINS, LIMITS)
        assert len(looked.surfels(every=7)) > 0
        looked.pack()
    assert _bytes(looked) == _bytes(_filled(scans))


def test_surfels_may_leave_memory_later():
    scans = _scans(scans=4)
    left = _filled(scans[:3])
    left.leave_memory()
    assert left.on_disk
    assert _bytes(left) == _bytes(_filled(scans[:3]))
    left.insert(*scans[3], ORIGINS, LIMITS)
    assert _bytes(left) == _bytes(_filled(scans))


def test_points_may_come_after_packing():
    scans = _scans(scans=4)
    packed = _filled(scans[:2])
    packed.pack()
    for points, scan in scans[2:]:
        packed.insert(points, scan, ORIGINS, LIMITS)
    assert _bytes(packed) == _bytes(_filled(scans))


@pytest.mark.parametrize("room", [None, ROOM])
def test_a_selection_takes_points_too(room):
    table = _filled(_scans(scans=3), room)
    rows = np.flatnonzero(table.surfels().centroid[:, 2] > 0.7)
    part = table.select(rows)
    assert part.on_disk == (room is not None)
    assert part.surfels().centroid.tobytes() == table.surfels().centroid[rows].tobytes()
    before = part.points
    part.insert(np.array([[0.0, 0.0, 9.0]]), np.array([-1], dtype=np.int32), ORIGINS, LIMITS)
    assert (len(part), part.points) == (len(rows) + 1, before + 1)


@pytest.mark.parametrize("room", [None, ROOM])
def test_pieces_are_the_whole(room):
    table = _filled(_scans(scans=3), room)
    whole, pieces = table.surfels(), list(table.pieces(70_001))
    assert len(pieces) > 2
    for name in ("centroid", "count", "variance", "view"):
        parts = np.concatenate([getattr(piece, name) for piece in pieces])
        assert parts.tobytes() == getattr(whole, name).tobytes()


def test_a_voxel_full_of_points_in_several_parts_does_not_overflow():
    table = SurfelMap(SIZE, ROOM)
    full = np.full((MOST_POINTS + 5, 3), 0.049999)
    for k in range(3):
        spread = np.random.default_rng(k).uniform(-5, 5, (70_000, 3))
        for points in (full, spread):
            table.insert(points, np.full(len(points), -1, dtype=np.int32), ORIGINS, LIMITS)
    found = table.surfels()
    at = int(np.argmax(found.count))
    assert found.count[at] >= MOST_POINTS
    assert found.centroid[at] == pytest.approx([0.04975] * 3, abs=1e-3)
    assert (found.variance > -1e-12)[:, [0, 2]].all()


def test_arrays_on_disk_keep_what_was_written_and_leave_no_file(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    array = disk_array((1000, 3), np.int32)
    array[:] = 7
    let_go(array[5:])
    assert array.sum() == 21_000
    assert list(tmp_path.iterdir()) == []
    assert len(disk_array((0, 9), np.int32)) == 0


def test_a_full_disk_is_one_sentence(monkeypatch):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(scratch, "_take", full)
    with pytest.raises(OutputError, match=r"no room for a temporary file of 8 MB.*TMPDIR"):
        disk_array((1_000_000,), np.int64)


def test_a_temporary_folder_that_is_memory_is_not_used(tmp_path, monkeypatch):
    disk = tmp_path / "disk"
    disk.mkdir()
    mounts = tmp_path / "mounts"
    mounts.write_text(f"/dev/sda / ext4 rw 0 0\ntmpfs {tmp_path} tmpfs rw 0 0\n/dev/sdb {disk} ext4 rw 0 0\n")
    monkeypatch.setattr(scratch, "_MOUNTS", mounts)
    monkeypatch.setattr(scratch, "_ON_DISK", disk)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert scratch_folder() == disk
    monkeypatch.setattr("tempfile.tempdir", "/usr")
    assert scratch_folder() == Path("/usr")
