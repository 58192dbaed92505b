"""The kernel for numbers in text, against Python's own parser."""

import numpy as np
import pytest

from floorplan_core.readers import text_rows
from floorplan_core.readers.plain_numbers import parse_numbers
from floorplan_core.readers.text_rows import TextLayout, parse_block


def numbers(rng, count):
    """Numbers as programs write them, all with few enough digits."""
    forms = ("{:.4f}", "{:.3e}", "{:.0f}", "{:+.6f}", "{:.9g}", "{:E}")
    values = rng.normal(0, 1, count) * 10.0 ** rng.integers(-4, 7, count)
    return [forms[k].format(v) for k, v in zip(rng.integers(0, len(forms), count), values, strict=True)]


def test_every_bit_as_by_python():
    words = [
        *numbers(np.random.default_rng(5), 29_990),
        *["0", "-0", "-0.0", ".5", "5.", "1e22", "1e-22", "9007199254740.5", "0007", "1E+2"],
    ]
    text = "".join(" ".join(words[k : k + 3]) + "\n" for k in range(0, len(words), 3)).encode()
    found = parse_numbers(text, 3, (0, 1, 2))
    wanted = np.array([float(word) for word in words]).reshape(-1, 3)
    assert found.tobytes() == wanted.tobytes()


@pytest.mark.parametrize("end", [b"", b"\n", b"\r\n", b" \t\n", b" "])
def test_ends_and_spaces(end):
    assert parse_numbers(b"1\t2  3 \r\n 4 5 6" + end, 3, (0, 1, 2)).tolist() == [[1, 2, 3], [4, 5, 6]]


@pytest.mark.parametrize(
    "text",
    [b"1 2\n", b"1 2 3 4\n", b"\n1 2 3\n", b"1 2 x\n", b"1 2 nan\n", b"1 2 3e\n", b"1 2 1.2.3\n", b"1 2 -\n",
     b"1 2 3f\n", b"1 2 .\n", b"1 2 1e23\n", b"1 2 90071992547409931\n", b"1 2 1e999999999\n", b"1 2 3,4\n"],
)  # fmt: skip
def test_what_is_not_plain_is_left_to_others(text):
    assert parse_numbers(text, 3, (0, 1, 2)) is None


def test_no_rows():
    assert parse_numbers(b"", 3, (0, 1, 2)).shape == (0, 3)


def test_other_columns_may_hold_words():
    text = b"wall,1,nan, 2.5,3\nfloor,-4,99999999999999999999,5,6\n"
    assert parse_numbers(text, 5, (1, 4, 3), ",").tolist() == [[1, 3, 2.5], [-4, 6, 5]]
    assert parse_numbers(b"a;1,5;2;3,25\n", 4, (1, 2, 3), ";", ",").tolist() == [[1.5, 2, 3.25]]
    assert parse_numbers(b"# 1 2 3\n", 4, (1, 2, 3)) is None
    assert parse_numbers(b"1 2 3 #4\n", 4, (0, 1, 2)) is None


@pytest.mark.parametrize(
    "form", [(), (3, None), (None, 3), (None, None, ","), (3, None, ";"), (None, 3, ";", True)]
)
def test_a_block_is_the_same_with_and_without_the_kernel(monkeypatch, form):
    rng = np.random.default_rng(2)
    rows = [" ".join(numbers(rng, 4)) for _ in range(500)]
    rows[77] = "12345678901234567890.5 1 2 3"  # more digits than the kernel takes
    layout = TextLayout(0, 4, (0, 1, 2), *form)
    separator, comma = (layout.separator, "," if layout.decimal_comma else ".")
    rows = [row.replace(".", comma).replace(" ", separator) for row in rows]
    for lines in (rows[:70], rows, [*rows[:9], "no point", *rows[9:20]]):
        block = ("\n".join(lines) + "\n").encode()
        monkeypatch.setattr(text_rows, "KERNEL_FROM", 0)
        fast = parse_block(block, layout)
        monkeypatch.setattr(text_rows, "KERNEL_FROM", 1 << 30)
        slow = parse_block(block, layout)
        assert fast.points.tobytes() == slow.points.tobytes()
        assert np.array_equal(fast.stamps, slow.stamps) and np.array_equal(fast.scan_id, slow.scan_id)
        assert fast.dropped == slow.dropped
