"""The table of high scores: a value, and the text it is kept in.

The text is JSON with a row to a line, so that a row can be read without the others. `table_of` is total: of a damaged
text it keeps every row that can still be read, and says that it is damaged.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from itertools import groupby
from typing import Final

from attrs import Attribute, asdict, field, frozen

from fasteroids.units import ModelError, shown

__all__ = [
    "EMPTY",
    "KEPT",
    "Score",
    "Table",
    "best",
    "entered",
    "merged",
    "place_of",
    "table_of",
    "text_of",
]

KEPT: Final = 10
"""Rows of each mode that are kept."""

_FORMAT: Final = 1
_LONGEST_NAME: Final = 20
_LONGEST_TEXT: Final = 200
_LARGEST: Final = 2**63 - 1
_MOST_TEXT: Final = 1 << 20  # characters looked at; a full table of ten modes has some 20,000
_ROW: Final = re.compile(r"\{[^{}\n]*\}")


def _line(text: str, longest: int) -> str:
    """A text as one line of what can be printed, cut where it is long."""
    if not isinstance(text, str):
        raise ModelError(f"must be text; got {type(text).__name__}")
    printable = "".join(sign if sign.isprintable() else " " for sign in text)
    return " ".join(printable.split())[:longest].rstrip()


def _name(text: str) -> str:
    return _line(text, _LONGEST_NAME)


def _text(text: str) -> str:
    return _line(text, _LONGEST_TEXT)


def _whole(_: object, attribute: Attribute[int], value: int) -> None:
    if not isinstance(value, int) or isinstance(value, bool) or not abs(value) <= _LARGEST:
        raise ModelError(
            f"{attribute.name} must be an integer of at most 63 bits; got {shown(value)}"
        )


@frozen
class Score:
    """What one player reached in one game.

    `mode` names the kind of game that it is compared within, `date` is as the caller says it (ISO 8601 sorts well),
    `recording` is the name of a file. Texts lose what cannot be printed, and what is too long. `ModelError` for a
    number that is no integer of at most 63 bits.
    """

    mode: str = field(converter=_name)
    name: str = field(converter=_name)
    score: int = field(validator=_whole)
    wave: int = field(default=0, validator=_whole, kw_only=True)
    seed: int = field(default=0, validator=_whole, kw_only=True)
    date: str = field(default="", converter=_text, kw_only=True)
    recording: str = field(default="", converter=_text, kw_only=True)


@frozen
class Table:
    """The best of each mode, best first, modes in order of their names; of equal scores the earlier entry is first.

    `damaged`: was there something in the text it comes from that could not be read?
    """

    rows: tuple[Score, ...] = ()
    damaged: bool = False


EMPTY: Final = Table()


def best(table: Table, mode: str) -> tuple[Score, ...]:
    """The rows of a mode, best first."""
    return tuple(row for row in table.rows if row.mode == mode)


def _sorted(rows: Iterable[Score]) -> tuple[Score, ...]:
    ordered = sorted(dict.fromkeys(rows), key=lambda row: (row.mode, -row.score))
    by_mode = groupby(ordered, key=lambda row: row.mode)
    return tuple(row for _, group in by_mode for row in list(group)[:KEPT])


def entered(table: Table, score: Score) -> Table:
    """The table with one more row, if it is among the best of its mode. A row that is in it already counts once."""
    return Table(_sorted((*table.rows, score)), table.damaged)


def merged(a: Table, b: Table) -> Table:
    """The best of both; of equal scores those of `a` are first."""
    return Table(_sorted((*a.rows, *b.rows)), a.damaged or b.damaged)


def place_of(table: Table, score: Score) -> int | None:
    """The place, from 1, that a row has in its mode once it is entered; None if it is not among the best."""
    rows = best(entered(table, score), score.mode)
    return rows.index(score) + 1 if score in rows else None


def text_of(table: Table) -> str:
    """The table as text in ASCII; `table_of` reads the same rows back."""
    # Braces only around rows, so that rows can be found in what is left of a damaged text.
    rows = (
        "{" + json.dumps(asdict(row))[1:-1].replace("{", r"\u007b").replace("}", r"\u007d") + "}"
        for row in table.rows
    )
    inside = ",\n".join(rows)
    return (
        f'{{"fasteroids-scores": {_FORMAT}, "rows": [\n{inside}\n]}}\n'
        if inside
        else (f'{{"fasteroids-scores": {_FORMAT}, "rows": []}}\n')
    )


def table_of(text: str) -> Table:
    """The table in a text; of a damaged one, what can be read. An empty text is an empty table. Never raises."""
    if not text.strip():
        return EMPTY
    found = [_row(match.group()) for match in _ROW.finditer(text[:_MOST_TEXT])]
    rows = _sorted(row for row in found if row is not None)
    # A sound text is the one that its own rows give; so anything else in it shows.
    sound = text == text_of(Table(rows))
    return Table(rows, damaged=not sound)


def _row(text: str) -> Score | None:
    try:
        match json.loads(text):
            case {"mode": str(), "name": str(), "score": int()} as row:
                known = {name: row[name] for name in _FIELDS if name in row}
                return Score(**known)
    except (ValueError, RecursionError):  # no JSON, or what a row does not allow
        return None
    return None


_FIELDS: Final = ("mode", "name", "score", "wave", "seed", "date", "recording")
