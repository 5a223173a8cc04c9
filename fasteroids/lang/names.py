"""Which known word somebody may have meant."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Final

__all__ = ["LONGEST", "closest", "closest_word", "distance", "shortened"]

LONGEST: Final = 32
"""Longer words are not compared, and shown cut: nobody types them twice by hand."""


_DIGITS: Final = re.compile("[0-9]+")


def closest(word: str, candidates: Iterable[str]) -> str | None:
    """The candidate that `word` is most likely a slip for, or None if none is near.

    Near is at most one edit in each three letters of the longer word, so that names of two letters (`ax`, `ay`) are
    never taken for each other; a word that differs in case alone is always near. Words that differ only in their
    digits (`x10`, `x11`) are two names, no slip. Of equally near candidates the first.
    """
    best, fewest = None, None
    for candidate in candidates:
        if candidate == word or max(len(word), len(candidate)) > LONGEST:
            continue
        edits = _edits(word, candidate)
        if edits is not None and (fewest is None or edits < fewest):
            best, fewest = candidate, edits
    return best


def closest_word(word: str, choices: Iterable[str]) -> str | None:
    """The word of the language that `word` is most likely a misspelling of, or None.

    One in another case first; else one of the least edit distance, at most 1 for short words and 2 from six letters
    on; of several one with the same letters, else the first. Insertions, deletions, changes and swaps of neighbours
    count 1 (optimal string alignment). Choices of one or two letters resemble everything, and do not count.
    """
    lowered = word.lower()
    most = 1 if len(word) < 6 else 2
    found: list[tuple[int, bool, str]] = []
    for choice in choices:
        if lowered == choice.lower():
            return choice
        if len(choice) > 2 and abs(len(choice) - len(word)) <= most:
            apart = distance(lowered, choice.lower())
            if apart <= most:
                found.append((apart, sorted(lowered) != sorted(choice.lower()), choice))
    return min(found, key=lambda one: one[:2])[2] if found else None


def _edits(word: str, candidate: str) -> int | None:
    """How many, or None if they are too many for a slip."""
    if word.casefold() == candidate.casefold():
        return 0
    most = max(len(word), len(candidate)) // 3
    if abs(len(word) - len(candidate)) > most or _lettered(word) == _lettered(candidate):
        return None
    edits = distance(word, candidate)
    return edits if edits <= most else None


def _lettered(word: str) -> str:
    return _DIGITS.sub("0", word)


def distance(one: str, other: str) -> int:
    """How many letters must be put in, left out, replaced, or swapped with their neighbours, to turn one into other.

    The optimal string alignment distance (Damerau and Levenshtein; no letter is edited twice).
    """
    before: list[int] = []
    last = list(range(len(other) + 1))
    for i, a in enumerate(one, 1):
        row = [i]
        for j, b in enumerate(other, 1):
            edits = min(last[j] + 1, row[j - 1] + 1, last[j - 1] + (a != b))
            if i > 1 and j > 1 and a == other[j - 2] and b == one[i - 2]:
                edits = min(edits, before[j - 2] + 1)
            row.append(edits)
        before, last = last, row
    return last[-1]


def shortened(name: str) -> str:
    """A name as it is shown in a sentence: a very long one is cut."""
    return name if len(name) <= LONGEST else f"{name[: LONGEST - 3]}..."
