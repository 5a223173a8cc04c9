"""What each variable of a program is: its type, and what is wrong with its declarations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from attrs import frozen

from fasteroids.lang.checker.types import CONSTANT_TYPES, with_article
from fasteroids.lang.checker.uses import Construct, How, Use, constructs, declarations, uses
from fasteroids.lang.diagnostics import Diagnostic, Edit, Note
from fasteroids.lang.names import closest, shortened
from fasteroids.lang.parser.foreign import CONSTANTS
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Declaration, Program, Type

__all__ = ["Variables", "declared", "type_span", "understood"]

_MOST_NOTES: Final = 3
"""Further uses that one diagnostic shows."""

_MOST_COMPARISONS: Final = 2_000
"""Comparisons of names in search of slips in one program; a bound, so that no text takes long to check."""


@frozen
class Variables:
    """The variables of a program as its author most likely means them.

    `types` has every variable whose type is certain enough to hold uses against it: declared once, or with one
    type; undeclared, but used as of one type. `declared_at` has the one declaration that decides, for those of
    which a use that disagrees should be shown it.
    """

    types: Mapping[str, Type]
    declared_at: Mapping[str, Declaration]
    complaints: tuple[Diagnostic, ...]


def declared(tree: Program) -> dict[str, Type]:
    """The type of each declared variable, in the order of first declaration.

    In a well-typed program all declarations of a name agree; where they do not, the last wins (as in 2013).
    """
    return {name: found[-1].type for name, found in declarations(constructs(tree)).items()}


def understood(tree: Program, program: Sequence[Construct]) -> Variables:
    """Gather the variables of a program, and complain of declarations: absent, contradictory, or wrong throughout."""
    found = declarations(program)
    types = {name: each[0].type for name, each in found.items() if not _contradictory(each)}
    complaints = [_twice(each) for each in found.values() if _contradictory(each)]
    mistaken = _mistaken(program, types)
    types |= mistaken
    used = uses(program, types)
    complaints += [_misdeclared(found[name], used[name], kind) for name, kind in mistaken.items()]
    absent = {name: each for name, each in used.items() if name not in found}
    inferred = _inferred(absent)
    place = _place_for_declarations(tree)
    near = _Near({**types, **{n: k for n, k in inferred.items() if _lives(absent[n])}})
    for name, each in absent.items():
        meant = near.meant(name, each, inferred.get(name))
        if meant is not None:
            complaints.append(_misspelt(name, each, meant, found.get(meant)))
        else:
            complaints.append(_undeclared(name, each, inferred.get(name), place))
    at = {name: each[0] for name, each in found.items() if name in types and name not in mistaken}
    return Variables(types | inferred, at, tuple(complaints))


# Declared twice, or wrongly.


def _contradictory(each: Sequence[Declaration]) -> bool:
    return any(one.type != each[0].type for one in each)


def type_span(declaration: Declaration) -> Span:
    """The place of the word for the type, with which a declaration starts."""
    line, column = declaration.span.start
    return Span(line, column, line, column + len(declaration.type))


def _twice(each: Sequence[Declaration]) -> Diagnostic:
    first = each[0]
    other = next(one for one in each if one.type != first.type)
    name = shortened(first.target.name)
    return Diagnostic(
        "FA102",
        f"`{name}` is declared twice, with different types",
        other.target.span,
        hint="All variables are global, also those declared in a block: keep one declaration, or rename one",
        label=f"declared {other.type} here",
        notes=(Note(f"declared {first.type} here", first.target.span),),
    )


def _mistaken(program: Sequence[Construct], types: Mapping[str, Type]) -> dict[str, Type]:
    """Variables whose every use asks for another type than they are declared with, and that type.

    One slip is no proof, so it takes two uses that say so by themselves; being the variable of a for-each is enough.
    What the declared types of other variables say must not speak against it.
    """
    likely: dict[str, Type] = {}
    for name, each in uses(program, {}).items() if types else ():
        kinds = set(_asked(each))
        hard = [use for use in each if use.wanted is not None]
        enough = len(hard) > 1 or any(use.how == "looped" for use in hard)
        if enough and len(kinds) == 1 and name in types and types[name] not in kinds:
            likely[name] = kinds.pop()
    if not likely:
        return {}
    settled = {**types, **likely}
    all_uses = uses(program, settled)
    return {
        name: kind
        for name, kind in likely.items()
        if all(use.wanted in (kind, None) for use in all_uses[name])
    }


def _misdeclared(found: Sequence[Declaration], each: Sequence[Use], kind: Type) -> Diagnostic:
    first = found[0]
    name = shortened(first.target.name)
    return Diagnostic(
        "FA110",
        f"`{name}` is declared {first.type}, but used as {with_article(kind)} throughout",
        type_span(first),
        hint=f"Declare it `{kind} {name};`",
        label=f"declared {first.type} here",
        notes=_shown([use for use in each if use.wanted is not None]),
        fix=tuple(Edit(type_span(one), kind) for one in found),
    )


# Not declared.


def _inferred(absent: Mapping[str, Sequence[Use]]) -> dict[str, Type]:
    """The types that undeclared variables should get: what all their uses ask for.

    `x := y` and `x == y` hand a type on between two variables of which one has no other evidence.
    """
    asked = {name: _asked(each) for name, each in absent.items()}
    certain = {name: kind for name, kinds in asked.items() if len(kinds) == 1 for kind in kinds}
    todo = [*certain]
    while todo:
        name = todo.pop()
        for use in absent[name]:
            other = use.other
            if other is not None and asked.get(other) == {} and other not in certain:
                certain[other] = certain[name]
                todo.append(other)
    return certain


def _asked(each: Sequence[Use]) -> dict[Type, Use]:
    """The types that uses ask for, each with the first that does."""
    asked: dict[Type, Use] = {}
    for use in each:
        if use.wanted is not None:
            asked.setdefault(use.wanted, use)
    return asked


def _lives(each: Sequence[Use]) -> bool:
    """Is a name both set and read, so that it is a variable of its own, and no slip for another?"""
    hows = {use.how for use in each}
    return not hows.isdisjoint(_SETS) and not hows <= _SETS


_SETS: Final[frozenset[How]] = frozenset({"set", "looped"})


class _Near:
    """Finds the known names that undeclared ones may be slips for, within a bound on work."""

    def __init__(self, types: Mapping[str, Type]) -> None:
        self._types = types
        self._left = _MOST_COMPARISONS

    def meant(self, name: str, each: Sequence[Use], kind: Type | None) -> str | None:
        """The variable or constant that was most likely meant, of the type wanted.

        A name that lives is no slip: its declaration is missing.
        """
        if _lives(each):
            return None
        hows = {use.how for use in each}
        self._left -= len(self._types)
        if self._left < 0:
            return None
        foreign = CONSTANTS.get(name)
        if (
            foreign is not None
            and hows.isdisjoint(_SETS)
            and kind in (CONSTANT_TYPES[foreign], None)
        ):
            return foreign
        candidates = [known for known, its in self._types.items() if kind in (its, None)]
        if hows.isdisjoint(_SETS):
            candidates += [word for word, its in CONSTANT_TYPES.items() if kind in (its, None)]
        return closest(name, candidates)


def _misspelt(
    name: str, each: Sequence[Use], meant: str, known: Sequence[Declaration] | None
) -> Diagnostic:
    at = [Note(f"`{meant}` is declared here", known[0].target.span)] if known else []
    return Diagnostic(
        "FA101",
        f"`{shortened(name)}` is not declared",
        each[0].name.span,
        hint=f"Did you mean `{meant}`?",
        label="used here",
        notes=(*at, *_shown(each[1:], again=True)),
        fix=tuple(Edit(use.name.span, meant) for use in each),
    )


def _undeclared(name: str, each: Sequence[Use], kind: Type | None, place: _Place) -> Diagnostic:
    short = shortened(name)
    asked = _asked(each)
    first, others = each[0], list(each[1:])
    if kind is not None:
        hint = f"Declare it: add `{kind} {short};`"
    elif asked:
        hint = f"Declare it with one type; now it is used as {_listed([*asked])}"
        others = [use for use in asked.values() if use is not first]
    else:
        hint = f"Declare it with its type, such as `double {short};`"
    return Diagnostic(
        "FA101",
        f"`{short}` is not declared",
        first.name.span,
        hint=hint,
        label=_told(first),
        notes=_shown(others, again=kind is not None or not asked),
        fix=(place.edit(f"{kind} {name};"),) if kind is not None else (),
    )


def _listed(kinds: Sequence[Type]) -> str:
    return " and as ".join(with_article(kind) for kind in kinds)


def _shown(each: Sequence[Use], *, again: bool = False) -> tuple[Note, ...]:
    """Notes at a few uses; the last tells how many more there are."""
    notes = [Note("used here too" if again else _told(use), use.name.span) for use in each]
    more = len(notes) - _MOST_NOTES
    if more > 0:
        last = notes[_MOST_NOTES - 1]
        notes[_MOST_NOTES - 1 :] = [
            Note(f"{last.text}, and {more} more {'uses' if more > 1 else 'use'}", last.span)
        ]
    return tuple(notes)


def _told(use: Use) -> str:
    if use.wanted is None:
        return "set here" if use.how == "set" else "used here"
    kind = with_article(use.wanted)
    match use.how:
        case "set":
            return f"set to {kind} here"
        case "compared":
            return f"compared with {kind} here"
        case "looped":
            return "set to each entity here"
        case "used":
            return f"used as {kind} here"


# Where a new declaration goes.


@frozen
class _Place:
    """Where to put a declaration, and what to put before and behind it there."""

    span: Span
    behind: str

    def edit(self, text: str) -> Edit:
        """Put it there."""
        return Edit(self.span, text + self.behind)


def _place_for_declarations(tree: Program) -> _Place:
    """Behind the declarations at the top, on a line of its own; without any, before the first statement.

    So comments at the top stay there, and those above the first statement behind the declarations stay with it.
    """
    statements = tree.body.statements
    if not statements:
        return _Place(Span(1, 1, 1, 1), "\n")
    last: Declaration | None = None
    for each in statements:
        if isinstance(each, Declaration):
            last = each
            continue
        if last is None:
            break
        line = last.span.end_line + 1
        if each.span.line < line:
            return _Place(Span(*each.span.start, *each.span.start), " ")
        return _Place(Span(line, 1, line, 1), "\n")
    start = statements[0].span.start
    return _Place(Span(*start, *start), "\n" + " " * (start[1] - 1))
