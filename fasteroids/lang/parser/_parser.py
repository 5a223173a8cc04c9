"""From text to a tree, by recursive descent, with every syntax error of the text in one run.

`parse_program` is total: it takes any text and raises nothing. It goes in three passes: the lexer cuts the text into
tokens, `_braces` balances the braces, and a parser reads statements and expressions. On an error the parser guesses
what was meant where that is clear (`=` for `:=`), and else skips to a `;`, a brace or a word that starts a statement.
Where nothing could be read the tree has `Missing`, so that a checker can go on to the other faults of the text.

Beyond the grammar of the assignment (1.8.1, 1.8.2) the language has what the parser of 2013 took, and a little more:
declarations anywhere, with or without a value; `do` and `then`; no `else`; `else if`; conditions without parentheses;
lone semicolons; `skip` without one; `%` and unary `-`; comments.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from attrs import frozen

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.parser._braces import balance
from fasteroids.lang.parser._fixes import in_order
from fasteroids.lang.parser._heads import Heads
from fasteroids.lang.parser.lexer import END, NAME, decoded, tokens
from fasteroids.lang.source import NOWHERE, Span
from fasteroids.lang.syntax import (
    MOST_NESTED,
    Act,
    Assignment,
    Block,
    Declaration,
    ForEach,
    If,
    Kind,
    Missing,
    Name,
    Print,
    Program,
    Statement,
    Turn,
    Type,
    While,
)

__all__ = ["Parsed", "decoded", "parse_bytes", "parse_program"]


@frozen
class Parsed:
    """What a text is: a tree, whole or with gaps, and its syntax errors in the order of their places."""

    tree: Program
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def program(self) -> Program | None:
        """The tree, or None if the text has an error."""
        return None if any(fault.severity == "error" for fault in self.diagnostics) else self.tree


def parse_program(text: str) -> Parsed:
    """Read a program. Any text is allowed; what is wrong with it is in `.diagnostics`, one for each place.

    The tree has at most `MOST_NESTED` nodes from its root to any leaf, and spans within the text, also after errors.
    """
    found, faults = tokens(text)
    found, unclosed = balance(found, text)
    parser = _Parser(found, faults + unclosed)
    tree = Program(parser.program(), text)
    return Parsed(tree, in_order(parser.faults, text))


def parse_bytes(data: bytes) -> Parsed:
    """Read a program from the bytes of a file, which should be UTF-8. What is not, is an error at its place."""
    text, undecodable = decoded(data)
    parsed = parse_program(text)
    if not undecodable:
        return parsed
    others = [fault for fault in parsed.diagnostics if fault.code != "FA002"]
    return Parsed(parsed.tree, in_order([*undecodable, *others], text))


class _Parser(Heads):
    """Reads statements. A method reads one kind, at the depth its node has in the tree, from its first token."""

    def program(self) -> Block:
        """The whole text."""
        last = len(self.kinds) - 3
        statements = self.statements(2)
        assert self.kinds[self.at] == END, "the parser stopped before the end"
        return Block(statements, self.span(0, last) if last >= 0 else NOWHERE)

    def statements(self, depth: int) -> tuple[Statement, ...]:
        """Statements up to the `}` that ends them or to the end of the text."""
        kinds = self.kinds
        read: list[Statement] = []
        while True:
            kind = kinds[self.at]
            if kind == ";":
                self.at += 1
                continue
            if kind == "}" or kind == END or self.at == self.closer:
                return tuple(read)
            if depth >= MOST_NESTED and (depth > MOST_NESTED or kind not in _BARE):
                self.too_deep_block()
                continue
            method = _STATEMENTS.get(kind, _Parser.no_statement)
            statement = method(self, depth)
            if statement is not None:
                read.append(statement)

    def statement(self, depth: int) -> Statement | None:
        """One statement; None if it could not be read."""
        return _STATEMENTS.get(self.kinds[self.at], _Parser.no_statement)(self, depth)

    def declaration(self, depth: int) -> Statement | None:
        """`type name;` or `type name := e;`"""
        first = self.at
        kind: Type = self.kinds[first]  # type: ignore[assignment]
        self.at = first + 1
        name = self.name()
        if name is None:
            return None
        if self.kinds[self.at] == ";":
            self.at += 1
            return Declaration(kind, name, None, self.span(first, self.at - 1))
        value = None
        if self.kinds[self.at] == ":=" or self.assigns():
            self.at += 1
            value = self.expression(depth + 1)
        self.several(kind)
        return Declaration(kind, name, value, self.ended(first))

    def assignment(self, depth: int) -> Statement | None:
        """`x := e;`, or whatever else starts with a name."""
        first = self.at
        if self.kinds[first + 1] != ":=":
            return self.no_assignment(depth)
        target = Name(self.texts[first], self.span(first, first))
        self.at = first + 2
        value = self.expression(depth + 1)
        return Assignment(target, value, self.ended(first))

    def print(self, depth: int) -> Statement:
        """`print e;`"""
        first = self.at
        self.at = first + 1
        value = self.expression(depth + 1)
        return Print(value, self.ended(first))

    def turn(self, depth: int) -> Statement:
        """`turn e;`"""
        first = self.at
        self.at = first + 1
        angle = self.expression(depth + 1)
        return Turn(angle, self.ended(first))

    def act(self, depth: int) -> Statement | None:
        """`fire;`, `thrust;`, `thrust_off;`, `skip;` and `skip`."""
        del depth
        first = self.at
        kind = self.kinds[first]
        self.at = first + 1
        if self.kinds[self.at] == ";":
            self.at += 1
        elif kind != "skip" or self.takes_something():
            meant = self.bare(first)
            if meant is None:
                return None
            kind = meant
            if kind != "skip" or self.kinds[self.at] == ";":
                self.ended(first)
        return Act(kind, self.span(first, self.at - 1))  # type: ignore[arg-type]

    def while_(self, depth: int) -> Statement:
        """`while e [do] { }`"""
        first = self.at
        self.at = first + 1
        condition = self.expression(depth + 1)
        body = self.body(first, depth + 1, "do")
        return While(condition, body, self.span(first, self.at - 1))

    def if_(self, depth: int) -> Statement:
        """`if e [then] { }` and its `else`."""
        first = self.at
        self.at = first + 1
        condition = self.expression(depth + 1)
        then = self.body(first, depth + 1, "then")
        orelse = self.otherwise(first, depth + 1) if self.else_follows() else None
        return If(condition, then, orelse, self.span(first, self.at - 1))

    def otherwise(self, opened: int, depth: int) -> Block:
        """`else { }` or `else if …`, which is a block of one statement, behind the `if` at `opened`."""
        first = self.at
        self.at = first + 1
        if self.kinds[self.at] != "if" and not self.conditional():
            return self.body(first, depth, "", opened)
        if depth + 1 >= MOST_NESTED:
            return self.too_deep_branch()
        first = self.at
        chained = self.if_(depth + 1)
        return Block((chained,), self.span(first, self.at - 1))

    def foreach(self, depth: int) -> Statement:
        """`foreach (kind, x) [do] { }`"""
        first = self.at
        self.at = first + 1
        kinds = self.kinds
        if (
            kinds[first + 1] == "("
            and kinds[first + 2] in words.KINDS
            and kinds[first + 3] == ","
            and kinds[first + 4] == NAME
            and kinds[first + 5] == ")"
        ):
            kind: Kind = kinds[first + 2]  # type: ignore[assignment]
            variable = Name(self.texts[first + 4], self.span(first + 4, first + 4))
            self.at = first + 6
        else:
            head = self.foreach_head(first)
            if head is None:
                return While(Missing(self.behind()), self.body(first, depth + 1, "do"))
            kind, variable = head
        body = self.body(first, depth + 1, "do")
        return ForEach(kind, variable, body, self.span(first, self.at - 1))

    def body(self, first: int, depth: int, noise: str, opened: int | None = None) -> Block:
        """`[do] { }`, behind what starts at token `first`.

        `opened` is the token whose line the closing brace stands under, if not that one.
        """
        kind = self.kinds[self.at]
        if kind == noise and noise:
            self.at += 1
            kind = self.kinds[self.at]
        if kind != "{" and not self.brace_follows(noise):
            return self.no_brace(first if opened is None else opened, depth)
        return self.block(depth)

    def block(self, depth: int) -> Block:
        """`{ }`; its `}` is there, since braces are balanced."""
        first = self.at
        outer, self.closer = self.closer, -1
        self.at = first + 1
        inside = self.statements(depth + 1)
        self.closer = outer
        assert self.kinds[self.at] == "}", "braces balance"
        self.at += 1
        return Block(inside, self.span(first, self.at - 1))

    def ended(self, first: int) -> Span:
        """The span of a statement that starts at token `first`, its `;` included; says so if that is missing."""
        if self.kinds[self.at] == ";":
            self.at += 1
        else:
            self.no_semicolon(first)
        return self.span(first, self.at - 1)


_BARE: Final = frozenset({"fire", "thrust", "thrust_off", "skip"})

_STATEMENTS: Final[dict[str, Callable[[_Parser, int], Statement | None]]] = {
    **dict.fromkeys(words.TYPES, _Parser.declaration),
    **dict.fromkeys(_BARE, _Parser.act),
    NAME: _Parser.assignment,
    "print": _Parser.print,
    "turn": _Parser.turn,
    "while": _Parser.while_,
    "if": _Parser.if_,
    "foreach": _Parser.foreach,
}
