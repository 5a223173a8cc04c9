"""Seeds in short: "0-3 5 9-12"."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby
from typing import Final

__all__ = ["MOST_SEEDS", "in_short", "seeds_of"]

MOST_SEEDS: Final = 100_000

_PIECE: Final = re.compile(r"([0-9]{1,18})(?:-([0-9]{1,18}))?")


def seeds_of(text: str) -> tuple[int, ...]:
    """The seeds of a text such as "7", "0-299" or "1,4,9-12", in order, each once. Blanks do as well as commas.

    `ValueError` with a sentence if it is none, or if there are more than `MOST_SEEDS`.
    """
    found: set[int] = set()
    for piece in re.split(r"\s*,\s*|\s+", text.strip()):
        match = _PIECE.fullmatch(piece)
        if match is None:
            raise ValueError(f"must be seeds such as 7, 0-299 or 1,4,9-12; got {text!r}")
        first, last = int(match[1]), int(match[2] or match[1])
        if last < first:
            raise ValueError(f"{piece} runs backwards; write {last}-{first}")
        found.update(range(first, min(last, first + MOST_SEEDS) + 1))  # enough to see if too many
        if len(found) > MOST_SEEDS:
            raise ValueError(f"must be {MOST_SEEDS:,} seeds at most")
    return tuple(sorted(found))


def in_short(seeds: Iterable[int]) -> str:
    """Seeds in order, each once, with those in a row as a range; `seeds_of` reads it. Nothing for none."""
    rows = groupby(enumerate(sorted(set(seeds))), key=lambda pair: pair[1] - pair[0])
    runs = [[seed for _, seed in row] for _, row in rows]
    return " ".join(str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)
