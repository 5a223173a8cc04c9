"""Expressions, by precedence climbing."""

from __future__ import annotations

from typing import Final

from fasteroids.lang import words
from fasteroids.lang._cursor import ENDINGS
from fasteroids.lang._guesses import Guesses
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.lexer import NAME, NUMBER
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    MOST_NESTED,
    Binary,
    Direction,
    Expression,
    Name,
    Null,
    Number,
    Self,
    Truth,
    Unary,
)

__all__ = ["Expressions"]

_ODD: Final = 99
_STRENGTH: Final = {**words.BINARY, **dict.fromkeys(ENDINGS, 0)}.get
"""How strongly a token binds: 0 if it ends an expression, `_ODD` if it can neither end one nor go on with it."""


class Expressions(Guesses):
    """Reads expressions. `depth` is the number of nodes from the root of the tree to the one read, itself included."""

    def expression(self, depth: int) -> Expression:
        """One expression; `Missing`, and an error, where there is none."""
        first = self.at
        left = self.operand(depth)
        if self.kinds[self.at] in ENDINGS:
            return left
        return self.climb(first, left, depth, 1)

    def climb(self, first: int, left: Expression, depth: int, weakest: int) -> Expression:
        """Go on behind `left`, which starts at token `first`, with binary operators of at least a strength."""
        kinds = self.kinds
        height = self.height
        while True:
            sign = kinds[self.at]
            strength = _STRENGTH(sign, _ODD)
            if strength < weakest:
                break
            if strength == _ODD:
                self.height = height
                mended = self.oddity(first, left, depth)
                if mended is None:
                    break
                left, height = mended, self.height
                continue
            if depth >= MOST_NESTED:
                left, height = self.too_deep(first), 1
                break
            self.at += 1
            start = self.at
            right = self.operand(depth + 1)
            if _STRENGTH(kinds[self.at], _ODD) > strength:
                right = self.climb(start, right, depth + 1, strength + 1)
            height = (height if height > self.height else self.height) + 1
            if depth + height - 1 > MOST_NESTED:
                left, height = self.too_deep(first), 1
                break
            left = Binary(sign, left, right, self.span(first, self.at - 1))
        self.height = height
        return left

    def operand(self, depth: int) -> Expression:
        """What stands between binary operators."""
        first = self.at
        kind = self.kinds[first]
        self.height = 1
        if kind == NAME:
            self.at = first + 1
            return Name(self.texts[first], self.span(first, first))
        if kind == NUMBER:
            self.at = first + 1
            return Number(float(self.texts[first]), self.span(first, first))
        if kind == "(":
            return self.parenthesised(depth)
        if kind in words.UNARY:
            if depth >= MOST_NESTED:
                return self.too_deep(first)
            self.at = first + 1
            inner = self.operand(depth + 1)
            self.height += 1
            return Unary(kind, inner, self.span(first, self.at - 1))
        if kind in words.CONSTANTS:
            self.at = first + 1
            return _constant(kind, self.span(first, first))
        if kind in words.CALLS:
            return self.call(kind, depth)
        return self.no_operand(depth)

    def parenthesised(self, depth: int) -> Expression:
        """`(e)`, at most `MOST_NESTED` pairs inside each other."""
        first = self.at
        if self.brackets >= MOST_NESTED:
            return self.too_deep(first)
        self.brackets += 1
        self.at = first + 1
        inner = self.expression(depth)
        self.brackets -= 1
        if self.kinds[self.at] == ")":
            self.at += 1
        else:
            self.unclosed(first)
        return inner

    def call(self, kind: str, depth: int) -> Expression:
        """`sqrt(e)` and its like."""
        first = self.at
        if depth >= MOST_NESTED:
            return self.too_deep(first)
        self.at = first + 1
        bare = self.kinds[self.at] != "("
        inner = self.operand(depth + 1) if bare else self.parenthesised(depth + 1)
        self.height += 1
        span = self.span(first, self.at - 1)
        if bare and self.at > first + 1:
            fix = (Edit(self.tokens.gap(first), "("), Edit(self.behind(), ")"))
            message = f"`{kind}` needs parentheses"
            hint = f"Write `{kind}(…)`"
            self.report("FA013", message, span, hint, fix=fix, about=first + 1)
        return Unary(kind, inner, span)


def _constant(kind: str, span: Span) -> Expression:
    if kind == "self":
        return Self(span)
    if kind == "null":
        return Null(span)
    if kind == "getdir":
        return Direction(span)
    return Truth(kind == "true", span)
