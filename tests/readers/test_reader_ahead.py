"""Chunks that are read ahead come in order and once, with their errors and warnings in their places."""

from __future__ import annotations

import threading
import time

import pytest

from floorplan_core.errors import InputError
from floorplan_core.observer import Observer
from floorplan_core.readers.ahead import DEPTH, FILES, Ahead, RelayedObserver, read_ahead


class Listener(Observer):
    def __init__(self):
        super().__init__()
        self.heard = []

    def warning(self, text):
        self.heard.append((text, threading.current_thread()))


def reading_threads():
    return [t for t in threading.enumerate() if t.name == "reading ahead"]


def test_several_passes_in_their_order():
    def numbers(k):
        for i in range(5):
            time.sleep(0.001 * ((k + i) % 3))
            yield 10 * k + i

    found = list(read_ahead([lambda k=k: numbers(k) for k in range(7)]))
    assert found == [(k, 10 * k + i) for k in range(7) for i in range(5)]
    assert not reading_threads()


def test_no_more_is_read_than_is_bounded():
    begun, read = [], []

    def numbers(k):
        begun.append(k)
        for i in range(100):
            read.append((k, i))
            yield i

    items = read_ahead([lambda k=k: numbers(k) for k in range(20)])
    next(items)
    time.sleep(0.3)
    assert len(begun) == FILES
    assert max(i for _, i in read) <= DEPTH + 1
    items.close()
    assert not reading_threads()


def test_errors_come_where_they_happened():
    def broken():
        yield 1
        yield 2
        raise InputError("cut off.")

    items = read_ahead([broken])
    assert [next(items), next(items)] == [(0, 1), (0, 2)]
    with pytest.raises(InputError):
        next(items)
    assert not reading_threads()


def test_warnings_are_told_by_the_thread_that_takes_the_chunks():
    listener = Listener()
    relay = RelayedObserver(listener)
    late = threading.Event()

    def first():
        late.wait(5)
        yield "a"
        relay.warning("of the first")

    def second():
        relay.warning("of the second")
        late.set()
        yield "b"

    found = []
    for number, item in read_ahead([first, second], relay):
        found.append((number, item, [text for text, _ in listener.heard]))
    assert found == [(0, "a", []), (1, "b", ["of the first", "of the second"])]
    assert {thread for _, thread in listener.heard} == {threading.current_thread()}
    relay.warning("outside")
    assert listener.heard[-1][0] == "outside"


def test_what_is_left_early_lets_its_file_go():
    closed = threading.Event()

    def endless():
        try:
            while True:
                yield 0
        finally:
            closed.set()

    with Ahead(endless) as items:
        assert next(iter(items)) == 0
    assert closed.is_set()
