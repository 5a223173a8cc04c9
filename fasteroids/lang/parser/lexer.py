"""From text to tokens: one compiled expression cuts the whole text into pieces, a loop sorts them.

White space is blank, tab and the ends of lines; comments run from `//` to the end of the line. Every other piece
becomes a token or an error. What only looks different from a token (`&` for `&&`, `.5` for `0.5`) is reported and
read as what is meant; what cannot be read at all becomes a `BROKEN` token, which the parser passes over without a
second complaint. Signs whose meaning depends on their place (`=`, `:`, `+=`) are left to the parser.
"""

from __future__ import annotations

import re
from itertools import islice
from math import inf
from typing import Final

from attrs import define, field

from fasteroids.lang import words
from fasteroids.lang.diagnostics import Diagnostic, Edit
from fasteroids.lang.parser import foreign
from fasteroids.lang.source import Span

__all__ = [
    "BROKEN",
    "END",
    "MEMBER",
    "NAME",
    "NUMBER",
    "STRAY",
    "Tokens",
    "decoded",
    "lines",
    "quoted",
    "tokens",
]

NAME: Final = "a name"
NUMBER: Final = "a number"
END: Final = "the end"
MEMBER: Final = "a field"
"""`.x`, which the language has not."""
BROKEN: Final = "something unreadable"
"""A piece that is reported already."""
STRAY: Final = "a stray brace"
"""A `}` that closes nothing, so marked by the parser."""

_BLANK = ""
_LINE = "\n"
_FAULT = "a fault"

_LINE_END = re.compile(r"\r\n?|\n")
_INDEX = r"(?!//)[^\[\]{}\r\n;]"
"""A character that may stand in an index or a list of another language."""
_UNSEEN = "\x0b\x0c\x1c-\x1f\x85\xa0\xad\u1680\u2000-\u200f\u2028-\u202f\u205f-\u2064\u3000\ufeff"
_LEFT_TO_PARSER = ("=", ":", "=!", "++", "?", *foreign.SHORTHANDS)
_SIGNS = sorted({*words.SIGNS, *foreign.SIGNS, *_LEFT_TO_PARSER}, key=len, reverse=True)
_ODD = (
    r"\w \t\r\n\ufffd;,(){}:=!<>&|+*/%?.'\"“”#\-"
    + _UNSEEN
    + "".join(sign for sign in foreign.SIGNS if len(sign) == 1 and not sign.isascii())
)
_PIECE = re.compile(
    "|".join(
        [
            r"[^\W\d]\w*",
            r"[ \t]+",
            r"\r\n?|\n",
            r"//[^\r\n]*",
            r"\.?[0-9](?:[eE][+-][0-9]|[\w.])*",
            r"/\*(?s:.*?)(?:\*/|\Z)",
            r"\*/(?!/)",
            r"</[A-Za-z][^<>\r\n]*>",
            r"[:<>!=][ \t]+=(?!=)",
            r"\*\*+",
            *map(re.escape, _SIGNS),
            r"\.[^\W\d]\w*",
            r'"[^"\r\n]*"|"[^"\r\n;]*',
            r"'[^'\r\n]*'",
            r"“[^“”\r\n]*”?",
            r"#[^\r\n]*",
            rf"\[(?:{_INDEX}|\[(?:{_INDEX})*\])*\]",
            r"\ufffd+",
            f"[{_UNSEEN}]+",
            f"[^{_ODD}]+(?:[ \\t]+[^{_ODD}]+)*",
            r"(?s:.)",
        ]
    )
)
_NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?")
_NUMBER_ELSEWHERE = re.compile(r"[0-9]*\.?[0-9]*(?:[eE][+-]?[0-9]+)?[fFdDlL]?")
_KNOWN: Final[dict[str, str]] = {
    "\n": _LINE,
    "\r\n": _LINE,
    "\r": _LINE,
    " ": _BLANK,
    **{word: word for word in (*words.KEYWORDS, *words.SIGNS, *_LEFT_TO_PARSER)},
}


@define(eq=False)
class Tokens:
    """The tokens of a text, a column a property; the last two are `END`, so one may always look one ahead.

    `kinds` holds the keyword or sign itself, or one of `NAME`, `NUMBER`, `MEMBER`, `BROKEN`, `END`. No token goes over
    the end of a line. `END` stands just after the last token. The parser rewrites kinds where it reads one thing
    as another.
    """

    kinds: list[str] = field(factory=list)
    texts: list[str] = field(factory=list)
    lines: list[int] = field(factory=list)
    columns: list[int] = field(factory=list)
    ends: list[int] = field(factory=list)

    def add(self, kind: str, text: str, line: int, column: int, end: int) -> None:
        """One more at the end."""
        self.kinds.append(kind)
        self.texts.append(text)
        self.lines.append(line)
        self.columns.append(column)
        self.ends.append(end)

    def extend(self, other: Tokens, start: int, stop: int) -> None:
        """Some tokens of another table at the end."""
        self.kinds += other.kinds[start:stop]
        self.texts += other.texts[start:stop]
        self.lines += other.lines[start:stop]
        self.columns += other.columns[start:stop]
        self.ends += other.ends[start:stop]

    def span(self, first: int, last: int) -> Span:
        """From the start of one token to the end of another."""
        return tuple.__new__(
            Span, (self.lines[first], self.columns[first], self.lines[last], self.ends[last])
        )

    def gap(self, index: int) -> Span:
        """What stands between a token and the next, in one line; else the empty piece before the next."""
        line, column = self.lines[index + 1], self.columns[index + 1]
        same = self.lines[index] == line
        return Span(line, self.ends[index] if same else column, line, column)

    def after(self, index: int) -> Span:
        """The empty piece just behind a token; at the start of the text for none (-1)."""
        if index < 0:
            return Span(1, 1, 1, 1)
        return Span(self.lines[index], self.ends[index], self.lines[index], self.ends[index])


def lines(text: str) -> list[str]:
    """The lines of a text, without their ends (LF, CRLF, CR): what the line of a `Span` counts."""
    return _LINE_END.split(text)


def tokens(text: str) -> tuple[Tokens, list[Diagnostic]]:
    """All tokens of a text, and what in it is none. A byte order mark at the start is passed over. Never raises."""
    found = Tokens()
    faults: list[Diagnostic] = []
    kinds, texts = found.kinds, found.texts
    rows, columns, ends = found.lines, found.columns, found.ends
    known = _KNOWN.copy()
    line = 1
    column = skipped = 1 if not text.startswith("\ufeff") else 2
    for piece in _PIECE.findall(text, skipped - 1):
        kind = known.get(piece)
        if kind is None:
            kind = known[piece] = _kind(piece)
        if kind is _BLANK:
            column += len(piece)
        elif kind is _LINE:
            line += 1
            column = 1
        else:
            end = column + len(piece)
            if kind is not _FAULT:
                kinds.append(kind)
                texts.append(piece)
                rows.append(line)
                columns.append(column)
                ends.append(end)
            else:
                over = _LINE_END.split(piece)
                below = line + len(over) - 1
                last = end if below == line else len(over[-1]) + 1
                kind, meant, fault = _fault(piece, Span(line, column, below, last))
                faults.append(fault)
                if kind:
                    found.add(kind, meant, line, column, end)
                line, end = below, last
            column = end
    close = found.after(len(kinds) - 1)
    for _ in range(2):
        found.add(END, "", close.line, close.column, close.column)
    return found, faults


def _kind(piece: str) -> str:
    """The kind of a piece that is neither keyword nor sign."""
    first = piece[0]
    if first in " \t" or piece.startswith("//"):
        return _BLANK
    if first.isalpha() and piece.isascii():
        return NAME
    if first in "0123456789":
        return NUMBER if _NUMBER.fullmatch(piece) and float(piece) < inf else _FAULT
    if first == "." and len(piece) > 1 and piece[1] not in "0123456789":
        return MEMBER
    return _FAULT


def _fault(piece: str, span: Span) -> tuple[str, str, Diagnostic]:
    """What to read a faulty piece as (a kind, or nothing, and a text), and what to say of it."""
    first = piece[0]
    if first in ".0123456789" and len(piece) + (first != ".") > 1:
        return _number(piece, span)
    meant = foreign.SIGNS.get(piece)
    if meant is None and len(piece) > 2 and piece[0] in ":<>!=" and piece[-1] == "=":
        meant = piece[0] + "="
    if meant is not None:
        return _sign(piece, meant, span)
    if first == "_" or first.isalnum():
        message = f"{quoted(piece)} is no name"
        hint = "A name is a letter from a to z or A to Z, then such letters, digits and `_`"
        return BROKEN, piece, Diagnostic("FA006", message, span, hint)
    if first in '"“' or (first == "'" and len(piece) > 1):
        message = "There is no text in quotes in this language"
        hint = (
            "`print` shows one number, truth value or entity; notes to the reader stand behind `//`"
        )
        return BROKEN, piece, Diagnostic("FA005", message, span, hint)
    if first == "#":
        hint = "Write `//`"
        fix = (Edit(Span(span.line, span.column, span.line, span.column + 1), "//"),)
        return "", "", Diagnostic("FA004", "A comment starts with `//`", span, hint, fix=fix)
    if piece.startswith("/*"):
        return "", "", _block_comment(piece, span)
    if piece.startswith("</"):
        message = f"{quoted(piece)} comes from a web page; it is no part of a program"
        return "", "", Diagnostic("FA007", message, span, "Remove it", fix=(Edit(span, ""),))
    if first == "\ufffd":
        message = "Here the text could not be decoded (U+FFFD stands in its place)"
        return BROKEN, piece, Diagnostic("FA002", message, span, "Save the program as UTF-8")
    if re.fullmatch(f"[{_UNSEEN}]+", piece):
        fix = (Edit(span, " "),)
        message = f"{_described(first)} is no white space in this language"
        return "", "", Diagnostic("FA001", message, span, "Use blanks", fix=fix)
    message = f"{_described(piece)} is no part of the language"
    return (
        BROKEN,
        piece,
        Diagnostic("FA001", message, span, _HINTS.get(first if first in "[]" else piece)),
    )


_NO_LISTS: Final = "There are no lists: each thing is a variable, and `foreach (asteroid, a) { … }` visits entities"
_HINTS: Final = {
    "**": "There is no power: multiply, as in `x * x`",
    "^": "There is no power: multiply, as in `x * x`",
    "[": _NO_LISTS,
    "]": _NO_LISTS,
    "~": "Not is `!`",
    "*/": "A comment starts with `//` and ends with its line",
    ".": "A point stands only between the digits of a number, as in `0.5`",
    '"': None,
}


def _number(piece: str, span: Span) -> tuple[str, str, Diagnostic]:
    """A number as other languages write it, one too large, or a name that starts with a digit."""
    try:
        value = float(piece.rstrip("fFdDlL") if _NUMBER_ELSEWHERE.fullmatch(piece) else "none")
    except ValueError:
        hint = "A number is digits, or digits, a point and digits; a name starts with a letter"
        message = f"{quoted(piece)} is neither a number nor a name"
        return BROKEN, piece, Diagnostic("FA003", message, span, hint)
    if value == inf:
        message = f"The number {quoted(piece)} is too large"
        return NUMBER, "1", Diagnostic("FA008", message, span, "The largest is about 1.8 * 10^308")
    meant = _digits(value)
    if meant is None:
        hint = "Write it as digits, a point and digits"
        return NUMBER, "1", Diagnostic("FA003", f"{quoted(piece)} is no number here", span, hint)
    message = f"A number is digits, or digits, a point and digits: not {quoted(piece)}"
    fix = (Edit(span, meant),)
    return NUMBER, meant, Diagnostic("FA003", message, span, f"Write `{meant}`", fix=fix)


def _digits(value: float) -> str | None:
    """A finite double as the language writes it, if that takes at most 40 characters."""
    from decimal import Decimal

    text = format(Decimal(repr(value)), "f")
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return text if len(text) <= 40 else None


def _sign(piece: str, meant: str, span: Span) -> tuple[str, str, Diagnostic]:
    """A sign spelt as elsewhere."""
    fix = (Edit(span, meant),)
    if piece.startswith("&") and len(piece) > 2:
        message = f"{quoted(piece)} comes from the source of a web page"
        return meant, meant, Diagnostic("FA007", message, span, f"Write `{meant}`", fix=fix)
    if " " in piece or "\t" in piece:
        message = f"`{meant}` is one sign, without a blank in it"
    else:
        message = f"{_described(piece)} is no sign of the language"
    return meant, meant, Diagnostic("FA009", message, span, f"Write `{meant}`", fix=fix)


def _block_comment(piece: str, span: Span) -> Diagnostic:
    """`/* … */`, mended only if nothing stands behind it in its line (that is for the reader to see)."""
    message = "A comment starts with `//` and ends with its line"
    fix: tuple[Edit, ...] = ()
    if span.line == span.end_line and piece.endswith("*/") and len(piece) >= 4:
        # A line end behind it, so that what follows is no comment.
        fix = (Edit(span, "//" + piece[2:-2].rstrip() + "\n"),)
    return Diagnostic("FA004", message, span, "Write `//` before each line of it", fix=fix)


def quoted(text: str) -> str:
    """A piece of source for a message: between backquotes, cut to some length, in one printable line."""
    shown = "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in text[:25])
    return f"`{shown}`" if len(shown) <= 24 else f"`{shown[:20]}…`"


def _described(text: str) -> str:
    """Odd characters for a message: with its name or number if one cannot be seen or typed."""
    if text.isascii() and text.isprintable():
        return quoted(text)
    from unicodedata import name

    odd = text[0]
    number = f"U+{ord(odd):04X}"
    named = name(odd, "")
    full = f"{number} ({named})" if named else number
    shown = f"{quoted(odd)}, {full}," if odd.isprintable() else f"The character {full}"
    return shown if len(text) == 1 else f"{quoted(text)} (the first is {full})"


_MOST_UNDECODABLE: Final = 5
_UNDECODABLE = re.compile("[\udc80-\udcff]+")


def decoded(data: bytes) -> tuple[str, tuple[Diagnostic, ...]]:
    """A program's bytes as text: UTF-8, with U+FFFD for each byte that is none, and errors at the first few places.

    A byte order mark at the start is left out. `parse_program` reports each U+FFFD as well: `parse_bytes` joins the
    two, so that nothing is told twice.
    """
    data = data.removeprefix(b"\xef\xbb\xbf")
    text = data.decode(errors="surrogateescape")
    faults: list[Diagnostic] = []
    for run in islice(_UNDECODABLE.finditer(text), _MOST_UNDECODABLE):
        before = text[: run.start()]
        above = _LINE_END.split(before)
        line, column = len(above), len(above[-1]) + 1
        span = Span(line, column, line, column + len(run[0]))
        offset = len(before.encode(errors="surrogateescape"))
        message = f"Byte {offset + 1} of the text (0x{data[offset]:02X}) is not UTF-8"
        faults.append(Diagnostic("FA002", message, span, "Save the program as UTF-8"))
    return _UNDECODABLE.sub(lambda run: "\ufffd" * len(run[0]), text), tuple(faults)
