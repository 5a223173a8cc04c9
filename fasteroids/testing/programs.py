"""Hypothesis strategies for programs of ships, type correct by construction (assignment 1.8.3).

Nothing is filtered: an expression is asked for by its type, and what stands inside a for-each is asked for without
actions. The variables are always the same few, three doubles `x y z`, two bools `p q`, three entities `a b c`, and only
those that the program uses are declared: where the draw wants it, or else at its start. So everything shrinks, to
the empty program in the end.

Most programs reach an action, read entities and go on for a while. They do what real ones do: count, test for
null before they read, look through all entities and keep one. Some read null, divide by nothing, turn by nan, never
end, or never act.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Final, NamedTuple, TypeVar

from hypothesis import strategies as st

from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Kind,
    Name,
    Null,
    Number,
    Print,
    Program,
    Self,
    Statement,
    Truth,
    Turn,
    Type,
    Unary,
    While,
)

__all__ = ["expressions", "numbers", "program_texts", "programs"]

_T = TypeVar("_T")

VARIABLES: Final[Mapping[str, Type]] = {
    "x": "double", "y": "double", "z": "double",
    "p": "bool", "q": "bool",
    "a": "entity", "b": "entity", "c": "entity",
}  # fmt: skip

_TYPES: Final[tuple[Type, ...]] = ("double", "bool", "entity")
KINDS: Final[tuple[Kind, ...]] = ("asteroid", "any", "ship", "bullet")
_ARITHMETIC: Final = ("+", "-", "*", "/", "%")
_ORDER: Final = ("<", "<=", ">", ">=")
_CALLS: Final = ("sqrt", "sin", "cos")
_GETTERS: Final = ("getx", "gety", "getvx", "getvy", "getradius")

numbers: Final[st.SearchStrategy[Number]] = st.one_of(
    st.sampled_from([0.0, 1.0, 2.0, 3.0, 0.5, 0.1, 10.0, 200.0]),
    st.integers(0, 1000).map(lambda n: n / 8),
    st.floats(min_value=0.0, allow_nan=False, allow_infinity=False),
).map(Number)
"""Constants: small and round ones mostly, else any finite double from 0."""


class _Scope(NamedTuple):
    """What a piece of a program may do where it stands."""

    names: dict[Type, tuple[str, ...]]
    """The variables by type."""
    actions: tuple[str, ...]
    """The actions allowed; none inside a for-each."""
    declared: set[str]
    """Variables that have their declaration. Grows."""
    used: set[str]
    """Variables that the program mentions. Grows."""
    known: tuple[str, ...] = ()
    """Entities that are probably not null here: a test or a for-each stands around."""
    fixed: tuple[str, ...] = ()
    """Variables that a loop around counts with: only that loop assigns them."""

    def name(self, name: str) -> Name:
        """A variable, on its way into the program."""
        self.used.add(name)
        return Name(name)

    def knowing(self, name: str) -> _Scope:
        """The same where `name` is no null."""
        return self._replace(known=(*self.known, name))


def _by_type(variables: Mapping[str, Type]) -> dict[Type, tuple[str, ...]]:
    return {kind: tuple(n for n, t in variables.items() if t == kind) for kind in _TYPES}


@cache
def _among(some: tuple[_T, ...]) -> st.SearchStrategy[_T]:
    """One of them; made once, since so many are drawn."""
    return st.sampled_from(some)


def expressions(
    type: Type, variables: Mapping[str, Type] = VARIABLES, *, depth: int = 4
) -> st.SearchStrategy[Expression]:
    """Expressions of a type over some variables, at most `depth + 2` nodes deep."""
    return _expression(type, _Scope(_by_type(variables), (), set(), set()), depth)


# Forms. One is drawn from the same list at every place, and where it has no room or no sense it gives way to a simple
# one. So a choice means the same at every depth, and only what nests in itself is a strategy: a shrinking search then
# knows that it may put an inner piece in the place of an outer one.

_DOUBLES: Final = st.sampled_from([
    *("zero", "number", "number", "getdir", "variable", "variable", "variable"),
    *("getter", "getter", "getter", "arithmetic", "arithmetic", "arithmetic", "minus", "call"),
])  # fmt: skip
_BOOLS: Final = st.sampled_from([
    *("truth", "variable", "order", "order", "order", "equality", "equality", "not", "join"),
    *("guarded", "guarded"),
])  # fmt: skip
_STATEMENTS: Final = st.sampled_from([
    *("print", "action", "action", "action", "action", "action", "action", "declaration"),
    *("assignment", "assignment", "assignment", "assignment"),
    *("if", "if", "test", "test", "foreach", "foreach", "foreach"),
    *("while", "forever", "count", "count"),
])  # fmt: skip

_NESTING: Final = frozenset(
    {"arithmetic", "minus", "call", "order", "equality", "not", "join", "guarded"}
    | {"if", "test", "foreach", "while", "forever", "count"}
)
"""Forms that want room for what is in them."""


# Expressions. `room` is how many operators may still be nested.


@st.composite
def _expression(draw: st.DrawFn, type: Type, scope: _Scope, room: int) -> Expression:
    match type:
        case "double":
            return _double(draw, scope, room)
        case "bool":
            return _bool(draw, scope, room)
        case "entity":
            return _entity(draw, scope)


def _double(draw: st.DrawFn, scope: _Scope, room: int) -> Expression:
    names = scope.names["double"]
    form = draw(_DOUBLES)
    inner = _expression("double", scope, room - 1)
    match "variable" if form in _NESTING and not room else form:
        case "zero":  # drawn in one, to shrink to
            return Number(0.0)
        case "variable" if names:
            return scope.name(draw(_among(names)))
        case "getter":
            return Unary(draw(_among(_GETTERS)), _subject(draw, scope))
        case "arithmetic":
            return Binary(draw(_among(_ARITHMETIC)), draw(inner), draw(inner))
        case "minus":
            return Unary("-", draw(inner))
        case "call":
            return Unary(draw(_among(_CALLS)), draw(inner))
        case "getdir":
            return Direction()
    return draw(numbers)


def _bool(draw: st.DrawFn, scope: _Scope, room: int) -> Expression:
    names, entities = scope.names["bool"], scope.names["entity"]
    form = draw(_BOOLS)
    match "variable" if form in _NESTING and not room else form:
        case "variable" if names:
            return scope.name(draw(_among(names)))
        case "order":
            inner = _expression("double", scope, room - 1)
            return Binary(draw(_among(_ORDER)), draw(inner), draw(inner))
        case "equality":
            inner = _expression(draw(_among(("entity", *_TYPES))), scope, room - 1)
            return Binary(draw(_among(("==", "!="))), draw(inner), draw(inner))
        case "not":
            return Unary("!", draw(_expression("bool", scope, room - 1)))
        case "join":
            inner = _expression("bool", scope, room - 1)
            return Binary(draw(_among(("&&", "||"))), draw(inner), draw(inner))
        case "guarded" if entities:
            # The right side is only met where the left one says that there is an entity.
            name = draw(_among(entities))
            equal, join = draw(_among((("!=", "&&"), ("==", "||"))))
            rest = draw(_expression("bool", scope.knowing(name), room - 1))
            return Binary(join, Binary(equal, scope.name(name), Null()), rest)
    return Truth(draw(st.booleans()))


def _entity(draw: st.DrawFn, scope: _Scope) -> Expression:
    names = scope.names["entity"]
    match draw(_among(("self", "variable", "variable", "null"))):
        case "variable" if names:
            return scope.name(draw(_among((*scope.known, *names))))
        case "null":
            return Null()
    return Self()


def _subject(draw: st.DrawFn, scope: _Scope) -> Expression:
    """An entity to read from: seldom null."""
    match draw(_among(("self", "self", "known", "known", "known", "any"))):
        case "known" if scope.known:
            return scope.name(draw(_among(scope.known)))
        case "any":
            return _entity(draw, scope)
    return Self()


# Statements. `room` is how many blocks may still be nested.

_DEPTH: Final = 3  # of expressions in statements


@st.composite
def _block(draw: st.DrawFn, scope: _Scope, room: int) -> Block:
    """Up to as many statements as there is room, and three; more where some belong together."""
    rows = draw(st.lists(_statement(scope, room), max_size=room + 3))
    return Block(tuple(s for row in rows for s in row))


@st.composite
def _statement(draw: st.DrawFn, scope: _Scope, room: int) -> tuple[Statement, ...]:
    """One statement, or some that belong together."""
    form = draw(_STATEMENTS)
    match "assignment" if form in _NESTING and not room else form:
        case "action" if scope.actions:
            return (_action(draw, scope),)
        case "assignment":
            name, type = _target(draw, scope)
            return (Assignment(name, draw(_expression(type, scope, _DEPTH))),)
        case "declaration":
            return (_declaration(draw, scope),)
        case "if":
            return (_if(draw, scope, room),)
        case "test":
            return (_test(draw, scope, room),)
        case "foreach":
            return (_foreach(draw, scope, room),)
        case "while":
            return (While(draw(_expression("bool", scope, _DEPTH)), draw(_block(scope, room - 1))),)
        case "count" if len(scope.fixed) < len(scope.names["double"]):
            return _count(draw, scope, room)
        case "forever" if scope.actions:
            body = draw(_block(scope, room - 1))
            action = _action(draw, scope)
            return (While(Truth(True), Block((*body.statements, action))),)
    return (Print(draw(_expression(draw(_among(_TYPES)), scope, _DEPTH))),)


def _action(draw: st.DrawFn, scope: _Scope) -> Statement:
    action = draw(_among(scope.actions))
    if action == "turn":
        return Turn(draw(_expression("double", scope, draw(_among((0, 0, _DEPTH))))))
    return Act(action)


def _target(draw: st.DrawFn, scope: _Scope) -> tuple[Name, Type]:
    """A variable that may be assigned, and its type."""
    type = draw(_among(("double", *_TYPES)))
    free = tuple(n for n in scope.names[type] if n not in scope.fixed)
    if not free:  # every double counts a loop
        type, free = "bool", scope.names["bool"]
    return scope.name(draw(_among(free))), type


def _declaration(draw: st.DrawFn, scope: _Scope) -> Statement:
    """A declaration, or an assignment if that variable has one already."""
    name, type = _target(draw, scope)
    value = _expression(type, scope, _DEPTH)
    if name.name in scope.declared:
        return Assignment(name, draw(value))
    scope.declared.add(name.name)
    return Declaration(type, name, draw(value) if draw(st.booleans()) else None)


def _if(draw: st.DrawFn, scope: _Scope, room: int) -> If:
    condition = draw(_expression("bool", scope, _DEPTH))
    then = draw(_block(scope, room - 1))
    match draw(_among(("nothing", "else", "else if"))):
        case "else":
            return If(condition, then, draw(_block(scope, room - 1)))
        case "else if" if room > 1:
            return If(condition, then, Block((_if(draw, scope, room - 1),)))
    return If(condition, then)


def _test(draw: st.DrawFn, scope: _Scope, room: int) -> Statement:
    """An if for a variable that may be null."""
    name = draw(_among(scope.names["entity"]))
    equal = draw(_among(("!=", "==")))
    then, orelse = (scope.knowing(name), scope) if equal == "!=" else (scope, scope.knowing(name))
    return If(
        Binary(equal, scope.name(name), Null()),
        draw(_block(then, room - 1)),
        draw(st.none() | _block(orelse, room - 1)),
    )


def _foreach(draw: st.DrawFn, scope: _Scope, room: int) -> Statement:
    """A loop over entities, with a body that takes no action."""
    kind = draw(_among(KINDS))
    name = draw(_among(scope.names["entity"]))
    inside = scope.knowing(name)._replace(actions=())
    return ForEach(kind, scope.name(name), draw(_block(inside, room - 1)))


def _count(draw: st.DrawFn, scope: _Scope, room: int) -> tuple[Statement, ...]:
    """A loop that ends after up to four rounds."""
    free = tuple(n for n in scope.names["double"] if n not in scope.fixed)
    name = scope.name(draw(_among(free)))
    inside = scope._replace(fixed=(*scope.fixed, name.name))
    body = draw(_block(inside, room - 1))
    more = Assignment(name, Binary("+", name, Number(1.0)))
    limit = Number(float(draw(st.integers(0, 4))))
    loop = While(Binary("<", name, limit), Block((*body.statements, more)))
    return Assignment(name, Number(0.0)), loop


# Programs.


@st.composite
def programs(
    draw: st.DrawFn,
    *,
    actions: bool = True,
    fire: bool = True,
    thrust: bool = True,
    depth: int = 3,
) -> Program:
    """Type-correct programs of up to a few dozen statements, with at most `depth` blocks in one another.

    Without `actions` they take none; without `fire` or `thrust` they leave out those (and `thrust_off`).
    """
    some = ("skip", "turn", *("fire",) * fire, *("thrust", "thrust_off") * thrust) * actions
    scope = _Scope(_by_type(VARIABLES), some, set(), set())
    rows = draw(st.lists(_statement(scope, depth), max_size=6))
    missing = [name for name in VARIABLES if name in scope.used - scope.declared]
    first = [Declaration(VARIABLES[name], Name(name)) for name in missing]
    return Program(Block((*first, *(s for row in rows for s in row))))


def program_texts(
    *, actions: bool = True, fire: bool = True, thrust: bool = True, depth: int = 3
) -> st.SearchStrategy[str]:
    """The texts of such programs, in normal form."""
    return programs(actions=actions, fire=fire, thrust=thrust, depth=depth).map(printed)
