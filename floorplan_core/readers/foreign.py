"""What readers on other people's libraries share: a missing library, a damaged file, spread samples."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from floorplan_core.errors import FloorPlanError, InputError, let_interrupt_through
from floorplan_core.readers.records import join_chunks
from floorplan_core.readers.source import SAMPLE_POINTS, RawChunk

REASON_LENGTH = 120  # characters of a library's own message that are passed on


def import_library(module: str, package: str, purpose: str) -> Any:
    """The library ``module``; :class:`InputError` that names the pip ``package`` where it is missing."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        let_interrupt_through(error)
        raise InputError(
            f"Reading {purpose} needs the library {module}, which cannot be loaded; "
            f"install it with: pip install '{package}'."
        ) from error


@contextmanager
def damaged(name: str, what: str, advice: str = "") -> Iterator[None]:
    """Whatever a library raises over a damaged file becomes an :class:`InputError`; cancelling passes.

    ``advice`` ends the sentence (from its semicolon on).

    Libraries written in Rust panic with exceptions that are no :class:`Exception`: these are meant, too.
    """
    try:
        yield
    except (FloorPlanError, KeyboardInterrupt, SystemExit, GeneratorExit):
        raise
    except OSError as error:
        raise InputError(f"Cannot read {name}: {error.strerror or _reason(error)}.") from error
    except BaseException as error:
        let_interrupt_through(error)
        raise InputError(
            f"{name} is no {what} that can be read, or is damaged ({_reason(error)}){advice}."
        ) from error


def _reason(error: BaseException) -> str:
    text = " ".join(str(error).partition("****")[0].split()).rstrip(".")[:REASON_LENGTH]  # of libE57
    return text or type(error).__name__


def spread_sample(parts: Sequence[RawChunk]) -> RawChunk:
    """At most about ``SAMPLE_POINTS`` points, as many from each part of what was read."""
    each = max(1, SAMPLE_POINTS // max(1, len(parts)))
    held = [part for part in parts if len(part.points)] or parts[:1]
    return join_chunks([_thinned(part, each) for part in held])


def _thinned(chunk: RawChunk, count: int) -> RawChunk:
    """``count`` points spread evenly over a chunk, moved by its pose where it has one."""
    step = max(1, -(-len(chunk.points) // count))
    points = chunk.points[::step]
    if chunk.T_file_sensor is not None:
        points = moved(points, chunk.T_file_sensor)
    ids = None if chunk.scan_id is None else chunk.scan_id[::step]
    return RawChunk(points, ids, None if chunk.stamps is None else chunk.stamps[::step])


def moved(points: NDArray[Any], T: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N, 3) points of a sensor's frame in file coordinates."""
    with np.errstate(over="ignore", invalid="ignore"):
        return np.asarray(points.astype(np.float64) @ T[:3, :3].T + T[:3, 3])
