"""What goes through the pipe between the window and its planner arrives as it was sent."""

from __future__ import annotations

import multiprocessing
import threading

import numpy as np
import pytest

from floorcast_app.workers import wire


def through(message: object) -> object:
    """``message``, sent and received."""
    there, here = multiprocessing.Pipe()
    sending = threading.Thread(target=wire.send, args=(there, message))
    sending.start()
    received = wire.receive(here)
    sending.join()
    return received


@pytest.mark.parametrize("message", ["cancel", None, ("progress", "read", 5), {"a": [1, 2.5]}])
def test_small_messages(message: object) -> None:
    assert through(message) == message


@pytest.mark.parametrize(
    "array",
    [
        np.arange(7, dtype=np.int64),
        np.zeros((0, 3), dtype=np.float32),
        np.random.default_rng(0).random((300_000, 3)),
        np.asfortranarray(np.arange(12.0).reshape(3, 4)),
        np.arange(20)[::2],
        np.array([True, False]),
    ],
)
def test_arrays_keep_values_shape_and_kind(array: np.ndarray) -> None:
    kind, received = through(("points", array))  # type: ignore[misc]
    assert kind == "points" and received.dtype == array.dtype
    np.testing.assert_array_equal(received, array)


def test_many_arrays_and_what_is_shared_among_them() -> None:
    one = np.arange(5.0)
    a, b, c = through([one, one, np.arange(3)])  # type: ignore[misc]
    assert a is b
    np.testing.assert_array_equal(c, [0, 1, 2])


def test_arrays_can_be_written_to() -> None:
    received = through(np.zeros(3))
    received[0] = 1.0  # type: ignore[index]


def test_an_end_that_is_gone_is_told() -> None:
    there, here = multiprocessing.Pipe()
    there.close()
    with pytest.raises((EOFError, OSError)):
        wire.receive(here)
