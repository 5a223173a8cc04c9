"""What could be written at a place: variables, words and whole statements, the likeliest first.

The tokens before the place decide, so it works on half-typed text: after `getx` an entity, after `foreach (` a kind,
after `:=` what has the type of the variable, and behind a `;` a statement.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Final, Literal, get_args

from attrs import frozen

from fasteroids.lang import syntax, words
from fasteroids.lang.checker.types import CONSTANT_TYPES, EQUALITIES, GIVES, TAKES
from fasteroids.lang.meanings import MEANINGS
from fasteroids.lang.parser.lexer import NAME, NUMBER
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Type
from fasteroids.lsp.reading import Place, Reading

__all__ = ["SNIPPETS", "Completion", "Kind", "completions"]

Kind = Literal["variable", "statement", "type", "kind", "constant", "function", "operator"]

SNIPPETS: Final[Mapping[str, str]] = {
    "if": "if (${1:true}) {\n  $0\n}",
    "else": "else {\n  $0\n}",
    "while": "while (${1:true}) {\n  $0\n}",
    "foreach": f"foreach (${{1|{','.join(words.KINDS)}|}}, ${{2:a}}) {{\n  $0\n}}",
    "print": "print ${1:0};",
    "turn": "turn ${1:0.1};",
    "fire": "fire;",
    "thrust": "thrust;",
    "thrust_off": "thrust_off;",
    "skip": "skip;",
    "double": "double ${1:d};",
    "entity": "entity ${1:e};",
    "bool": "bool ${1:b};",
    **{call: f"{call}($1)" for call in words.CALLS},
}
"""What a word brings along: `${1:x}` is a place to fill in, with `x` in it at first, and `$0` where one ends up."""

_PLACEHOLDER: Final = re.compile(r"\$[0-9{]")

_TAKES_BOOL: Final = ("if", "while", "&&", "||", "!")
_ASSIGNS: Final = (":=", "=")
_OPENS: Final = frozenset(
    {
        *EQUALITIES,
        *_TAKES_BOOL,
        *_ASSIGNS,
        *words.TYPES,
        "(",
        ",",
        "turn",
        "print",
        "foreach",
        "else",
    }
)
_GOES_ON: Final = frozenset(
    {NUMBER, "(", "{", "!", "-", *words.CONSTANTS, *words.GETTERS, *words.CALLS}
)
"""What goes on with a statement, or a call, whose first word stands before it; names do too."""

_BEFORE_STATEMENT: Final = (";", "{", "}", "skip")
_ANY: Final[tuple[Type | None, ...]] = (*get_args(Type), None)


@frozen
class Completion:
    """Something to write in the place of `span`, which is the part of a word before the cursor, or empty.

    `snippet` has places to fill in (`SNIPPETS`); `plain` is for editors that know none.
    """

    label: str
    kind: Kind
    detail: str
    sentence: str
    span: Span
    plain: str
    snippet: str


def completions(reading: Reading, place: Place, *, typed: str = "") -> list[Completion]:
    """What could be written at a place, the likeliest first. Nothing in comments, in numbers and behind an operand.

    `typed` is the sign, perhaps a blank, that was typed just now and made the editor ask: then a whole statement is not
    offered, since nobody needs that after every blank.
    """
    if reading.in_comment(place):
        return []
    before, span = _before(reading, place)
    if before is None:
        return []
    if not _in_statement(reading, before, place):
        return [*_statements(reading, before, place, span)] if not typed else []
    return [*_operands(reading, before, span)]


def _before(reading: Reading, place: Place) -> tuple[int | None, Span]:
    """The token before the word that is being written at a place, -1 if none; and the part of that word before it.

    None where no word can be written: in or right behind something else than a word.
    """
    empty = Span(*place, *place)
    last = reading.last_before(place)
    if last < 0:
        return last, empty
    t = reading.tokens
    line, column = place
    if t.lines[last] != line or t.ends[last] < column:
        return last, empty
    if reading.is_word(last):
        return last - 1, Span(line, t.columns[last], line, column)
    if t.ends[last] > column or t.kinds[last] == NUMBER:
        return None, empty
    return last, empty


def _in_statement(reading: Reading, before: int, place: Place) -> bool:
    """Does a statement go on at a place, of which this is the token before?"""
    if before < 0 or reading.tokens.kinds[before] in _BEFORE_STATEMENT:
        return False
    # An operand that ends a line is most likely the end of a statement whose `;` lacks.
    ends = not _takes_more(reading.tokens.kinds[before])
    return not (ends and reading.tokens.lines[before] < place[0])


def _takes_more(kind: str) -> bool:
    """Must something follow this token in its statement?"""
    return kind in TAKES or kind in _OPENS


# Statements.


def _statements(reading: Reading, before: int, place: Place, span: Span) -> Iterator[Completion]:
    """What a statement can start with."""
    if _else_may_follow(reading, before, span):
        yield _word(reading, "else", "statement", span)
    yield from _variables(reading, span, _ANY)
    in_loop = _in_foreach(reading, place)
    for word in ("if", "while", "foreach", "print"):
        yield _word(reading, word, "statement", span)
    for word in words.ACTIONS if not in_loop else ():
        yield _word(reading, word, "statement", span)
    for word in words.TYPES:
        yield _word(reading, word, "type", span)


def _else_may_follow(reading: Reading, before: int, span: Span) -> bool:
    """Is the token before the `}` of an `if` that has no `else` yet?"""
    kinds = reading.tokens.kinds
    if before < 0 or kinds[before] != "}":
        return False
    behind = before + 1 + (span.start != span.end)
    if kinds[min(behind, len(kinds) - 1)] == "else":
        return False
    end = reading.tokens.span(before, before).end
    return any(
        isinstance(node, syntax.If) and node.then.span.end == end for node, _ in reading.constructs
    )


def _in_foreach(reading: Reading, place: Place) -> bool:
    """Is a place in the body of a for-each, where no action may stand?"""
    return any(
        isinstance(node, syntax.ForEach) and node.body.span.start < place < node.body.span.end
        for node, _ in reading.constructs
    )


# Within statements.


def _operands(reading: Reading, before: int, span: Span) -> Iterator[Completion]:
    """What a statement can go on with behind a token."""
    kinds = reading.tokens.kinds
    kind = kinds[before]
    if kind == "(" and before and kinds[before - 1] == "foreach":
        for word in words.KINDS:
            yield _word(reading, word, "kind", span)
    elif kind == ",":
        yield from _variables(reading, span, ("entity", None))
    elif kind == "else":
        yield _word(reading, "if", "statement", span)
    elif kind in words.TYPES:
        yield from _undeclared(reading, kind, span)
    elif kind in words.GETTERS:
        yield from _variables(reading, span, ("entity", None))
        yield _word(reading, "self", "constant", span)
    elif _takes_more(kind) and kind != "foreach":
        yield from _expressions(reading, _wanted(reading, before), span)


def _expressions(reading: Reading, wanted: Type | None, span: Span) -> Iterator[Completion]:
    """What an expression can start with, first what has the type that is wanted."""
    ordered = sorted(_ANY, key=lambda kind: kind != wanted)
    # A bool may start with a double or an entity, as in `d < 3`; the others start with their own type.
    first = 1 if wanted in ("double", "entity") else len(ordered)
    yield from _variables(reading, span, ordered[:first])
    fitting = [word for word in words.CONSTANTS if wanted in (None, CONSTANT_TYPES[word])]
    other = [word for word in words.CONSTANTS if word not in fitting]
    for word in fitting:
        yield _word(reading, word, "constant", span)
    for word in words.GETTERS if wanted != "entity" else ():
        yield _word(reading, word, "operator", span)
    for word in words.CALLS if wanted != "entity" else ():
        yield _word(reading, word, "function", span)
    yield from _variables(reading, span, ordered[first:])
    for word in other:
        yield _word(reading, word, "constant", span)


def _wanted(reading: Reading, before: int) -> Type | None:
    """The type that is wanted behind a token; None if any will do, or if it is not evident."""
    kinds, texts = reading.tokens.kinds, reading.tokens.texts
    while before and kinds[before] == "(":
        before -= 1
    kind = kinds[before]
    if kind in _TAKES_BOOL:
        return "bool"
    if kind in TAKES:
        return TAKES[kind]
    if kind == "turn":
        return "double"
    if kind in _ASSIGNS and before:
        return reading.type_of(texts[before - 1])
    if kind in EQUALITIES and before:
        return _ending(reading, before - 1)
    return None


def _ending(reading: Reading, last: int) -> Type | None:
    """The type of an expression, as far as its last token shows it."""
    kinds = reading.tokens.kinds
    if kinds[last] == NUMBER or (last and kinds[last - 1] in GIVES):
        return "double"
    if kinds[last] == NAME:
        return reading.type_of(reading.tokens.texts[last])
    return CONSTANT_TYPES.get(kinds[last])


# What is offered.


def _variables(reading: Reading, span: Span, kinds: Iterable[Type | None]) -> Iterator[Completion]:
    """The variables of these types, type by type, each in the order of the text."""
    names = [name for name, places in reading.names.items() if not _only_here(places, span)]
    for kind in kinds:
        for name in names:
            if reading.type_of(name) == kind:
                detail = kind or "type unknown"
                where = "" if name in reading.declarations else "Not declared."
                yield Completion(name, "variable", detail, where, span, name, name)


def _undeclared(reading: Reading, kind: str, span: Span) -> Iterator[Completion]:
    """Variables that a declaration is missing for, first those that are used as of this type."""
    absent = [name for name in reading.names if name not in reading.declarations]
    absent = [name for name in absent if not _only_here(reading.names[name], span)]
    for name in sorted(absent, key=lambda name: reading.type_of(name) != kind):
        detail = reading.type_of(name) or "type unknown"
        yield Completion(name, "variable", detail, "Not declared.", span, name, name)


def _only_here(places: list[Span], span: Span) -> bool:
    """Is a name just the word that is being written?"""
    return len(places) == 1 and places[0].start == span.start and span.start != span.end


def _word(reading: Reading, word: str, kind: Kind, span: Span) -> Completion:
    meaning = MEANINGS[word]
    snippet = SNIPPETS.get(word, word)
    t = reading.tokens
    behind = reading.last_before(span.end) + 1
    if t.lines[behind] == span.end_line:
        if _goes_on(reading, word, behind):
            snippet = word
        elif t.kinds[behind] == ";":
            snippet = snippet.removesuffix(";")
    plain = word if _PLACEHOLDER.search(snippet) else snippet
    return Completion(word, kind, meaning.usage, meaning.sentence, span, plain, snippet)


def _goes_on(reading: Reading, word: str, behind: int) -> bool:
    """Does the token behind a word go on with what the word starts, so that there is nothing to fill in?"""
    kinds = reading.tokens.kinds
    if kinds[behind] == NAME:
        # `x :=` is a statement of its own, but for a type: `double x := 1;`.
        return word in words.TYPES or kinds[behind + 1] != ":="
    return kinds[behind] in _GOES_ON or (word == "else" and kinds[behind] == "if")
