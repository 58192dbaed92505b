"""Runs of True in a row of cells."""

from __future__ import annotations

from itertools import groupby

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from floorplan_core.geometry.runs import runs_of


@given(st.lists(st.booleans(), max_size=40))
def test_runs_are_those_of_plain_python(cells):
    expected = []
    for value, group in groupby(enumerate(cells), key=lambda pair: pair[1]):
        places = [place for place, _ in group]
        if value:
            expected.append([places[0], places[-1] + 1])
    assert runs_of(np.array(cells, dtype=bool)).tolist() == expected
