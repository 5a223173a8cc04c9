"""Variables that are declared in vain: never read, never set, or neither."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Final

from fasteroids.lang import syntax
from fasteroids.lang.checker.types import wants, with_article
from fasteroids.lang.checker.uses import Construct, declarations
from fasteroids.lang.diagnostics import Diagnostic, Edit, Note
from fasteroids.lang.names import shortened
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Declaration, Expression, Name, Program, Type

__all__ = ["never_set", "warnings"]

_BEFORE: Final[dict[Type, str]] = {"bool": "false", "double": "0", "entity": "null"}
"""What a variable holds that was never set."""

_LINE_END = re.compile(r"\r\n?|\n")
_BLANKS = re.compile(r"[ \t]*")


def warnings(tree: Program, program: Sequence[Construct]) -> Iterator[Diagnostic]:
    """FA204 to FA206, at the first declaration of the variable."""
    written, looped = _written(program)
    read = _read(program)
    rows = _LINE_END.split(tree.source)
    for name, each in declarations(program).items():
        if name in looped:  # its loop needs it, read or not
            continue
        if name in written and name not in read:
            yield _unread(each[0], written[name])
        elif name in read and name not in written:
            yield _unset(each[0], read[name])
        elif name not in read:
            yield _unused(each, rows if tree.source else None)


def never_set(program: Sequence[Construct]) -> frozenset[str]:
    """The declared variables that keep their first value for ever."""
    written, looped = _written(program)
    return frozenset(declarations(program).keys() - written.keys() - looped)


def _written(program: Sequence[Construct]) -> tuple[dict[str, Name], set[str]]:
    """The variables that are assigned, each with the first place, and those of a for-each."""
    written: dict[str, Name] = {}
    looped: set[str] = set()
    for node, _ in program:
        match node:
            case syntax.Assignment(target):
                written.setdefault(target.name, target)
            case syntax.Declaration(_, target, value) if value is not None:
                written.setdefault(target.name, target)
            case syntax.ForEach(_, variable):
                looped.add(variable.name)
    return written, looped


def _read(program: Sequence[Construct]) -> dict[str, Name]:
    """The variables that are read, each with the first place. To work out its own next value is not to read it."""
    found: dict[str, Name] = {}
    for node, _ in program:
        match node:
            case syntax.Assignment(target, value) | syntax.Declaration(_, target, value):
                for name in _names(value) if value is not None else ():
                    if name.name != target.name:
                        found.setdefault(name.name, name)
            case syntax.If() | syntax.While() | syntax.Print() | syntax.Turn():
                for part, _ in wants(node, {}):
                    for name in _names(part):
                        found.setdefault(name.name, name)
    return found


def _names(e: Expression) -> Iterator[Name]:
    """The variables in an expression, in the order of the text."""
    if isinstance(e, Name):
        yield e
    for part, _ in wants(e, {}):
        yield from _names(part)


# What is said.


def _unread(declaration: Declaration, first: Name) -> Diagnostic:
    target = declaration.target
    name = shortened(target.name)
    return Diagnostic(
        "FA204",
        f"`{name}` is set, but never read",
        target.span,
        hint=f"Use `{name}`, or leave it and its assignments out",
        label="never read",
        notes=(Note("set here", first.span),) if first is not target else (),
        severity="warning",
    )


def _unset(declaration: Declaration, first: Name) -> Diagnostic:
    target = declaration.target
    name, kind = shortened(target.name), declaration.type
    return Diagnostic(
        "FA205",
        f"`{name}` is read, but never set: it is always {_BEFORE[kind]}",
        target.span,
        hint=f"Give `{name}` {with_article(kind)}, with `{name} := ...;`",
        label="never set",
        notes=(Note("read here", first.span),),
        severity="warning",
    )


def _unused(each: Sequence[Declaration], rows: Sequence[str] | None) -> Diagnostic:
    """Declared only; without a value, so that to remove it changes nothing."""
    return Diagnostic(
        "FA206",
        f"`{shortened(each[0].target.name)}` is not used",
        each[0].target.span,
        hint="Leave the declaration out",
        label="not used",
        fix=tuple(Edit(_removal(one.span, rows), "") for one in each) if rows is not None else (),
        severity="warning",
    )


def _removal(span: Span, rows: Sequence[str]) -> Span:
    """The whole line, if nothing else is in it; else the declaration and the blanks behind it."""
    last = rows[span.end_line - 1]
    behind = _blanks(last, span.end_column - 1)
    if behind < len(last):
        return span._replace(end_column=behind + 1)
    if _blanks(rows[span.line - 1], 0) < span.column - 1 or span.end_line == len(rows):
        return span
    return Span(span.line, 1, span.end_line + 1, 1)


def _blanks(row: str, at: int) -> int:
    """Where the blanks and tabs end that are at a place of a line."""
    found = _BLANKS.match(row, at)
    assert found is not None
    return found.end()
