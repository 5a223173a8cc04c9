"""Entities that may be null where they are read: a flow analysis.

A state says which variables hold an entity for certain, and which do if a bool is true, or false: a program that sets
`found := true` beside `nearest := a` may ask `found` before it reads `nearest`. It is one integer, in rows of one bit
a variable: row 0 is "holds an entity", rows 1 and 2 are "does if the first bool is false, true", and so on. Two paths
that meet keep what both know (`&`); None is the state of a place that no path leads to.

The state at the head of a loop is what all paths to it know. It is guessed from the first path and mended pass by
pass over the whole program, until nothing changes: passes are few, and a pass takes linear time however deep the loops.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from fasteroids.lang import syntax
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.names import shortened
from fasteroids.lang.syntax import Block, Expression, Statement, Type
from fasteroids.lang.words import GETTERS

__all__ = ["warnings"]

_MOST_ENTITIES: Final = 256
_MOST_FLAGS: Final = 32
_MOST_PASSES: Final = 64
"""Bounds, so that no text takes long to check. What is beyond them gets no warning."""

State = int | None


def warnings(
    tree: syntax.Program, types: Mapping[str, Type], never_set: Iterable[str]
) -> Iterator[Diagnostic]:
    """FA208. Not for variables that are never set, which are told so (FA205)."""
    unset = set(never_set)
    entities = [name for name, kind in types.items() if kind == "entity" and name not in unset]
    flags = [name for name, kind in types.items() if kind == "bool"]
    flow = _Flow(entities[:_MOST_ENTITIES], flags[:_MOST_FLAGS])
    for _ in range(_MOST_PASSES):
        if flow.passed(tree.body):
            yield from flow.found
            return


class _Flow:
    """Passes over a program; what is known at the heads of its loops stays from one to the next."""

    def __init__(self, entities: list[str], flags: list[str]) -> None:
        wide = len(entities)
        self._wide = wide
        self._all = (1 << wide) - 1
        rows = 1 + 2 * len(flags)
        everywhere = sum(1 << (row * wide) for row in range(rows))
        self._columns = {name: everywhere << i for i, name in enumerate(entities)}
        self._by_bit = [*self._columns.values()]
        self._flags = {name: 1 + 2 * i for i, name in enumerate(flags)}
        # All variables are null and all bools false at first, so "if it is true" holds of anything.
        self._first = sum(self._all << ((row + 1) * wide) for row in self._flags.values())
        self._heads: dict[int, int] = {}
        self._changed = False
        self.found: list[Diagnostic] = []

    def passed(self, body: Block) -> bool:
        """Go over the whole program once. Was it as the pass before had left it?"""
        self._changed = False
        self.found = []
        self._block(body, self._first)
        return not self._changed

    # Statements: the state behind them.

    def _block(self, block: Block, state: State) -> State:
        for statement in block.statements:
            if state is None:
                break
            state = self._statement(statement, state)
        return state

    def _statement(self, statement: Statement, state: int) -> State:
        match statement:
            case syntax.Assignment(target, value):
                return self._assigned(target.name, value, state)
            case syntax.Declaration(_, target, value):
                return state if value is None else self._assigned(target.name, value, state)
            case syntax.Print(e) | syntax.Turn(e):
                return _joined(*self._asked(e, state))
            case syntax.If(condition, then, orelse):
                yes, no = self._asked(condition, state)
                return _joined(self._block(then, yes), self._block(orelse, no) if orelse else no)
            case syntax.While(condition, body):
                yes, no = self._asked(condition, self._head(statement, state))
                self._back(statement, self._block(body, yes))
                return no
            case syntax.ForEach(_, variable, body):
                head = self._head(statement, state)
                self._back(statement, self._block(body, head | self._columns.get(variable.name, 0)))
                return self._heads[id(statement)]
        return state

    def _head(self, loop: Statement, state: int) -> int:
        """The state at the head of a loop that is come to with this one."""
        old = self._heads.get(id(loop))
        self._heads[id(loop)] = new = state if old is None else old & state
        self._changed |= new != old
        return new

    def _back(self, loop: Statement, state: State) -> None:
        """The body of the loop ends, with this state."""
        if state is not None:
            self._head(loop, state)

    def _assigned(self, name: str, value: Expression, state: int) -> State:
        yes, no = self._asked(value, state)
        after = _joined(yes, no)
        if after is None:
            return None
        column = self._columns.get(name)
        if column is not None:
            return after | column if self._certain(value, after) else after & ~column
        row = self._flags.get(name)
        if row is not None:
            for side, known in ((row, no), (row + 1, yes)):
                kept = self._all if known is None else known & self._all
                after = after & ~(self._all << side * self._wide) | kept << side * self._wide
        return after

    def _certain(self, e: Expression, state: int) -> bool:
        """Is it an entity for certain?"""
        if isinstance(e, syntax.Name):
            column = self._columns.get(e.name)
            return column is None or bool(state & self._all & column)
        return isinstance(e, syntax.Self)

    # Expressions: the state behind them if they are true, and if they are not (the same if they are no bools).

    def _asked(self, e: Expression, state: int) -> tuple[State, State]:
        match e:
            case syntax.Truth(value):
                return (state, None) if value else (None, state)
            case syntax.Name(name):
                return self._if(name, state, value=True), self._if(name, state, value=False)
            case syntax.Unary("!", operand):
                yes, no = self._asked(operand, state)
                return no, yes
            case syntax.Unary(operator, operand) if operator in GETTERS:
                known = self._looked(e, state)
                return known, known
            case syntax.Unary(_, operand):
                return self._asked(operand, state)
            case syntax.Binary("&&" | "||" as operator, left, right):
                yes, no = self._asked(left, state)
                on, out = (yes, no) if operator == "&&" else (no, yes)
                then = self._asked(right, on) if on is not None else (None, None)
                return (
                    (then[0], _joined(out, then[1]))
                    if operator == "&&"
                    else (_joined(out, then[0]), then[1])
                )
            case syntax.Binary("==" | "!=" as operator, asked, syntax.Truth(value)) | syntax.Binary(
                "==" | "!=" as operator, syntax.Truth(value), asked
            ):
                yes, no = self._asked(asked, state)
                return (yes, no) if (operator == "==") is value else (no, yes)
            case syntax.Binary(operator, left, right):
                after = _joined(*self._asked(left, state))
                after = _joined(*self._asked(right, after)) if after is not None else None
                if after is None:
                    return None, None
                return self._compared(e, after) if operator in ("==", "!=") else (after, after)
        return state, state

    def _if(self, name: str, state: int, *, value: bool) -> State:
        """What is known if a bool is this."""
        row = self._flags.get(name)
        if row is None:
            return state
        new = (state >> (row + value) * self._wide) & self._all & ~state
        while new:
            bit = new & -new
            state |= self._by_bit[bit.bit_length() - 1]
            new ^= bit
        return state

    def _compared(self, e: syntax.Binary, state: int) -> tuple[State, State]:
        """`==` and `!=`: with null it tells that there is an entity, with an entity too."""
        same = other = state
        for one, another in ((e.left, e.right), (e.right, e.left)):
            if isinstance(one, syntax.Name) and one.name in self._columns:
                if isinstance(another, syntax.Null):
                    other |= self._columns[one.name]
                elif self._certain(another, state):
                    same |= self._columns[one.name]
        return (same, other) if e.operator == "==" else (other, same)

    def _looked(self, e: syntax.Unary, state: int) -> int:
        """A getter: what it reads is an entity from then on, else the program is over."""
        operand = e.operand
        if isinstance(operand, syntax.Null):
            self.found.append(_null(e))
        elif isinstance(operand, syntax.Name) and operand.name in self._columns:
            column = self._columns[operand.name]
            if not state & self._all & column:
                self.found.append(_may_be_null(e, operand))
            return state | column
        return state


def _joined(one: State, other: State) -> State:
    if one is None:
        return other
    return one if other is None else one & other


# What is said.


def _null(e: syntax.Unary) -> Diagnostic:
    return Diagnostic(
        "FA208",
        f"`{e.operator} null` is an illegal operation, and stops the program",
        e.span,
        hint="Read an entity, such as `self`",
        label="no entity",
        severity="warning",
    )


def _may_be_null(e: syntax.Unary, name: syntax.Name) -> Diagnostic:
    short = shortened(name.name)
    return Diagnostic(
        "FA208",
        f"`{short}` may be null here, and `{e.operator} null` stops the program",
        e.span,
        hint=f"Ask first, as in `if ({short} != null) {{ ... }}`",
        label="may be null",
        severity="warning",
    )
