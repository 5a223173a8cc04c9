"""What to make of assignments as other languages write them: `x = e`, `x == e`, `x++`, `x += e`."""

from __future__ import annotations

from abc import ABC, abstractmethod

from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.parser import foreign
from fasteroids.lang.parser._cursor import OPERANDS
from fasteroids.lang.parser._parts import Parts
from fasteroids.lang.parser.lexer import quoted
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Assignment, Number, Statement

__all__ = ["Misassignments"]


class Misassignments(Parts, ABC):
    """Reads on where assignments go wrong."""

    @abstractmethod
    def ended(self, first: int) -> Span:
        """The end of a simple statement."""

    def assigns(self) -> bool:
        """Is the next token some other language's sign for `:=`? Says so."""
        kind, place = self.kinds[self.at], self.here()
        value = self.kinds[self.at + 1]
        if kind == "=" or (
            kind == ":" and (value in OPERANDS or value == "-") and self.value_ahead()
        ):
            fix = (Edit(place, ":="),)
            message = f"An assignment is written `:=`, not `{kind}`"
            self.report("FA011", message, place, "Write `:=`", fix=fix)
            return True
        return False

    def value_ahead(self) -> bool:
        """Does the token after the next stand in its line and start no statement?"""
        self.at += 1
        ahead = self.same_line() and not self.starts_statement()
        self.at -= 1
        return ahead

    def misassigned(self, first: int, depth: int) -> Statement:
        """`x = e;`, `x == e;`, `x =! e;`."""
        kind, place = self.kinds[self.at], self.here()
        if kind == "=!":
            self.kinds[self.at] = "!"
        else:
            self.at += 1
        meant = ":= !" if kind == "=!" else ":="
        if kind in ("==", "=!"):
            message = f"An assignment is written `:=`, not `{kind.rstrip('!')}`"
            self.report("FA011", message, place, f"Write `{meant}`", fix=(Edit(place, meant),))
        value = self.expression(depth + 1)
        return Assignment(self.named(first), value, self.ended(first))

    def increment(self, name: str, sign: str, whole: Span) -> None:
        """Tell of `x++` or `x--`."""
        meant = f"{name} := {name} {sign} 1"
        fix = (Edit(whole, meant),)
        self.report(
            "FA028",
            f"There is no `{sign}{sign}`",
            whole,
            f"Write `{quoted(meant)[1:-1]}`",
            fix=fix,
            about=len(self.kinds),
        )

    def shorthand_assignment(self, first: int, depth: int) -> Statement:
        """`x++;` or `x += e;`, read as an assignment of a number."""
        word, kind, place = self.texts[first], self.kinds[self.at], self.here()
        target = self.named(first)
        self.at += 1
        if kind == "++":
            self.increment(word, "+", self.span(first, first + 1))
            if self.kinds[self.at] != ";":
                self.mute = self.at
            return Assignment(target, Number(1.0, place), self.ended(first))
        sign = foreign.SHORTHANDS[kind]
        start = self.at
        before = self.mute
        value = self.expression(depth + 1)
        fix: tuple[Edit, ...] = (Edit(place, f":= {word} {sign}"),)
        if self.at > start + 1:
            fix = (
                Edit(place, f":= {word} {sign}"),
                Edit(self.tokens.gap(start - 1), " ("),
                Edit(self.behind(), ")"),
            )
        hint = f"Write `{quoted(word)[1:-1]} := {quoted(word)[1:-1]} {sign} …`"
        if first > before:
            self.report(
                "FA028", f"There is no `{kind}`", place, hint, fix=fix, about=len(self.kinds)
            )
        return Assignment(target, value, self.ended(first))
