"""What to make of parts of statements that are wrong: names of variables, what stands behind actions, ends without `;`.

The half of the parser that good programs never reach begins here; `_misreadings` says how it works.
"""

from __future__ import annotations

from abc import ABC

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.parser._cursor import OPERANDS
from fasteroids.lang.parser._expressions import Expressions
from fasteroids.lang.parser.lexer import BROKEN, END, NAME, NUMBER, STRAY, Tokens
from fasteroids.lang.syntax import Name

__all__ = ["Parts"]


class Parts(Expressions, ABC):
    """Reads on where parts of statements go wrong."""

    def __init__(self, tokens: Tokens, faults: list[Diagnostic]) -> None:
        super().__init__(tokens, faults)
        self.declarations: set[int] = set()
        """Commas that are read as the type of one more declaration."""

    def named(self, first: int) -> Name:
        """The token as a variable."""
        return Name(self.texts[first], self.span(first, first))

    def name(self) -> Name | None:
        """The name that a declaration declares; None, and on to the next statement, if there is none."""
        at = self.at
        kind = self.kinds[at]
        if kind == BROKEN and self.texts[at][0] == "[" and self.kinds[at + 1] == NAME:
            # `double[3] a`, which was told.
            self.at = at = at + 1
            kind = NAME
        if kind in (NAME, BROKEN):
            self.at = at + 1
            return self.named(at)
        if kind in (":=", "="):
            message = f"`{self.texts[at - 1]}` is a word of the language and no variable"
            self.report("FA023", message, self.span(at - 1, at - 1), "Choose another name")
        elif kind in words.KEYWORDS and self.same_line():
            message = f"{self.shown()} is a word of the language and no variable"
            self.report("FA023", message, self.here(), "Choose another name")
            self.at = at + 1
            return self.named(at)
        elif kind == NUMBER and self.same_line():
            self.report(
                "FA023", f"The name of a variable is expected, not {self.shown()}", self.here()
            )
        else:
            message = "The name of the variable is missing"
            self.report("FA023", message, self.behind(), label="a name expected")
        self.skip_statement()
        return None

    def several(self, kind: str) -> None:
        """`, b` behind a declaration: go on as if it were one more."""
        first = at = self.at
        kinds = self.kinds
        fix: list[Edit] = []
        while kinds[at] == "," and (kinds[at + 1] == NAME or kinds[at + 1] in words.TYPES):
            own = kinds[at + 1] != NAME
            behind = self.tokens.gap(at)
            comma = self.span(at, at)
            fix.append(Edit(comma, ";") if own else Edit(comma.to(behind), f"; {kind} "))
            kinds[at] = ";" if own else kind
            self.declarations.add(at)
            if own:
                break
            at += 2
        if fix:
            hint = f"Write `{kind} …;` for each"
            last = max(first, at - 1)
            message = "A declaration declares one variable"
            self.report("FA025", message, self.span(first, last), hint, fix=tuple(fix))

    def takes_something(self) -> bool:
        """Is `skip` followed by what cannot be the next statement?"""
        return self.kinds[self.at] in ("(", ":=", "=")

    def bare(self, first: int) -> str | None:
        """An action that takes nothing, with something behind it other than `;`: what it is, or None for no action."""
        kind, behind = self.kinds[first], self.kinds[self.at]
        if behind in (":=", "="):
            message = f"`{kind}` is a word of the language and no variable"
            self.report("FA023", message, self.span(first, first), "Choose another name")
            self.skip_statement()
            return None
        if not self.same_line() or self.starts_statement():
            return kind
        word = self.texts[self.at]
        if kind == "thrust" and word in ("on", "off"):
            meant = "thrust_off" if word == "off" else "thrust"
            whole = self.span(first, self.at)
            message = "`thrust` switches the thruster on and takes nothing"
            self.report("FA026", message, whole, f"Write `{meant}`", fix=(Edit(whole, meant),))
            self.at += 1
            return meant
        message = f"`{kind}` takes nothing"
        closing = self.closing(self.at) if behind == "(" else None
        if closing is not None:
            whole = self.span(self.at, closing)
            fix = (Edit(whole, ""),)
            self.report("FA026", message, whole, f"Write `{kind};`", fix=fix)
            self.at = closing + 1
        elif behind in OPERANDS or behind == "-":
            self.report("FA026", message, self.here(), f"Write `{kind};`")
            self.at += 1
            self.skip_expression()
        return kind

    def stray_parentheses(self) -> None:
        """Pass over `)` that close nothing."""
        first = self.at
        while self.kinds[self.at] == ")":
            self.at += 1
        place = self.span(first, self.at - 1)
        message = "This `)` closes nothing" if self.at == first + 1 else "These `)` close nothing"
        self.report("FA017", message, place, "Remove it", fix=(Edit(place, ""),), about=first)

    def no_semicolon(self, first: int) -> None:
        """The statement that starts at token `first` has no `;` where it ends."""
        kinds = self.kinds
        self.at = self.ahead()
        while kinds[self.at] == ")":
            self.stray_parentheses()
            self.at = self.ahead()
        while self.decimal_comma():
            pass
        kind, place = kinds[self.at], self.here()
        if kind == ";":
            self.at += 1
        elif self.at in self.declarations:
            return
        elif kind == ":":
            fix = (Edit(place, ";"),)
            message = "A statement ends in `;`, not in `:`"
            self.report("FA010", message, place, "Write `;`", fix=fix)
            self.at += 1
        elif kind in ("}", STRAY, END, "else") or self.starts_statement() or not self.same_line():
            behind = self.behind()
            span = behind if behind not in self.told else self.span(self.at - 1, self.at - 1)
            fix = (Edit(behind, ";"),)
            self.report(
                "FA010",
                "A `;` is missing",
                span,
                "End the statement with `;`",
                label="`;` expected",
                fix=fix,
            )
        elif kind == ",":
            message = (
                f"`{kinds[first]}` takes one value"
                if kinds[first] in words.KEYWORDS
                else "There is one value too many"
            )
            self.report("FA027", message, place, "Write one statement for each value")
            self.skip_statement()
        else:
            self.report("FA020", f"Expected `;`, not {self.shown()}", place)
            self.at += kind != "{"
            self.skip_statement()
