"""What the first plan needs is loaded beforehand; the program does not wait for it when it ends."""

from __future__ import annotations

import numpy as np

from floorcast_app.warm_up import SIZE, WarmUp, box
from floorplan_core.pipeline import FloorPlanner


def test_the_box_is_a_room() -> None:
    planner = FloorPlanner()
    eye = np.eye(4)
    eye[:3, 3] = np.array(SIZE) / 2
    planner.integrate(box() - eye[:3, 3], eye)
    (room,) = planner.plan().regions
    assert abs(room.area - SIZE[0] * SIZE[1]) < 0.3


def test_it_can_be_stopped_at_once() -> None:
    warming = WarmUp()
    warming.start()
    warming.stop()
    assert not warming._thread.is_alive()
