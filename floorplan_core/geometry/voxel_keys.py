"""Integer keys of voxels and the open-addressing hash that the sparse maps share.

A key packs three signed indices of 21 bits; a hash keeps the 64 voxels of a 4 x 4 x 4 block side by side,
so that neighbouring points touch neighbouring memory.
"""

from __future__ import annotations

from numba import njit

BIAS = 1 << 20  # indices from -BIAS to BIAS - 1: 100 km at 5 cm, far beyond any building
EMPTY = -1
_MIX = 0xFF51AFD7ED558CCD - (1 << 64)  # a multiplier of MurmurHash3's finaliser, as a signed integer
_LOW = (1 << 31) - 1  # shifts of negative integers bring ones in: keep the low bits only


@njit(cache=True, inline="always")
def pack(ix, iy, iz):  # type: ignore[no-untyped-def]
    """Three signed indices to one key."""
    return ((ix + BIAS) << 42) | ((iy + BIAS) << 21) | (iz + BIAS)


@njit(cache=True, inline="always")
def spread(key):  # type: ignore[no-untyped-def]
    """A key to a well mixed non-negative integer of 31 bits."""
    mixed = (key ^ ((key >> 33) & _LOW)) * _MIX
    return (mixed ^ ((mixed >> 33) & _LOW)) & _LOW


@njit(cache=True, inline="always")
def block_slot(ix, iy, iz, mask):  # type: ignore[no-untyped-def]
    """First slot to try for a voxel: its block's hash, then its place in the block."""
    block = spread(pack(ix >> 2, iy >> 2, iz >> 2))
    local = ((ix & 3) << 4) | ((iy & 3) << 2) | (iz & 3)
    return ((block << 6) | local) & mask


@njit(cache=True, inline="always")
def find_slot(key, keys):  # type: ignore[no-untyped-def]
    """The slot of ``key`` in a hash of keys, or the empty one where it belongs."""
    mask = len(keys) - 1
    slot = spread(key) & mask
    while keys[slot] != key and keys[slot] != EMPTY:
        slot = (slot + 1) & mask
    return slot
