"""Texts of a tree that are legal but not in normal form, and texts that are damaged."""

from __future__ import annotations

import re
from collections.abc import Iterator
from random import Random
from typing import Final

from hypothesis import strategies as st

from fasteroids.lang import syntax
from fasteroids.lang.syntax import Block, Expression, Program, Statement

__all__ = ["NOISES", "PIECES", "damaged", "noisy"]

NOISES: Final = (
    "blanks",
    "comments",
    "parentheses",
    "bare conditions",
    "words",
    "semicolons",
    "skip",
)
"""What a text may have, or lack, without meaning anything else."""

_STRENGTHS: Final = {
    sign: strength
    for strength, signs in enumerate(["||", "&&", "== != < <= > >=", "+ -", "* / %"], 1)
    for sign in signs.split()
}
_CALLS: Final = ("sqrt", "sin", "cos")
_WORDLY: Final = re.compile(r"[A-Za-z0-9_.]")
_GAPS: Final = {
    "blanks": [" ", "  ", "\t", "\n", "\r\n", "\r", "\n\n \t"],
    "comments": ["//\n", " // note\n", "//}{;:=(\r\n", "// if é // /* \x00\r", "//*/\n"],
}


@st.composite
def noisy(draw: st.DrawFn, programs: st.SearchStrategy[Program]) -> tuple[Program, str]:
    """A program and a text of it with some noises."""
    program = draw(programs)
    noises = draw(st.sets(st.sampled_from(NOISES)))
    return program, _Writer(noises, Random(draw(st.integers(0, 2**16)))).text(program)


class _Writer:
    """Writes programs as tokens, then puts something between them."""

    def __init__(self, noises: set[str], random: Random) -> None:
        self.noises, self.random = noises, random

    def now(self, noise: str, chance: float = 0.3) -> bool:
        return noise in self.noises and self.random.random() < chance

    def text(self, program: Program) -> str:
        text = self.gap()
        for token in self.items(program.body):
            glued = text and _WORDLY.match(text[-1]) and _WORDLY.match(token[0])
            gap = self.gap() or " " * bool(glued)
            # A comment just behind a `/` would start one sign too early.
            text += " " * (text.endswith("/") and gap.startswith("/")) + gap + token
        # The last line needs no end, even if it is a comment.
        return text + self.gap() + "// the end" * self.now("comments")

    def gap(self) -> str:
        gap = "" if "blanks" in self.noises else " "
        for noise, some in _GAPS.items():
            while self.now(noise):
                gap += self.random.choice(some)
        return gap

    def items(self, block: Block) -> Iterator[str]:
        yield from self.semicolons()
        for statement in block.statements:
            yield from self.statement(statement)
            yield from self.semicolons()

    def semicolons(self) -> Iterator[str]:
        while self.now("semicolons"):
            yield ";"

    def block(self, block: Block) -> Iterator[str]:
        yield "{"
        yield from self.items(block)
        yield "}"

    def statement(self, statement: Statement) -> Iterator[str]:
        match statement:
            case syntax.Declaration(type_, target, value):
                yield from (type_, target.name)
                if value is not None:
                    yield ":="
                    yield from self.expression(value)
                yield ";"
            case syntax.Assignment(target, value):
                yield from (target.name, ":=")
                yield from self.expression(value)
                yield ";"
            case syntax.Print(value) | syntax.Turn(value):
                yield type(statement).__name__.lower()
                yield from self.expression(value)
                yield ";"
            case syntax.Act(action):
                yield action
                if action != "skip" or not self.now("skip"):
                    yield ";"
            case syntax.While(condition, body):
                yield "while"
                yield from self.condition(condition)
                yield from ["do"] * self.now("words")
                yield from self.block(body)
            case syntax.ForEach(kind, variable, body):
                yield from ("foreach", "(", kind, ",", variable.name, ")")
                yield from ["do"] * self.now("words")
                yield from self.block(body)
            case syntax.If(condition, then, orelse):
                yield "if"
                yield from self.condition(condition)
                yield from ["then"] * self.now("words")
                yield from self.block(then)
                match orelse:
                    case Block((syntax.If() as another,)) if self.random.random() < 0.5:
                        yield "else"
                        yield from self.statement(another)
                    case Block():
                        yield "else"
                        yield from self.block(orelse)

    def condition(self, condition: Expression) -> Iterator[str]:
        if self.now("bare conditions"):
            yield from self.expression(condition)
        else:
            yield "("
            yield from self.expression(condition)
            yield ")"

    def expression(self, tree: Expression, least: int = 0) -> Iterator[str]:
        strength = _STRENGTHS.get(tree.operator, 9) if isinstance(tree, syntax.Binary) else 9
        if strength < least or self.now("parentheses", 0.1):
            yield "("
            yield from self.expression(tree)
            yield ")"
            return
        match tree:
            case syntax.Binary(operator, left, right):
                yield from self.expression(left, strength)
                yield operator
                yield from self.expression(right, strength + 1)
            case syntax.Unary(operator, operand) if operator in _CALLS:
                yield from (operator, "(")
                yield from self.expression(operand)
                yield ")"
            case syntax.Unary(operator, operand):
                yield operator
                yield from self.expression(operand, 9)
            case syntax.Number(value):
                yield self.number(value)
            case syntax.Truth(value):
                yield str(value).lower()
            case syntax.Name(name):
                yield name
            case syntax.Direction():
                yield "getdir"
            case _:
                yield type(tree).__name__.lower()

    def number(self, value: float) -> str:
        """All 1,074 digits behind the point that a double may have, or fewer, and zeros that change nothing."""
        text = f"{value:.1100f}".rstrip("0").rstrip(".")
        if self.now("words"):
            text = "00" + text + ("0" if "." in text else ".000")
        return text


_PIECE: Final = re.compile(r"\w+|\s+|[:<>=!]=|&&|\|\||.", re.DOTALL)
_OURS: Final = """
    ; := ( ) { } , + - * / % < <= > >= == != ! && ||
    if then else while do foreach print turn fire thrust thrust_off skip
    bool double entity ship asteroid bullet any true false null self getdir
    getx gety getvx getvy getradius sqrt sin cos a x 1 2.5
"""
_NOT_OURS: Final = """
    = : & | ++ += -= ** ^ ? . .5 5. 1e5 1.2.3 3a _x @ # $ \\ ' " /* */ // <> <- => &amp; </pre> elif return e _ 0
    é α ٣ ² “
"""
_UNSEEN: Final = [*"\x00\x0b\x0c\u2028\u00a0\ufeff\ufffd \t\r\n"]
PIECES: Final = [*_OURS.split(), *_NOT_OURS.split(), *_UNSEEN, "9" * 400, "0" * 400]


@st.composite
def damaged(draw: st.DrawFn, texts: st.SearchStrategy[str]) -> str:
    """A text with up to three faults in it: pieces gone, doubled, swapped, put in, or all from one on gone."""
    pieces = _PIECE.findall(draw(texts))
    for _ in range(draw(st.integers(1, 3))):
        if draw(st.integers(0, 3)) == 0:  # inside words, not only between them
            pieces = list("".join(pieces))
        here, there = (draw(st.integers(0, 2**16)) % (len(pieces) + 1) for _ in range(2))
        match draw(st.sampled_from(["insert", "delete", "replace", "double", "swap", "cut"])):
            case "insert":
                pieces.insert(here, draw(st.sampled_from(PIECES)))
            case "delete":
                del pieces[here : here + 1]
            case "replace":
                pieces[here : here + 1] = [draw(st.sampled_from(PIECES))]
            case "double":
                pieces[here:here] = pieces[here : here + 1]
            case "swap" if max(here, there) < len(pieces):
                pieces[here], pieces[there] = pieces[there], pieces[here]
            case "cut":
                del pieces[here:]
        pieces = _PIECE.findall("".join(pieces))
    return "".join(pieces)
