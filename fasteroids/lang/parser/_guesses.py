"""What may be meant by an expression that is none: the half of the expression parser that good programs never reach.

A guess that is certain enough (`and` for `&&`) rewrites the kind of the token and lets the ordinary methods go on, so
that precedences stay right. Guesses inside guesses are few, so that no text nests the parser deeply.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Edit, Note
from fasteroids.lang.parser import foreign
from fasteroids.lang.parser._cursor import ENDINGS, OPERANDS, STARTERS, Cursor
from fasteroids.lang.parser.lexer import BROKEN, END, MEMBER, NAME, NUMBER, STRAY, quoted
from fasteroids.lang.syntax import MOST_NESTED, Expression, Missing, Name, Number, Self

__all__ = ["Guesses"]

_MOST_GUESSES: Final = 12
_LONE: Final = frozenset(
    {*words.BINARY, "++", "=", "=!", ":", ":=", "?", MEMBER, *foreign.SHORTHANDS}
) - {"-"}
_FUNCTIONS: Final = (*words.GETTERS, *words.CALLS)
_FUNCTIONS_HINT: Final = (
    "Functions are `sqrt`, `sin` and `cos`; those of entities are `getx` and its like"
)


class Guesses(Cursor, ABC):
    """Reads on where expressions go wrong. `depth` is that of `Expressions`."""

    height = 1
    """Of the node read last: nodes from it to its farthest leaf, itself included."""

    guesses = 0
    """How many guesses inside each other led here; a text that takes many is not worth more."""
    row = -1
    """The token behind two operands in a row: a third there is told already."""

    @abstractmethod
    def expression(self, depth: int) -> Expression:
        """One expression."""

    @abstractmethod
    def operand(self, depth: int) -> Expression:
        """What stands between binary operators."""

    def too_deep(self, first: int) -> Expression:
        """Give an expression up that starts at token `first` and nests too deeply at the next one."""
        hint = "Put parts of it into variables"
        message = f"This is nested too deeply: a program has at most {MOST_NESTED} parts inside each other"
        self.report("FA029", message, self.here(), hint)
        self.skip_expression()
        self.height = 1
        return Missing(self.span(first, max(first, self.at - 1)))

    def unclosed(self, first: int) -> None:
        """A `)` is missing at the next token, for the `(` at `first` and all those around it."""
        notes = (Note("this `(` is not closed", self.span(first, first)),)
        kinds = self.kinds
        while self.decimal_comma():
            pass
        kind = kinds[self.at]
        if kind == ")":
            self.at += 1
            return
        if kind == ",":
            hint = "One value stands between parentheses"
            self.report("FA027", "There is one value too many", self.here(), hint, notes=notes)
        elif kind in STARTERS and self.same_line() and (closing := self.closing(first)) is not None:
            self.report(
                "FA012",
                f"Expected `)` or an operator, not {self.shown()}",
                self.here(),
                notes=notes,
            )
            self.at = closing + 1
            return
        elif kind in ENDINGS or kind in STARTERS or not self.same_line():
            self.tell_unclosed(self.brackets + 1, notes)
            return
        else:
            message = f"Expected `)` or an operator, not {self.shown()}"
            self.report("FA012", message, self.here(), notes=notes)
        while kinds[self.at] == ",":
            self.at += 1
            self.skip_expression()
        self.skip_expression()
        if kinds[self.at] == ")":
            self.at += 1

    def tell_unclosed(self, count: int, notes: tuple[Note, ...] = ()) -> None:
        """The error for some `)` missing behind the last token."""
        place = self.behind()
        message = "A `)` is missing" if count == 1 else f"{count} closing parentheses are missing"
        hint = "Close the parenthesis" if count == 1 else "Close each parenthesis"
        fix = (Edit(place, ")" * count),)
        self.report("FA012", message, place, hint, label="`)` expected", notes=notes, fix=fix)

    def decimal_comma(self) -> bool:
        """Passes over the rest of a number written `0,5`; False if the next token is no such comma."""
        at = self.at
        if self.kinds[at - 1 : at + 2] != [NUMBER, ",", NUMBER] or not self.touching():
            return False
        self.at = at + 1
        if not self.touching() or "." in self.texts[at - 1] or "." in self.texts[at + 1]:
            self.at = at
            return False
        fix = (Edit(self.span(at, at), "."),)
        self.report("FA003", "A number has a decimal point, not a comma", self.span(at - 1, at + 1),
                    "Write `.`", fix=fix)  # fmt: skip
        self.at = at + 2
        return True

    def no_operand(self, depth: int) -> Expression:
        """An expression was to start at the next token."""
        if self.guesses >= _MOST_GUESSES:
            self.skip_expression()
            return Missing(self.behind())
        self.guesses += 1
        found = self.guess_operand(depth)
        self.guesses -= 1
        return found

    def guess_operand(self, depth: int) -> Expression:
        """What may be meant as one."""
        first, kinds = self.at, self.kinds
        kind = kinds[first]
        if kind == BROKEN:
            self.at = self.ahead()
            if self.operand_follows() and kinds[self.at] != "(":
                return self.after_gap(first, depth)
            return Missing(self.span(first, self.at - 1))
        if kind == ":=" and first and kinds[first - 1] in words.KEYWORDS:
            message = f"`{kinds[first - 1]}` is a word of the language and no variable"
            self.report("FA023", message, self.span(first - 1, first - 1), "Choose another name")
            self.skip_expression()
            return Missing(self.span(first, self.at - 1))
        if kind in _LONE:
            return self.lone(kind, depth)
        if self.reserved():
            message = f"{self.shown()} is a word of the language and no variable"
            self.report("FA023", message, self.here(), "Choose another name")
            self.at += 1
            return Missing(self.span(first, first))
        self.report("FA018", self.lack(), self.behind(), label="an expression expected")
        self.mute = max(self.mute, first)
        return Missing(self.behind())

    def lone(self, kind: str, depth: int) -> Expression:
        """A sign that needs something on its left and has nothing, or that is none here."""
        first, kinds = self.at, self.kinds
        place = self.here()
        while kinds[self.at] in _LONE:
            self.at += 1
        follows = kinds[self.at] in OPERANDS or kinds[self.at] == "-"
        if kind == "+" and follows:
            fix = (Edit(place, ""),)
            message = "There is no plus sign before an expression"
            self.report("FA035", message, place, "Leave it out", fix=fix, about=first)
        elif kind == "++":
            self.report("FA028", "There is no `++`", place, "Write `x := x + 1;`", about=first)
        elif kind in words.BINARY:
            self.report("FA018", f"`{kind}` has nothing on its left", place, about=first)
        else:
            message = f"Expected an expression, not {quoted(self.texts[first])}"
            self.report("FA020", message, place, about=first)
        if not follows:
            self.mute = self.at
            return Missing(self.span(first, self.at - 1))
        inner = self.operand(depth)
        if kind in words.BINARY and kind != "+":
            self.height = 1
            return Missing(self.span(first, self.at - 1))
        return inner

    def operand_follows(self) -> bool:
        """Does an operand stand next in this line that starts no statement?"""
        return self.same_line() and self.kinds[self.at] in OPERANDS and not self.starts_statement()

    def reserved(self) -> bool:
        """Is the next token a word of the language where a variable is likely meant?"""
        kind = self.kinds[self.at]
        if kind not in words.KEYWORDS or not self.same_line():
            return False
        after = self.kinds[self.at + 1]
        if kind in words.KINDS or kind in words.TYPES:
            return after != NAME
        return kind in STARTERS and (after in words.BINARY or after in (")", ";"))

    def lack(self) -> str:
        """What is missing behind the last token read, in a sentence."""
        before = self.kinds[self.at - 1] if self.at else END
        if before == "turn":
            return "`turn` needs an angle, in rad"
        if before == "print":
            return "`print` needs a value"
        if before in ("if", "while"):
            return f"`{before}` needs a condition"
        if before == ":=":
            return "The value to assign is missing"
        if before in words.GETTERS:
            return f"`{before}` needs an entity"
        if before in words.BINARY or before == "!":
            return f"`{before}` has nothing on its right"
        return "An expression is missing"

    def oddity(self, first: int, left: Expression, depth: int) -> Expression | None:
        """What stands behind a complete expression and neither goes on with it nor ends it.

        The expression to go on with (perhaps the same, with the next token read as an operator), or None if the
        expression ends here after all.
        """
        if self.guesses >= _MOST_GUESSES:
            self.skip_expression()
            return None
        self.guesses += 1
        guess = self.guess(first, left, depth)
        self.guesses -= 1
        return guess

    def guess(self, first: int, left: Expression, depth: int) -> Expression | None:
        """What may be meant there."""
        kinds = self.kinds
        kind = kinds[self.at]
        if kind == NAME and self.infix_word():
            return left
        if kind in ("=", "=!", ":="):
            return self.assigned(first, left)
        if kind == MEMBER:
            return self.member(first, left)
        if kind == "?":
            hint = "Use `if` and `else`"
            self.report("FA009", "There is no choice `? :` among the operators", self.here(), hint)
            self.skip_expression()
            return None
        if kind in ("++", *foreign.SHORTHANDS):
            return self.shorthand(first, left)
        if kind == BROKEN:
            self.at = self.ahead()
            if not self.operand_follows():
                return None
            self.mute = self.at
            return self.after_gap(first, depth)
        if self.operand_follows():
            return self.two_in_a_row(first, left, depth)
        return None

    def infix_word(self) -> bool:
        """`a and b`: read the word as the operator it stands for."""
        word = self.texts[self.at]
        meant = foreign.INFIX.get(word)
        behind = self.kinds[self.at + 1]
        if meant is None or not (behind in OPERANDS or behind == "-"):
            return False
        fix = (Edit(self.here(), meant),)
        self.report(
            "FA009",
            f"The operator is `{meant}`, not `{word}`",
            self.here(),
            f"Write `{meant}`",
            fix=fix,
        )
        self.kinds[self.at] = meant
        return True

    def assigned(self, first: int, left: Expression) -> Expression | None:
        """`=`, `=!` or `:=` behind an expression: a comparison, an assignment in a row, or one whose line broke."""
        kinds = self.kinds
        kind = kinds[self.at]
        if (
            kind == ":="
            and self.tokens.lines[first] != self.tokens.lines[first - 1]
            and self.at == first + 1
        ):
            # The next statement: the expression before it is missing.
            self.at = first
            self.report("FA018", self.lack(), self.behind(), label="an expression expected")
            self.mute = max(self.mute, self.at)
            return None
        if kind == ":=" and not self.brackets:
            hint = "Write one assignment after the other, each with its `;`"
            self.report("FA034", "An assignment is a statement and has no value", self.here(), hint)
            while (
                kinds[self.at] not in (";", "{", "}", STRAY, END) and kinds[self.at] not in STARTERS
            ):
                self.at += 1
            self.mute = self.at
            return None
        meant = "!=" if kind == "=!" else "=="
        fix = (Edit(self.here(), meant),)
        code = "FA009" if kind == "=!" else "FA034" if kind == ":=" else "FA011"
        sense = "unequal" if meant == "!=" else "equal"
        self.report(code, f"`{meant}` asks whether two values are {sense}, not `{kind}`", self.here(),
                    f"Write `{meant}`", fix=fix)  # fmt: skip
        kinds[self.at] = meant
        return left

    def member(self, first: int, left: Expression) -> Expression:
        """`a.x`."""
        field = self.texts[self.at][1:]
        span = self.span(first, self.at)
        getter = foreign.MEMBERS.get(field)
        simple = isinstance(left, Name | Self) and first + 1 == self.at
        hint = "Entities are read with `getx`, `gety`, `getvx`, `getvy`, `getradius`"
        fix: tuple[Edit, ...] = ()
        if getter is not None and simple:
            hint = f"Write `{getter} {self.texts[first]}`"
            fix = (Edit(span, f"{getter} {self.texts[first]}"),)
        self.report("FA031", f"There are no fields: {quoted('.' + field)}", span, hint, fix=fix)
        self.at += 1
        if self.kinds[self.at] == "(" and self.kinds[self.at + 1] == ")":
            self.at += 2
        self.height = 1
        return Missing(self.span(first, self.at - 1))

    def shorthand(self, first: int, left: Expression) -> Expression | None:
        """`++` or `+=` in an expression; before another operand `++` is a slip for `+`."""
        behind = self.kinds[self.at + 1]
        if self.kinds[self.at] == "++" and (behind in OPERANDS or behind == "-"):
            fix = (Edit(self.here(), "+"),)
            self.report("FA028", "There is no `++`", self.here(), "Write `+`", fix=fix)
            self.kinds[self.at] = "+"
            return left
        message = f"There is no {self.shown()} in an expression"
        self.report("FA028", message, self.here(), "Write `x := x + 1;` before it")
        self.at += 1
        if self.kinds[self.at] not in OPERANDS:
            return left
        self.skip_expression()
        return Missing(self.span(first, self.at - 1))

    def after_gap(self, first: int, depth: int) -> Expression:
        """Read one more operand after something that could not be read; both are `Missing`."""
        if depth >= MOST_NESTED:
            return self.too_deep(first)
        self.operand(depth + 1)
        self.height = 1
        return Missing(self.span(first, self.at - 1))

    def two_in_a_row(self, first: int, left: Expression, depth: int) -> Expression:
        """Two expressions with nothing between them."""
        if self.kinds[self.at - 1] == "getdir":
            return self.direction_of(first, left, depth)
        if isinstance(left, Name) and first + 1 == self.at:
            word = left.name
            if word in foreign.PREFIX:
                return self.prefixed(first, foreign.PREFIX[word], "FA009", depth)
            known = word in foreign.FUNCTIONS
            meant = None if known else self.suggested(word, _FUNCTIONS)
            if meant is not None:
                return self.prefixed(first, meant, "FA021", depth)
            if self.kinds[self.at] == "(":
                return self.unknown_function(first, depth)
        if self.at != self.row:
            message = f"An operator is missing before {self.shown()}"
            hint = "Multiplication is written `*`" if isinstance(left, Number) else None
            self.report("FA019", message, self.here(), hint, label="two expressions in a row")
        gap = self.after_gap(first, depth)
        self.row = self.at
        return gap

    def direction_of(self, first: int, left: Expression, depth: int) -> Expression:
        """`getdir()`, `getdir self`, `getdir e`: what is given to it is left out if it cannot mean another ship."""
        start = self.at
        end = self.closing(start) if self.kinds[start] == "(" else start
        given = [] if end is None else self.texts[start : end + 1]
        if "".join(given) in ("()", "(self)", "self"):
            whole = self.span(start, start + len(given) - 1)
            fix = (Edit(self.tokens.gap(start - 1).to(whole), ""),)
            self.report("FA026", "`getdir` takes nothing", whole, "Write `getdir`", fix=fix)
            self.at = start + len(given)
            return left
        message = "`getdir` takes nothing: a ship knows only its own direction"
        hint = "Where another one is going is told by `getvx` and `getvy`"
        self.report("FA026", message, self.here(), hint)
        if len(given) > 1:
            self.at = start + len(given)
            self.height = 1
            return Missing(self.span(first, self.at - 1))
        return self.after_gap(first, depth)

    def prefixed(self, first: int, meant: str, code: str, depth: int) -> Expression:
        """Read the name at `first` as the prefix operator or function `meant`."""
        word = self.texts[first]
        place = self.span(first, first)
        # The name was good grammar until this token.
        if code == "FA021":
            message, hint = f"There is no function {quoted(word)}", f"Did you mean `{meant}`?"
        else:
            message, hint = f"The operator is `{meant}`, not {quoted(word)}", f"Write `{meant}`"
        self.report(code, message, place, hint, fix=(Edit(place, meant),))
        self.kinds[first] = meant
        self.at = first
        return self.operand(depth)

    def unknown_function(self, first: int, depth: int) -> Expression:
        """`abs(x)`."""
        word = self.texts[first]
        message = f"There is no function {quoted(word)}"
        hint = foreign.FUNCTIONS.get(word) or _FUNCTIONS_HINT
        self.report("FA030", message, self.span(first, first), hint)
        self.at += 1
        opened = self.at
        if self.kinds[self.at] != ")":
            if depth >= MOST_NESTED or self.brackets >= MOST_NESTED:
                return self.too_deep(first)
            self.brackets += 1
            self.expression(depth + 1)
            self.brackets -= 1
        while self.kinds[self.at] == ",":
            self.at += 1
            self.skip_expression()
        if self.kinds[self.at] == ")":
            self.at += 1
        else:
            self.unclosed(opened - 1)
        self.height = 1
        return Missing(self.span(first, self.at - 1))
