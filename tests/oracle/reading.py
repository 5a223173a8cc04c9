"""A second parser for the language, made by lark from `grammar.lark`: what ours is compared with.

It shares the records of the tree with ours and nothing else. It knows no places, stops at the first error, and
has no limit to nesting.
"""

from __future__ import annotations

from math import isinf
from pathlib import Path
from typing import Any

from lark import Lark, Token, Transformer, UnexpectedInput, v_args

from fasteroids.lang import syntax
from fasteroids.lang.syntax import Block, Expression, Program, Statement

__all__ = ["read"]


def read(text: str) -> Program | None:
    """The tree of a text, or None if it is no program."""
    try:
        return _PARSER.parse(text.removeprefix("\ufeff"))  # type: ignore[return-value]
    except (UnexpectedInput, OverflowError):
        return None


@v_args(inline=True)
class _Tree(Transformer[Token, Any]):
    """What each rule gives. The parser calls it as it reduces, so nothing recurses."""

    def program(self, *statements: Statement) -> Program:
        return Program(Block(statements))

    def block(self, *statements: Statement) -> Block:
        return Block(statements)

    def declaration(self, type: Any, name: syntax.Name, *value: Any) -> Statement:
        return syntax.Declaration(str(type), name, value[-1])  # type: ignore[arg-type]

    def assignment(self, name: syntax.Name, value: Expression) -> Statement:
        return syntax.Assignment(name, value)

    def print(self, value: Expression) -> Statement:
        return syntax.Print(value)

    def turn(self, angle: Expression) -> Statement:
        return syntax.Turn(angle)

    def act(self, action: Token) -> Statement:
        return syntax.Act(str(action))  # type: ignore[arg-type]

    def skip(self) -> Statement:
        return syntax.Act("skip")

    def branch(
        self, condition: Expression, then: Block, orelse: Block | syntax.If | None
    ) -> Statement:
        chained = isinstance(orelse, syntax.If)
        return syntax.If(condition, then, Block((orelse,)) if chained else orelse)  # type: ignore[arg-type]

    def loop(self, condition: Expression, body: Block) -> Statement:
        return syntax.While(condition, body)

    def foreach(self, *parts: Any) -> Statement:
        _, _, kind, _, name, *_, body = parts
        return syntax.ForEach(str(kind), name, body)  # type: ignore[arg-type]

    def binary(self, left: Expression, operator: Token, right: Expression) -> Expression:
        return syntax.Binary(str(operator), left, right)

    def unary(self, operator: Token, operand: Expression) -> Expression:
        return syntax.Unary(str(operator), operand)

    def call(
        self, function: Token, _open: Token, argument: Expression, _close: Token
    ) -> Expression:
        return syntax.Unary(str(function), argument)

    def number(self, digits: Token) -> Expression:
        if isinf(float(digits)):
            raise OverflowError(digits)
        return syntax.Number(float(digits))

    def name(self, name: Token) -> Expression:
        return syntax.Name(str(name))

    def true(self) -> Expression:
        return syntax.Truth(True)

    def false(self) -> Expression:
        return syntax.Truth(False)

    def null(self) -> Expression:
        return syntax.Null()

    def own(self) -> Expression:
        return syntax.Self()

    def direction(self) -> Expression:
        return syntax.Direction()


_PARSER = Lark(
    (Path(__file__).parent / "grammar.lark").read_text(encoding="utf-8"),
    start="program",
    parser="lalr",
    # The contextual lexer would take `double := 1;` for an assignment.
    lexer="basic",
    transformer=_Tree(),
    maybe_placeholders=True,
)
