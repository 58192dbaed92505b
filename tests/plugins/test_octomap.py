"""OctoMap: trees written bit by bit come back as voxels; the real map equals what others made of it."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from tests.plugins.plugin_files import opened, refusal, shared, survives, whole

FREE, OCCUPIED = 1, 2  # the two bits of a child in a .bt file
RES = 0.05


def tree_of(leaves: dict[tuple[int, int, int, int], int]) -> dict:
    """Nested nodes from leaves (x, y, z key, level): state."""
    root: dict = {}
    for (x, y, z, level), state in leaves.items():
        node = root
        for depth in range(15, level - 1, -1):
            child = ((x >> depth) & 1) | (((y >> depth) & 1) << 1) | (((z >> depth) & 1) << 2)
            if depth == level:
                node[child] = state
            else:
                node = node.setdefault(child, {})
    return root


def binary_nodes(node: dict) -> bytes:
    bits = sum((3 if isinstance(v, dict) else v) << (2 * k) for k, v in node.items())
    below = b"".join(binary_nodes(node[k]) for k in sorted(node) if isinstance(node[k], dict))
    return struct.pack("<H", bits) + below


def full_nodes(node, more: bytes) -> bytes:
    if not isinstance(node, dict):
        return struct.pack("<f", 0.85 if node == OCCUPIED else -0.4) + more + b"\x00"
    head = struct.pack("<f", 0.1) + more + bytes([sum(1 << k for k in node)])
    return head + b"".join(full_nodes(node[k], more) for k in sorted(node))


def write_bt(path, leaves):
    head = f"# Octomap OcTree binary file\n# a comment\nid OcTree\nsize {len(leaves)}\nres {RES}\ndata\n"
    path.write_bytes(head.encode() + binary_nodes(tree_of(leaves)))
    return path


def write_ot(path, leaves, kind="OcTree", more=b""):
    head = f"# Octomap OcTree file\n#\nid {kind}\nsize {len(leaves)}\nres {RES}\ndata\n"
    path.write_bytes(head.encode() + full_nodes(tree_of(leaves), more))
    return path


def random_leaves(rng, count=400):
    """Leaves of levels 0 to 3 that do not overlap: one in each of many blocks of 8 voxels a side."""
    blocks = np.unique(rng.integers(4090, 4106, (count, 3)), axis=0)
    levels = rng.integers(0, 4, len(blocks))
    states = rng.integers(1, 3, len(blocks))
    return {
        (*(block << 3).tolist(), int(level)): int(state)
        for block, level, state in zip(blocks, levels, states, strict=True)
    }


def centres(leaves, state):
    """Sorted keys of all finest voxels of a state."""
    found = set()
    for (x, y, z, level), is_ in leaves.items():
        if is_ == state:
            side = range(1 << level)
            found |= {(x + i - 32768, y + j - 32768, z + k - 32768) for i in side for j in side for k in side}
    return np.array(sorted(found))


def keys(points):
    found = np.round(np.asarray(points, dtype=np.float64) / RES - 0.5).astype(int)
    np.testing.assert_allclose(points, (found + 0.5) * RES, atol=1e-4)
    return found[np.lexsort(found.T[::-1])]


@pytest.mark.parametrize("form", ["bt", "ot", "colour"])
def test_what_is_written_comes_back(tmp_path, form):
    leaves = random_leaves(np.random.default_rng(1))
    path = tmp_path / "map.any"
    if form == "bt":
        write_bt(path, leaves)
    else:
        write_ot(path, leaves, *(("ColorOcTree", b"\x01\xff\x80") if form == "colour" else ()))
    survey = opened(path)
    assert survey.format == "OctoMap"
    chunks = list(survey.chunks())
    points, free = (np.concatenate([getattr(c, n) for c in chunks]) for n in ("points", "free"))
    assert survey.point_count == len(points)
    np.testing.assert_array_equal(keys(points), centres(leaves, OCCUPIED))
    np.testing.assert_array_equal(keys(free), centres(leaves, FREE))
    assert {c.free_size for c in chunks} == {RES}


def test_large_leaves_come_in_chunks(tmp_path, monkeypatch):
    import floorcast_plugins.octomap as module

    monkeypatch.setattr(module, "BATCH_VOXELS", 1000)
    leaves = {(32768, 32768, 32768, 5): OCCUPIED, (32768 + 32, 32768, 32768, 5): FREE}
    chunks = list(opened(write_bt(tmp_path / "a.bt", leaves)).chunks())
    assert max(max(len(c.points), len(c.free)) for c in chunks) <= 1000
    assert sum(len(c.points) for c in chunks) == sum(len(c.free) for c in chunks) == 32**3
    assert len(np.unique(np.concatenate([c.points for c in chunks]), axis=0)) == 32**3


def test_the_real_map_equals_the_reference():
    survey = opened(shared("octomap_fr079_3d/geb079.bt"))
    chunks = list(survey.chunks())
    points, free = (np.concatenate([getattr(c, n) for c in chunks]) for n in ("points", "free"))
    reference, _ = whole(opened(shared("octomap_fr079_3d/points.ply")))
    carved = np.load(shared("octomap_fr079_3d/free_voxels.npz"))["centers"]
    for found, wanted in ((points, reference), (free, carved)):
        assert len(found) == len(wanted)
        order = [np.lexsort(np.round(a / 0.04).astype(int).T) for a in (found, wanted)]
        np.testing.assert_allclose(found[order[0]], wanted[order[1]], atol=1e-4)
    assert any("950,759 free voxels" in text for text in survey.assumptions)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (b"res 0.05", b"res 0", "voxels of 0 m"),
        (b"res 0.05", b"res nan", "voxels of nan m"),
        (b"res 0.05", b"res five", "no valid 'res'"),
        (b"data\n", b"dada\n", "does not end with 'data'"),
    ],
)
def test_headers_that_lie(tmp_path, old, new, says):
    path = write_bt(tmp_path / "a.bt", random_leaves(np.random.default_rng(2)))
    path.write_bytes(path.read_bytes().replace(old, new))
    assert says in refusal(path)


def test_trees_that_lie(tmp_path):
    path = write_bt(tmp_path / "a.bt", random_leaves(np.random.default_rng(2)))
    head, data = path.read_bytes()[: path.read_bytes().index(b"data\n") + 5], b"\xff" * 100
    path.write_bytes(head + data)
    assert "deeper than the 16 levels" in refusal(path)
    path.write_bytes(head + b"\xaa\xaa")  # the whole space is occupied
    assert "more than 268,435,456 voxels" in refusal(path)
    path.write_bytes(head)
    assert "ends after its header" in refusal(path)
    path.write_bytes(head + b"\x55\x05")
    assert "more than" in refusal(path)
    write_bt(path, {(32768, 32768, 32768, 0): FREE})
    assert "without occupied voxels" in refusal(path)
    write_ot(path, {(32768, 32768, 32768, 0): OCCUPIED}, "SecretTree")
    assert "'SecretTree'" in refusal(path)


@pytest.mark.parametrize("write", [write_bt, write_ot])
def test_damage(tmp_path, write):
    path = write(tmp_path / "a.bt", random_leaves(np.random.default_rng(3), 60))
    assert survives(path, tmp_path) > 15
