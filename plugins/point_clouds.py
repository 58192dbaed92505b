"""Readers that ship: point clouds and folders of scans whose formats need nothing but numpy."""

from floorplan_core.api import Reader, hookimpl


@hookimpl
def floorcast_readers() -> list[Reader]:
    from floorplan_core.readers import builtin_readers

    return list(builtin_readers())
