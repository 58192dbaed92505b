"""Two threads for kernels that release the interpreter and write to places of their own."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")


def in_halves(work: Callable[[int, int], None], count: int, worth: int) -> None:
    """Call ``work(start, stop)`` for the two halves of ``range(count)`` at the same time.

    Below ``worth`` a thread costs more than it gives: then it is called once.
    """
    if count < worth:
        work(0, count)
        return
    with ThreadPoolExecutor(1) as pool:
        other = pool.submit(work, count // 2, count)
        work(0, count // 2)
        other.result()


def begin(work: Callable[[], T]) -> Callable[[], T]:
    """Begin ``work`` in a thread of its own; what is returned waits for its result, or raises what it raised.

    Worth it where most of it is kernels, and the caller has other things to do meanwhile.
    """
    pool = ThreadPoolExecutor(1)
    future = pool.submit(work)
    pool.shutdown(wait=False)  # its thread ends with the work
    return future.result
