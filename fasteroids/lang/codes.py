"""What each code of a diagnostic means: the one table behind `fasteroids explain FA012` and the docs."""

from __future__ import annotations

from typing import Final, Literal

from attrs import frozen

__all__ = ["CODES", "Code", "Phase"]

Phase = Literal["syntax", "type", "lint"]


@frozen
class Code:
    """A kind of fault: its phase, a title of a few words, why it is one, and a program with it and without."""

    phase: Phase
    title: str
    why: str
    wrong: str
    right: str


SYNTAX: Final[dict[str, Code]] = {}
"""FA001 to FA099, by the lexer and the parser."""

TYPE: Final[dict[str, Code]] = {}
"""FA101 to FA199, by the checker."""

CODES: Final[dict[str, Code]] = {**SYNTAX, **TYPE}
"""All of them; FA201 to FA299 are for the lint."""
