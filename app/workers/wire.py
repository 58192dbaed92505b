"""Messages between two processes of ours: pickled, with arrays beside the pickle, for they are large.

Both ends are this program, started by this program over a pipe that nobody else can reach; files and
projects are never read this way.
"""

from __future__ import annotations

import pickle
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

ALIGNED = 64  # bytes: where an array begins in a message, as numpy would have it
_SIZES = np.dtype("<i8")


def send(connection: Connection, message: Any) -> None:
    """Send any value; :class:`OSError` where the other end is gone."""
    buffers: list[pickle.PickleBuffer] = []
    body = pickle.dumps(message, protocol=5, buffer_callback=buffers.append)
    parts: list[Any] = [body, *(buffer.raw() for buffer in buffers)]
    sizes = np.array([memoryview(part).nbytes for part in parts], dtype=_SIZES)
    begins = _begins(sizes)
    blob = np.zeros(begins[-1], dtype=np.uint8)
    for part, begin, size in zip(parts, begins[:-1], sizes, strict=True):
        blob[begin : begin + size] = np.frombuffer(part, dtype=np.uint8)
    connection.send_bytes(sizes.tobytes())
    connection.send_bytes(blob)


def receive(connection: Connection) -> Any:
    """The next message, as soon as it is there; :class:`EOFError` or OSError where the other end is gone."""
    sizes = np.frombuffer(connection.recv_bytes(), dtype=_SIZES)
    begins = _begins(sizes)
    blob = np.empty(begins[-1], dtype=np.uint8)
    connection.recv_bytes_into(blob)
    parts = [blob[begin : begin + size] for begin, size in zip(begins[:-1], sizes, strict=True)]
    return pickle.loads(parts[0], buffers=parts[1:])


def _begins(sizes: Any) -> Any:
    """(N + 1,) where each part begins, and where the last one ends."""
    room = (sizes + ALIGNED - 1) // ALIGNED * ALIGNED
    return np.concatenate([[0], np.cumsum(room)])
