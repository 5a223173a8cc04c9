"""Hypothesis strategies for any tree the grammar of the language knows, whatever it means.

For laws about text: reading, printing, complaining. Variables may be undeclared, types may be mixed, actions may stand
inside a for-each; names may look like words of the language, numbers be as large or small as doubles are. What is
deep is so in each way there is: expressions to the left, to the right, under prefix operators, blocks, and chains of
`else if`. No tree is deeper than half of `MOST_NESTED`, so that there is room for parentheses nobody needs.
"""

from __future__ import annotations

from typing import Final

from hypothesis import strategies as st

from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Name,
    Null,
    Print,
    Program,
    Self,
    Statement,
    Truth,
    Turn,
    Unary,
    While,
)
from fasteroids.lang.words import ACTIONS, BINARY, CALLS, KEYWORDS, TYPES, UNARY
from fasteroids.testing.programs import KINDS, numbers

__all__ = ["names", "trees"]

_LETTERS: Final = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

names: Final[st.SearchStrategy[Name]] = st.one_of(
    st.sampled_from(["a", "b", "x"]),
    # Words with a letter more, less or of another size, and what looks like an exponent.
    st.sampled_from(["Thrust", "thrust_", "thrust_of", "thrust_offf", "getx1", "iff", "e1", "E"]),
    st.builds(
        str.__add__,
        st.sampled_from(_LETTERS),
        st.text(_LETTERS + "0123456789_", max_size=8),
    ).map(lambda name: f"{name}_" if name in KEYWORDS else name),
).map(Name)
"""Variables: a few names that come often, and any others."""

_unary = st.sampled_from([*UNARY, *CALLS])
_binary = st.sampled_from(list(BINARY))
_leaves: Final[st.SearchStrategy[Expression]] = st.one_of(
    names, numbers, st.builds(Null), st.builds(Truth, st.booleans()), st.builds(Self),
    st.builds(Direction),
)  # fmt: skip

_forms: Final = st.sampled_from(["leaf", "leaf", "binary", "binary", "unary", "spine"])


@st.composite
def _expression(draw: st.DrawFn, room: int = 3) -> Expression:
    match draw(_forms) if room else "leaf":
        case "binary":
            inner = _expression(room - 1)
            return Binary(draw(_binary), draw(inner), draw(inner))
        case "unary":
            return Unary(draw(_unary), draw(_expression(room - 1)))
        case "spine":
            return draw(_spine())
    return draw(_leaves)


@st.composite
def _spine(draw: st.DrawFn) -> Expression:
    """A deep expression: from the innermost on, each the left, right or only operand of the next."""
    tree = draw(_leaves)
    for form, operator in draw(_vertebrae):
        match form:
            case "left":
                tree = Binary(operator, tree, draw(_leaves))
            case "right":
                tree = Binary(operator, draw(_leaves), tree)
            case _:
                tree = Unary(operator, tree)
    return tree


_vertebrae: Final = st.lists(
    st.one_of(
        st.tuples(st.just("only"), _unary), st.tuples(st.sampled_from(["left", "right"]), _binary)
    ),
    min_size=1,
    max_size=24,
)


@st.composite
def _block(draw: st.DrawFn, room: int) -> Block:
    return Block(tuple(draw(st.lists(_statement(room), max_size=3))))


_simple: Final[st.SearchStrategy[Statement]] = st.one_of(
    st.builds(Act, st.sampled_from([a for a in ACTIONS if a != "turn"])),
    st.builds(Print, _expression()),
    st.builds(Turn, _expression()),
    st.builds(Assignment, names, _expression()),
    st.builds(Declaration, st.sampled_from(TYPES), names, st.none() | _expression()),
)


_constructs: Final = st.sampled_from([*["simple"] * 3, "if", "chain", "while", "foreach"])
_kinds: Final = st.sampled_from(KINDS)


@st.composite
def _statement(draw: st.DrawFn, room: int) -> Statement:
    match draw(_constructs) if room else "simple":
        case "if":
            condition, then = draw(_expression()), draw(_block(room - 1))
            return If(condition, then, draw(st.none() | _block(room - 1)))
        case "chain":
            return draw(_chain(room))
        case "while":
            return While(draw(_expression()), draw(_block(room - 1)))
        case "foreach":
            kind, name = draw(_kinds), draw(names)
            return ForEach(kind, name, draw(_block(room - 1)))
    return draw(_simple)


@st.composite
def _chain(draw: st.DrawFn, room: int) -> Statement:
    """An if with some `else if`."""
    last = draw(st.none() | _block(room - 1))
    tree = If(draw(_expression()), draw(_block(room - 1)), last)
    for _ in range(draw(st.integers(1, 3))):
        tree = If(draw(_expression()), draw(_block(room - 1)), Block((tree,)))
    return tree


@st.composite
def trees(draw: st.DrawFn) -> Program:
    """Any program that text can give, mostly ill-typed."""
    return Program(Block(tuple(draw(st.lists(_statement(2), max_size=4)))))
