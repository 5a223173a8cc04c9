"""The variables of a program: where each is declared, how each is used, and what type the uses ask for.

A use is *hard* evidence of a type if it says so by itself (`x == null`), *soft* if it depends on the declared type of
another variable (`x := y`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final, Literal

from attrs import frozen

from fasteroids._raw import raw
from fasteroids.lang import syntax
from fasteroids.lang.checker.types import EQUALITIES, wants
from fasteroids.lang.syntax import Declaration, Expression, ForEach, Name, Program, Statement, Type

__all__ = ["Construct", "How", "Node", "Use", "constructs", "declarations", "uses"]

Node = Statement | Expression
Construct = tuple[Node, ForEach | None]
"""A statement or an operator, and the outermost for-each that it is in."""
How = Literal["set", "compared", "looped", "used"]


@frozen(weakref_slot=False)
class Use:
    """A variable at one place of the text."""

    name: Name
    wanted: Type | None
    """The type that the construct around asks of it; None if any will do, or if it is not evident."""
    how: How
    other: str | None = None
    """The variable that it is set to, set from, or compared with, if it is one: both are of one type."""


_use = raw(Use)


def constructs(tree: Program) -> list[Construct]:
    """Every statement and every operator, each before what is in it, in the order of the text.

    With each comes the outermost for-each around it. Blocks are passed over, and so are the leaves: names and
    constants are told by the construct they stand in (`wants`).
    """
    found: list[Construct] = []
    todo: list[Construct] = [(each, None) for each in _backwards(tree.body)]
    while todo:
        construct = todo.pop()
        found.append(construct)
        node, loop = construct
        match node:
            case syntax.If(_, then, orelse):
                todo += [(each, loop) for each in (*_backwards(orelse), *_backwards(then))]
            case syntax.While(_, body):
                todo += [(each, loop) for each in _backwards(body)]
            case syntax.ForEach(_, _, body):
                todo += [(each, loop or node) for each in _backwards(body)]
                continue
        parts = [each for each, _ in wants(node, _NOTHING) if isinstance(each, _OPERATORS)]
        todo += [(each, loop) for each in reversed(parts)]
    return found


_NOTHING: Final[Mapping[str, Type]] = {}
_OPERATORS: Final = (syntax.Unary, syntax.Binary)


def _backwards(block: syntax.Block | None) -> tuple[Statement, ...]:
    return block.statements[::-1] if block is not None else ()


def declarations(program: Iterable[Construct]) -> dict[str, list[Declaration]]:
    """All declarations of each name, in the order of the text."""
    found: dict[str, list[Declaration]] = {}
    for node, _ in program:
        if isinstance(node, Declaration) and node.target.name:
            found.setdefault(node.target.name, []).append(node)
    return found


def uses(program: Iterable[Construct], variables: Mapping[str, Type]) -> dict[str, list[Use]]:
    """The uses of each name in the order of the text; a declaration without a value is none.

    `variables` are the types taken for granted: none, to get the hard evidence alone.
    """
    found: dict[str, list[Use]] = {}
    for node, _ in program:
        asked = [*wants(node, variables)]
        for i, (expression, wanted) in enumerate(asked):
            if not isinstance(expression, Name) or not expression.name:
                continue
            other = None
            if len(asked) == 2 and _agree(node):
                partner = asked[1 - i][0]
                other = partner.name if isinstance(partner, Name) else None
            use = _use(expression, wanted, _how(node, expression), other)
            found.setdefault(expression.name, []).append(use)
    for each in found.values():
        each.sort(key=lambda use: use.name.span)
    return found


def _agree(node: Node) -> bool:
    """Must the two expressions of this construct be of one type, whichever it is?"""
    return not isinstance(node, syntax.Binary) or node.operator in EQUALITIES


def _how(node: Node, name: Name) -> How:
    match node:
        case syntax.Assignment(target) | syntax.Declaration(_, target) if target is name:
            return "set"
        case syntax.ForEach():
            return "looped"
        case syntax.Binary(operator) if operator in EQUALITIES:
            return "compared"
        case _:
            return "used"
