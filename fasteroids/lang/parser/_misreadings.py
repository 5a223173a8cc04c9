"""What to make of statements that are none: the half of the parser that good programs never reach.

Each method stands where the grammar ends. It names the fault, repairs what it can be sure of (often by rewriting the
kind of a token, so that the ordinary methods go on), and leaves the parser at a token it can go on with. Each
consumes something or leaves a token that its caller consumes, so the parser always comes to the end.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.parser import foreign
from fasteroids.lang.parser._cursor import OPERANDS
from fasteroids.lang.parser._misassignments import Misassignments
from fasteroids.lang.parser.lexer import BROKEN, END, MEMBER, NAME, STRAY, quoted
from fasteroids.lang.syntax import (
    Assignment,
    Block,
    If,
    Missing,
    Name,
    Number,
    Statement,
)

__all__ = ["Misreadings"]

_TYPES_HINT: Final = "The types are `double`, `bool` and `entity`"
_STATEMENTS_HINT: Final = (
    "A statement is a declaration, an assignment `x := e;`, or starts with a word such as `turn`"
)


class Misreadings(Misassignments, ABC):
    """Reads on where statements go wrong."""

    closer = -1
    """The index of the stray `}` that ends the block being read, whose `{` is missing; -1 if it has its own."""

    @abstractmethod
    def statement(self, depth: int) -> Statement | None:
        """One statement."""

    @abstractmethod
    def block(self, depth: int) -> Block:
        """`{ }`."""

    # Statements that start with a wrong token.

    def no_statement(self, depth: int) -> Statement | None:
        """The next token starts no statement."""
        first, kind = self.at, self.kinds[self.at]
        behind = self.kinds[first + 1]
        place = self.here()
        if kind == BROKEN:
            return self.unreadable(depth)
        if kind == "{":
            self.report("FA033", "A block belongs to an `if`, `else`, `while` or `foreach`", place)
            block = self.detached(depth)
            if self.kinds[self.at] == "{":
                # A row of them is told once.
                self.mute = self.at
            return block
        if kind == "else":
            return self.lone_else(depth)
        if kind in words.KINDS and behind == NAME:
            return self.foreign_declaration(depth)
        self.at += 1
        if kind in (STRAY, "}"):
            self.stray_braces(first)
        elif kind == ")":
            self.at = first
            self.stray_parentheses()
        elif kind in ("then", "do"):
            hint = "`then` stands behind the condition of an `if`, `do` behind that of a `while`"
            self.report(
                "FA020", f"There is nothing for this `{kind}` to go with", place, hint, about=first
            )
            self.mute = self.at
        elif kind == "++" and behind == NAME:
            name = self.texts[first + 1]
            whole = self.span(first, first + 1)
            self.increment(name, "+", whole)
            self.skip_statement()
        elif kind in words.KEYWORDS and behind in (":=", "="):
            message = f"`{kind}` is a word of the language and no variable"
            self.report("FA023", message, place, "Choose another name", about=first)
            self.skip_statement()
        elif kind == ":=":
            message = "The name of the variable to assign to is missing"
            self.report("FA023", message, place, about=first)
            self.skip_statement()
        else:
            self.at = first
            self.no_start()
        return None

    def stray_braces(self, first: int) -> None:
        """Pass over `}` that close nothing, in one line."""
        while self.kinds[self.at] == STRAY and self.at != self.closer and self.same_line():
            self.at += 1
        place = self.span(first, self.at - 1)
        message = "This `}` closes nothing" if self.at == first + 1 else "These `}` close nothing"
        self.report("FA016", message, place, "Remove it", fix=(Edit(place, ""),), about=first)

    def no_start(self) -> None:
        """Pass over something that is no statement: an expression, or signs."""
        first = self.at
        if self.kinds[first + 1] == MEMBER:
            hint = "A program reads entities, with `getx` and its like, and acts with `turn`, `fire` and its like"
            self.report(
                "FA031", "Entities have no fields to change", self.span(first, first + 1), hint
            )
            self.at += 2
            self.skip_statement()
            return
        shown = self.shown()
        if self.kinds[first] in OPERANDS:
            message = f"A statement cannot start with {shown}"
        else:
            message = f"Expected a statement, not {shown}"
        self.report("FA020", message, self.here(), _STATEMENTS_HINT)
        self.at += 1
        self.skip_statement()

    def unreadable(self, depth: int) -> Statement | None:
        """Something already told; an assignment to it is read."""
        first = self.at
        self.at += 1
        if self.kinds[self.at] == BROKEN or not (self.kinds[self.at] == ":=" or self.assigns()):
            return None
        self.at += 1
        value = self.expression(depth + 1)
        target = Name(self.texts[first], self.span(first, first))
        return Assignment(target, value, self.ended(first))

    def detached(self, depth: int) -> Statement:
        """A block that belongs to nothing, as that of an `if` without condition."""
        first = self.at
        condition = Missing(self.tokens.after(first - 1))
        block = self.block(depth + 1)
        return If(condition, block, None, self.span(first, self.at - 1))

    def lone_else(self, depth: int) -> Statement | None:
        """`else` without its `if`."""
        hint = "An `else` stands right behind the `}` of its `if`"
        self.report("FA032", "There is no `if` for this `else`", self.here(), hint)
        self.at += 1
        self.mute = self.at
        return self.detached(depth) if self.kinds[self.at] == "{" else None

    # Statements that start with a name.

    def no_assignment(self, depth: int) -> Statement | None:
        """A name without `:=` behind it."""
        first = self.at
        word, behind = self.texts[first], self.kinds[first + 1]
        self.at = first + 1
        if self.assigns() or behind in ("==", "=!"):
            return self.misassigned(first, depth)
        if behind in foreign.SHORTHANDS or behind == "++":
            return self.shorthand_assignment(first, depth)
        if self.kinds[first + 1 : first + 4] == ["-", "-", ";"]:
            self.increment(word, "-", self.span(first, first + 2))
            self.skip_statement()
            return Assignment(
                self.named(first),
                Number(1.0, self.span(first, first)),
                self.span(first, self.at - 1),
            )
        same_line = self.same_line()
        self.at = first
        if word in foreign.MODIFIERS and same_line and self.type_follows():
            return self.modified(depth)
        if word in foreign.TYPES and behind in (NAME, BROKEN) and same_line:
            return self.foreign_declaration(depth)
        if word in foreign.ELSE_IFS:
            self.report("FA032", f"There is no `if` for this `{word}`", self.here())
            self.kinds[first] = "if"
            return self.statement(depth)
        if word in foreign.STATEMENTS:
            return self.foreign_statement(depth)
        meant = foreign.SYNONYMS.get(word) or self.suggested(
            word, self.plausible(behind, same_line)
        )
        if meant is not None:
            place = self.here()
            known = word in foreign.SYNONYMS
            message = (
                f"There is no {quoted(word)}" if known else f"{quoted(word)} starts no statement"
            )
            hint = f"Write `{meant}`" if known else f"Did you mean `{meant}`?"
            self.report(
                "FA022" if known else "FA021", message, place, hint, fix=(Edit(place, meant),)
            )
            self.kinds[first] = meant
            return self.statement(depth)
        self.no_sense(same_line)
        return None

    def no_sense(self, same_line: bool) -> None:
        """A name that starts nothing."""
        first = self.at
        word, behind = self.texts[first], self.kinds[first + 1]
        place = self.here()
        if behind == MEMBER:
            self.no_start()
            return
        if behind == "(" and same_line:
            hint = (
                "Ships are told what to do with `turn`, `fire`, `thrust`, `thrust_off` and `skip`"
            )
            self.report("FA030", f"There is no function {quoted(word)}", place, hint)
        elif behind == NAME and same_line:
            self.report(
                "FA022", f"{quoted(word)} is no type and starts no statement", place, _TYPES_HINT
            )
        elif behind in (";", "}", STRAY, END) or not same_line:
            hint = "Give it a value with `:=`, or show it with `print`"
            self.report("FA020", f"{quoted(word)} alone is no statement", place, hint)
        elif behind != BROKEN:
            message = f"Expected `:=` behind {quoted(word)}, not {quoted(self.texts[first + 1])}"
            self.report("FA020", message, self.span(first + 1, first + 1), about=first)
        self.at += 1
        self.skip_statement()

    def plausible(self, behind: str, same_line: bool) -> tuple[str, ...]:
        """Words that may start a statement whose second token is `behind`."""
        if behind in (";", "}", END) or not same_line:
            return "fire", "thrust", "thrust_off", "skip"
        if behind == "(":
            return "if", "while", "foreach", "print", "turn", "fire", "thrust", "thrust_off", "skip"
        if behind == NAME:
            return *words.TYPES, "print", "turn", "if", "while"
        if behind in OPERANDS or behind == "-":
            return "print", "turn", "if", "while"
        return ()

    def type_follows(self) -> bool:
        """Is the token behind the next a type, ours or another language's, before a name?"""
        word, kind, after = (
            self.texts[self.at + 1],
            self.kinds[self.at + 1],
            self.kinds[self.at + 2],
        )
        return kind in words.TYPES or (
            after == NAME and (kind in words.KINDS or word in (*foreign.TYPES, *foreign.MODIFIERS))
        )

    def modified(self, depth: int) -> Statement | None:
        """`const double x;`: read without the first word."""
        first = self.at
        fix = (Edit(self.here().to(self.tokens.gap(first)), ""),)
        message = f"There is no {quoted(self.texts[first])}"
        hint = "Leave it out: a declaration starts with its type"
        self.report("FA022", message, self.here(), hint, fix=fix)
        self.at = first + 1
        return self.statement(depth)

    def foreign_declaration(self, depth: int) -> Statement | None:
        """`int x;`, `var x := 3;`, `ship s;`."""
        first = self.at
        word, place = self.texts[first], self.here()
        meant = foreign.TYPES[word]
        hint = f"Write `{meant}`" if meant else _TYPES_HINT
        fix = (Edit(place, meant),) if meant else ()
        self.report("FA022", f"{quoted(word)} is no type", place, hint, fix=fix)
        value = self.kinds[first + 3]
        if meant is None:
            meant = (
                "bool"
                if value in ("true", "false", "!")
                else "entity"
                if value in ("null", "self")
                else "double"
            )
        self.kinds[first] = meant
        return self.statement(depth)

    def foreign_statement(self, depth: int) -> Statement | None:
        """`for (…) { }`, `return;`: what it has in a block is read all the same."""
        first = self.at
        word = self.texts[first]
        self.report("FA022", f"There is no `{word}`", self.here(), foreign.STATEMENTS[word])
        self.at += 1
        if self.skip_head():
            return self.detached(depth)
        self.skip_statement()
        return None
