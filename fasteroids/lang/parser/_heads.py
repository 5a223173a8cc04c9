"""What to make of `if`, `while` and `foreach` whose head or body is not as it should be."""

from __future__ import annotations

from abc import ABC, abstractmethod
from bisect import bisect
from functools import cached_property
from typing import Final

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Edit
from fasteroids.lang.parser import foreign
from fasteroids.lang.parser._misreadings import Misreadings
from fasteroids.lang.parser.lexer import BROKEN, END, NAME, STRAY, quoted
from fasteroids.lang.syntax import MOST_NESTED, Block, Kind, Name, Statement

__all__ = ["Heads"]

_MOST_TRIED: Final = 8
_KINDS_HINT: Final = "The kinds are `ship`, `asteroid`, `bullet` and `any`"


class Heads(Misreadings, ABC):
    """Reads on where statements with a body go wrong."""

    @abstractmethod
    def statements(self, depth: int) -> tuple[Statement, ...]:
        """Statements up to the end of the block."""

    def too_deep_block(self) -> None:
        """Pass over the rest of a block that lies too deep."""
        self.tell_depth()
        self.skip_block()

    def too_deep_branch(self) -> Block:
        """Pass over an `else if` that lies too deep, and all that follow it."""
        first = self.at
        self.tell_depth()
        more = True
        while more:
            self.at += 1
            if not self.skip_head():
                break
            self.at += 1
            self.skip_block()
            self.at += 1
            # Behind `else` the next round passes over `if`, or over nothing: its `{` is then the last.
            more = self.kinds[self.at] == "else"
            self.at += more and self.kinds[self.at + 1] == "if"
        self.mute = self.at
        return Block((), self.span(first, max(first, self.at - 1)))

    def tell_depth(self) -> None:
        """The error for what nests too deeply at the next token."""
        message = f"This is nested too deeply: a program has at most {MOST_NESTED} parts inside each other"
        hint = "Put parts of it one after the other"
        self.report("FA029", message, self.here(), hint)

    def else_follows(self) -> bool:
        """Is the next token an `else`, or meant as one? Then it is one now."""
        kind = self.kinds[self.at]
        if kind == "else":
            return True
        if kind == ";" and self.kinds[self.at + 1] == "else":
            place = self.here()
            message = "This `;` parts the `else` from its `if`"
            self.report("FA032", message, place, "Remove it", fix=(Edit(place, ""),))
            self.at += 1
            return True
        word, behind = self.texts[self.at], self.kinds[self.at + 1]
        if kind != NAME or behind == ":=":
            return False
        place = self.here()
        if word in foreign.ELSE_IFS:
            fix = (Edit(place, "else if"),)
            self.report("FA022", f"There is no `{word}`", place, "Write `else if`", fix=fix)
        elif behind in ("{", "if") and self.suggested(word, ("else",)):
            fix = (Edit(place, "else"),)
            message = f"{quoted(word)} starts no statement"
            self.report("FA021", message, place, "Did you mean `else`?", fix=fix)
        else:
            return False
        self.kinds[self.at] = "else"
        return True

    def conditional(self) -> bool:
        """Behind `else`: is it meant as an `else if`? Then it is given back, to be read as the `if`."""
        word = self.texts[self.at - 1]
        if word not in foreign.ELSE_IFS:
            if self.kinds[self.at] != "(":
                return False
            place = self.behind()
            message = "An `else` has no condition"
            self.report("FA032", message, self.here(), "Write `else if`", fix=(Edit(place, " if"),))
        self.at -= 1
        return True

    # Bodies.

    def brace_follows(self, noise: str) -> bool:
        """Passes over what stands between a head and its `{`; False if there is none."""
        kinds = self.kinds
        self.at = self.ahead()
        if kinds[self.at] in ("then", "do"):
            self.wrong_noise(noise)
        if kinds[self.at] == ")":
            self.stray_parentheses()
        kind, place = kinds[self.at], self.here()
        if kind == noise and noise:
            self.at += 1
        elif kind == ":" or (kind == ";" and kinds[self.at + 1] == "{"):
            braced = kinds[self.at + 1] == "{"
            fix = (Edit(place, ""),) if braced else ()
            message = f"A body starts with `{{`, not with `{kind}`"
            self.report(
                "FA015",
                message,
                place,
                "Remove it" if braced else "Write `{`",
                fix=fix,
            )
            self.at += 1
            self.mute = self.at
        kind = kinds[self.at]
        if kind == "{":
            return True
        if (
            kind in (";", "}", STRAY, END, "else")
            or self.starts_statement()
            or not self.same_line()
        ):
            return False
        if kind == NAME and kinds[self.at + 1] in ("(", ";"):
            return False
        self.report("FA015", f"Expected `{{`, not {self.shown()}", place)
        self.at += 1
        return self.skip_head()

    def wrong_noise(self, noise: str) -> None:
        """`while e then`, `while e do do`."""
        if self.kinds[self.at - 1] in ("then", "do"):
            noise = ""
        kind, place = self.kinds[self.at], self.here()
        message = f"`{kind}` does not belong here"
        hint = f"Write `{noise}`, or nothing" if noise else "Remove it"
        self.report("FA020", message, place, hint, fix=(Edit(place, noise),))
        self.at += 1

    def no_brace(self, first: int, depth: int) -> Block:
        """A body without `{`, of what starts at token `first`: it reaches to a `}` under it, or is one statement."""
        kinds = self.kinds
        start = self.at
        place = self.behind()
        if place in self.told:
            place = self.span(start - 1, start - 1)
        word = quoted(self.texts[first])
        message = f"The body of {word} stands between `{{` and `}}`"
        hint = "Write `{` before it and `}` behind it"
        kind = kinds[start]
        if kind in ("}", STRAY, END, "else"):
            self.report("FA015", message, place, hint, label="`{` expected")
            return Block((), place)
        if kind == ";":
            self.report("FA015", message, self.here(), hint, label="`{` expected")
            self.at += 1
            return Block((), self.span(start, start))
        if depth + 1 >= MOST_NESTED:
            self.too_deep_block()
            return Block((), place)
        closer = self.claimed(first)
        if closer is not None:
            hint = "Write `{`"
            self.report(
                "FA015",
                "A `{` is missing",
                place,
                hint,
                label="`{` expected",
                fix=(Edit(self.tokens.after(start - 1), " {"),),
            )
            outer, self.closer = self.closer, closer
            inside = self.statements(depth + 1)
            self.closer = outer
            if self.at == closer:
                self.at += 1
        else:
            told = start <= self.mute
            statement = self.statement(depth + 1)
            inside = () if statement is None else (statement,)
            if not told:
                fix = (Edit(self.tokens.after(start - 1), " {"), Edit(self.behind(), " }"))
                self.report("FA015", message, place, hint, label="`{` expected",
                            fix=fix if statement else (), about=len(kinds))  # fmt: skip
        return Block(inside, self.span(start, max(start, self.at - 1)))

    def claimed(self, first: int) -> int | None:
        """The stray `}` that ends a body whose `{` is missing: in the same block, and under its head or in its line."""
        strays = self._strays
        indent, row = self.indent(first), self.tokens.lines[first]
        position = bisect(strays, (self.at, 0))
        for index, home in strays[position : position + _MOST_TRIED]:
            if self.closer >= 0 and index >= self.closer:
                break
            line = self.tokens.lines[index]
            under = self.indent(index) == self.tokens.columns[index] == indent
            if home == self._home(first) and (line == row or under):
                return index
        return None

    @cached_property
    def _homes(self) -> list[int]:
        """For each token the index of the `{` of the block it is in, or -1."""
        homes: list[int] = []
        opened = [-1]
        for index, kind in enumerate(self.kinds):
            if kind == "}":
                opened.pop()
            homes.append(opened[-1])
            if kind == "{":
                opened.append(index)
        return homes

    @cached_property
    def _strays(self) -> list[tuple[int, int]]:
        """Each stray `}` with the `{` of the block it is in."""
        if STRAY not in self.kinds:
            return []
        homes = self._homes
        return [(i, homes[i]) for i, kind in enumerate(self.kinds) if kind == STRAY]

    def _home(self, index: int) -> int:
        return self._homes[index]

    # The head of a for-each.

    def foreach_head(self, first: int) -> tuple[Kind, Name] | None:
        """`(kind, variable)` that is not written so; None if no variable is found in it."""
        kinds, texts = self.kinds, self.texts
        opened = kinds[self.at] == "("
        if opened:
            self.at += 1
        start = self.at
        while kinds[self.at] not in (")", "{", "}", STRAY, END, "do") and self.same_line():
            self.at += 1
        inside = range(start, self.at)
        words_inside = [i for i in inside if kinds[i] == NAME or kinds[i] in words.KEYWORDS]
        significant = [i for i in words_inside if texts[i] not in _FILLERS]
        kind_at, kind = self.kind_among(significant)
        variable = next((i for i in significant if i != kind_at and kinds[i] == NAME), None)
        kind_right = bool(inside) and kinds[start] in words.KINDS
        shape = [kinds[i] for i in inside]
        well = len(shape) == 3 and shape[1] == ","
        if not (well and opened and kind_right and variable is not None):
            self.tell_head(first, opened, inside, significant, kind_at, kind, variable)
        if kinds[self.at] == ")":
            self.at += 1
        elif well and opened:
            self.tell_unclosed(1)
        else:
            self.mute = self.at
        if variable is None:
            return None
        return kind or "any", self.named(variable)

    def kind_among(self, significant: list[int]) -> tuple[int | None, Kind | None]:
        """The word that is a kind, or the first that is meant as one."""
        for i in significant:
            if self.kinds[i] in words.KINDS:
                return i, self.kinds[i]  # type: ignore[return-value]
        for i in significant:
            meant = foreign.KINDS.get(self.texts[i]) or self.suggested(self.texts[i], words.KINDS)
            if meant is not None:
                return i, meant  # type: ignore[return-value]
        return None, None

    def tell_head(
        self, first: int, opened: bool, inside: range, significant: list[int],
        kind_at: int | None, kind: Kind | None, variable: int | None,
    ) -> None:  # fmt: skip
        """Name what is wrong with the head."""
        kinds, texts = self.kinds, self.texts
        shape = [kinds[i] for i in inside]
        well = len(shape) == 3 and shape[1] == ","
        place = (
            self.span(inside.start, inside.stop - 1)
            if inside
            else self.tokens.after(inside.start - 1)
        )
        if not opened and well:
            fix: tuple[Edit, ...] = (Edit(self.tokens.gap(first), " ("),)
            if kinds[self.at] != ")":
                fix = (*fix, Edit(self.behind(), ")"))
            self.report(
                "FA013",
                "`foreach` needs parentheses",
                place,
                "Write `foreach (kind, variable)`",
                fix=fix,
                about=len(kinds),
            )
            return
        if well and kind_at == inside.start + 2 and variable == inside.start:
            message = "The kind comes first in a `foreach`"
        elif well and shape[0] not in words.KINDS:
            at = inside.start
            span = self.span(at, at)
            hint = f"Did you mean `{kind}`?" if kind else _KINDS_HINT
            fix = (Edit(span, kind),) if kind else ()
            self.report(
                "FA024",
                f"{quoted(texts[at])} is no kind of entity",
                span,
                hint,
                fix=fix,
                about=len(kinds),
            )
            return
        elif well and shape[2] in words.KEYWORDS:
            span = self.span(inside.stop - 1, inside.stop - 1)
            message = f"{quoted(texts[inside.stop - 1])} is a word of the language and no variable"
            self.report("FA023", message, span, "Choose another name", about=len(kinds))
            return
        else:
            message = "A `foreach` names a kind of entity and a variable"
        hint = "Write `foreach (kind, variable)`"
        fix = ()
        if kind and variable is not None and len(significant) == 2 and opened:
            meant = f"{kind}, {texts[variable]}"
            hint = f"Write `foreach ({kind}, {quoted(texts[variable])[1:-1]})`"
            fix = (Edit(place, meant),)
        if BROKEN not in shape:
            self.report("FA024", message, place, hint, fix=fix, about=len(kinds))


_FILLERS: Final = frozenset({"in", "of", "each", "var", "let", *words.TYPES})
