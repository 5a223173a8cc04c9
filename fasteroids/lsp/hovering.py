"""What stands at a place: a variable and its type, or a word or sign and what it means."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from attrs import frozen

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import CONSTANT_TYPES, GIVES
from fasteroids.lang.meanings import MEANINGS
from fasteroids.lang.names import shortened
from fasteroids.lang.parser.lexer import NAME, NUMBER
from fasteroids.lang.source import Span
from fasteroids.lang.words import PUNCTUATION
from fasteroids.lsp.reading import Place, Reading

__all__ = ["Hover", "hover"]

_PLAIN: Final = frozenset(PUNCTUATION) - {":="}
"""Signs that nobody asks about."""

_LONGEST: Final = 60
"""Longer expressions are not shown."""

_MOST_LINES: Final = 4
"""Lines of the text that a sentence names."""


@frozen
class Hover:
    """What to show about a piece: a line of code, and sentences, with code in them between backquotes."""

    span: Span
    code: str
    sentences: tuple[str, ...]


def hover(reading: Reading, place: Place) -> Hover | None:
    """What stands at a place; None between the words, in comments, on brackets and the like."""
    index = reading.token_at(place)
    if index is None:
        return None
    kind, span = reading.tokens.kinds[index], reading.tokens.span(index, index)
    if kind == NAME:
        return _of_variable(reading, reading.tokens.texts[index], span)
    if kind == NUMBER:
        return Hover(span, f"{shortened(reading.tokens.texts[index])}: double", ())
    meaning = MEANINGS.get(kind)
    if meaning is None or kind in _PLAIN:
        return None
    typed = _typed(reading, kind, span)
    return Hover(span, typed or meaning.usage, (meaning.sentence,))


def _typed(reading: Reading, kind: str, span: Span) -> str | None:
    """The expression that a word or sign makes, with its type; None if it makes none."""
    if kind in CONSTANT_TYPES:
        return f"{kind}: {CONSTANT_TYPES[kind]}"
    if kind not in GIVES:
        return None
    around = [
        node
        for node, _ in reading.constructs
        if isinstance(node, syntax.Unary | syntax.Binary)
        and node.operator == kind
        and node.span.start <= span.start
        and span.end <= node.span.end
    ]
    # Outer ones come before inner ones.
    shown = _piece(reading, around[-1].span) if around else ""
    return f"{shown or MEANINGS[kind].usage}: {GIVES[kind]}"


def _piece(reading: Reading, span: Span) -> str:
    """A piece of the text, if it is short and in one line."""
    if span.line != span.end_line or span.end_column - span.column > _LONGEST:
        return ""
    return reading.rows[span.line - 1][span.column - 1 : span.end_column - 1]


def _of_variable(reading: Reading, name: str, span: Span) -> Hover:
    shown, kind = shortened(name), reading.type_of(name)
    declared = [each.span.line for each in reading.declarations.get(name, ())]
    uses = reading.uses.get(name, ())
    sets = [use.name.span.line for use in uses if use.how in ("set", "looped")]
    reads = [use.name.span.line for use in uses if use.how not in ("set", "looped")]
    sentences = [
        f"Declared in {_lines(declared)}." if declared else "Not declared.",
        f"Set in {_lines(sets)}." if sets else "Never set.",
        f"Read in {_lines(reads)}." if reads else "Never read.",
    ]
    return Hover(span, f"{kind} {shown}" if kind else shown, tuple(sentences))


def _lines(rows: Sequence[int]) -> str:
    """`line 3`, `lines 3, 5 and 8`, or `lines 3, 5, 8, 9 and 12 more`."""
    each = sorted(set(rows))
    if len(each) == 1:
        return f"line {each[0]}"
    more = len(each) - _MOST_LINES
    last = f"{more} more" if more > 0 else str(each[-1])
    first = each[:_MOST_LINES] if more > 0 else each[:-1]
    return f"lines {', '.join(map(str, first))} and {last}"
