"""Fuzzy matching for the command palette: letters in order, better at the start of words or together."""

from __future__ import annotations

WORD_START = 8  # points for a letter that begins a word
TOGETHER = 5  # points for a letter right after the one before
PLAIN = 1
SPREAD = 0.1  # points off for each letter that the text is longer


def score(typed: str, text: str) -> float | None:
    """How well ``text`` fits what was typed, word by word in any order; None where a word does not fit.

    >>> score("fe", "File: export") > score("fe", "Free space")
    True
    >>> score("xyz", "File: export") is None
    True
    """
    low, total = text.casefold(), -SPREAD * len(text)
    for word in typed.casefold().split():
        best = _best(word, low)
        if best is None:
            return None
        total += best
    return total


def _best(typed: str, text: str) -> float | None:
    """The best way to place all letters in order: one row of a dynamic programme for each letter."""
    nothing = float("-inf")
    row = [_points(text, i) if c == typed[0] else nothing for i, c in enumerate(text)]
    for letter in typed[1:]:
        new, best_before = [nothing] * len(text), nothing
        for i, c in enumerate(text):
            if c == letter:
                near = row[i - 1] + TOGETHER if i else nothing
                new[i] = _points(text, i) + max(best_before, near)
            best_before = max(best_before, row[i])
        row = new
    best = max(row, default=nothing)
    return None if best == nothing else best


def _points(text: str, i: int) -> int:
    return WORD_START if i == 0 or not text[i - 1].isalnum() else PLAIN
