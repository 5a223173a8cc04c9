"""Where a variable is declared, set and read, and how to give it another name.

All variables are global: a name means the same wherever it stands in a text.
"""

from __future__ import annotations

from attrs import frozen

from fasteroids.lang import syntax
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.names import shortened
from fasteroids.lang.parser.lexer import END, NAME, quoted, tokens
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Type
from fasteroids.lang.words import KEYWORDS
from fasteroids.lsp.reading import Place, Reading

__all__ = [
    "Mention",
    "Refused",
    "Symbol",
    "definitions",
    "mentions",
    "renamed",
    "symbols",
    "variable_at",
]


@frozen
class Mention:
    """A place where a variable is named. `sets` where it gets a value, `declares` in its declaration."""

    span: Span
    sets: bool
    declares: bool


@frozen
class Symbol:
    """A declaration: the variable and its type, all of it and the name alone."""

    name: str
    type: Type
    span: Span
    name_span: Span


@frozen
class Refused:
    """Why something cannot be done: a sentence without a full stop."""

    reason: str


def variable_at(reading: Reading, place: Place) -> tuple[str, Span] | Refused:
    """The variable named at a place, and where it stands exactly."""
    index = reading.token_at(place)
    kind = None if index is None or reading.in_comment(place) else reading.tokens.kinds[index]
    if index is not None and kind == NAME:
        return reading.tokens.texts[index], reading.tokens.span(index, index)
    if kind in KEYWORDS:
        return Refused(f"`{kind}` is a word of the language; only variables can be renamed")
    return Refused("There is no variable here")


def definitions(reading: Reading, place: Place) -> list[Span]:
    """The names in the declarations of the variable at a place: one in a program without errors."""
    found = variable_at(reading, place)
    if isinstance(found, Refused):
        return []
    return [each.target.span for each in reading.declarations.get(found[0], ())]


def mentions(reading: Reading, place: Place) -> list[Mention]:
    """All places that name the variable at a place, in the order of the text."""
    found = variable_at(reading, place)
    if isinstance(found, Refused):
        return []
    name, _ = found
    declared = {each.target.span for each in reading.declarations.get(name, ())}
    uses = reading.uses.get(name, ())
    sets = {use.name.span for use in uses if use.how in ("set", "looped")}
    return [Mention(span, span in sets, span in declared) for span in reading.names[name]]


def symbols(reading: Reading) -> list[Symbol]:
    """The declarations, in the order of the text."""
    return [
        Symbol(node.target.name, node.type, node.span, node.target.span)
        for node, _ in reading.constructs
        if isinstance(node, syntax.Declaration) and node.target.name
    ]


def renamed(reading: Reading, place: Place, new: str) -> tuple[Edit, ...] | Refused:
    """What gives the variable at a place another name everywhere; or why that cannot be."""
    found = variable_at(reading, place)
    if isinstance(found, Refused):
        return found
    name, _ = found
    if new == name:
        return ()
    if new in KEYWORDS:
        return Refused(f"`{new}` is a word of the language, and no variable may have its name")
    read = tokens(new)[0]
    if read.kinds != [NAME, END, END] or read.texts[0] != new:
        return Refused(
            f"{quoted(new)} is no name: a name is a letter from a to z or A to Z, then such letters, digits and `_`"
        )
    if new in reading.names:
        return Refused(f"`{shortened(new)}` is another variable already")
    return tuple(Edit(span, new) for span in reading.names[name])
