"""The tree of a program: one frozen record a construct (assignment 1.8.1, 1.8.2).

Trees are equal when they mean the same text in normal form: places, parentheses, comments, noise words (`do`, `then`)
and lone semicolons are not in them. Every node has the `span` of its text.

Where the parser could not read something it puts `Missing`, so that the rest of a broken text still has a tree. Such
a tree never runs.
"""

from __future__ import annotations

from typing import Final, Literal

from attrs import field, frozen

from fasteroids.lang.source import NOWHERE, Span

__all__ = [
    "MOST_NESTED",
    "Act",
    "Assignment",
    "Binary",
    "Block",
    "Declaration",
    "Direction",
    "Expression",
    "ForEach",
    "If",
    "Kind",
    "Missing",
    "Name",
    "Null",
    "Number",
    "Print",
    "Program",
    "Self",
    "Statement",
    "Truth",
    "Turn",
    "Type",
    "Unary",
    "While",
]

MOST_NESTED: Final = 100
"""A tree has at most this many nodes from its root to any leaf: blocks, statements and expressions together.

Parsed text keeps to it (else `FA` error), so everything that walks a tree may recurse."""

Type = Literal["bool", "double", "entity"]
Kind = Literal["ship", "asteroid", "bullet", "any"]


# Expressions.


@frozen
class Number:
    """A constant: a finite double, 0 or more (a minus sign is an operator)."""

    value: float
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Truth:
    """`true` or `false`."""

    value: bool
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Null:
    """`null`: no entity."""

    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Self:
    """`self`: the ship that runs the program."""

    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Direction:
    """`getdir`: where that ship faces, rad in [0, 2 pi)."""

    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Name:
    """A variable."""

    name: str
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Unary:
    """`-e`, `!e`, `getx e` and its like, `sqrt(e)`, `sin(e)`, `cos(e)`."""

    operator: str
    operand: Expression
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Binary:
    """`left operator right`."""

    operator: str
    left: Expression
    right: Expression
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Missing:
    """An expression that could not be read."""

    span: Span = field(default=NOWHERE, eq=False)


Expression = Number | Truth | Null | Self | Direction | Name | Unary | Binary | Missing


# Statements.


@frozen
class Block:
    """Statements one after another; the body of a program, between braces elsewhere."""

    statements: tuple[Statement, ...] = ()
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Declaration:
    """`type name;` or `type name := value;`: a global variable, wherever it stands.

    The value is assigned each time the statement is met, as by an `Assignment`.
    """

    type: Type
    target: Name
    value: Expression | None = None
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Assignment:
    """`target := value;`"""

    target: Name
    value: Expression
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class If:
    """`if condition { } else { }`; `else if` is an `orelse` of one statement, an `If`."""

    condition: Expression
    then: Block
    orelse: Block | None = None
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class While:
    """`while condition { }`"""

    condition: Expression
    body: Block
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class ForEach:
    """`foreach (kind, variable) { }`"""

    kind: Kind
    variable: Name
    body: Block
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Print:
    """`print value;`"""

    value: Expression
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Turn:
    """`turn angle;` (rad)"""

    angle: Expression
    span: Span = field(default=NOWHERE, eq=False)


@frozen
class Act:
    """`fire;`, `thrust;`, `thrust_off;` or `skip;`"""

    action: Literal["fire", "thrust", "thrust_off", "skip"]
    span: Span = field(default=NOWHERE, eq=False)


Statement = Declaration | Assignment | If | While | ForEach | Print | Turn | Act


@frozen
class Program:
    """A whole program: its main statement, with the declarations in it (1.8), and the text it was read from."""

    body: Block
    source: str = field(default="", eq=False, repr=False)
