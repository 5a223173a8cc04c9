"""A program made ready to run: blocks of instructions, numbered, so that a place in it is a few integers.

Each block of the text is a row of instructions, in the order of the text; block 0 is the whole program and the others
follow in the order their opening braces stand in. An instruction is a statement with its expression's nodes in
evaluation order. A declaration without a value does nothing when met, so it is none; its variable's default is in
`Code.defaults` wherever it stands, since all variables are global.

Machines hold integers instead of pieces of tree because these can be saved, compared and checked.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import Any, assert_never

from attrs import field, frozen
from pyrsistent import PMap, pmap

from fasteroids.actions import Action, Fire, Skip, Thrust, ThrustOff
from fasteroids.lang import syntax
from fasteroids.lang.machine.closures import Closure, typed
from fasteroids.lang.machine.steps import Node, order
from fasteroids.lang.machine.values import DEFAULTS, Value
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Block,
    Declaration,
    Expression,
    ForEach,
    If,
    Print,
    Statement,
    Turn,
    Type,
    While,
)

__all__ = ["Code", "Form", "Instruction", "compiled"]


class Form(IntEnum):
    """What an instruction does once its expression has a value."""

    ASSIGN = 0
    IF = 1
    WHILE = 2
    EACH = 3
    PRINT = 4
    TURN = 5
    ACT = 6


_ACTIONS: dict[str, Action] = {
    "fire": Fire(),
    "thrust": Thrust(),
    "thrust_off": ThrustOff(),
    "skip": Skip(),
}


@frozen(eq=False)
class Instruction:
    """A statement made ready."""

    form: Form
    statement: Statement
    nodes: tuple[Node, ...] = ()
    """Its expression, a node a small step; the statement itself is one more."""
    blocks: tuple[int, ...] = ()
    """Numbers of its blocks: of an `if` both, where there is an `else`; of a loop its body."""
    target: str = ""
    """The variable it assigns to."""
    action: Action | None = None
    """What it orders, if it is an action other than `turn`."""
    sound: bool = False
    """Is it well-typed? Only then may it run by its closure."""
    closure: Closure | None = None
    """Its expression compiled, if it has one and is sound."""
    worst: int = 1
    """Small steps it takes if `&&` and `||` skip nothing; of a for-each, those of one turn of the loop."""

    @property
    def span(self) -> Span:
        """Its place in the text."""
        return self.statement.span


@frozen
class Code:
    """A program made ready. Two are equal if their texts and trees are."""

    source: str
    program: syntax.Program = field(hash=False, repr=False)
    blocks: tuple[tuple[Instruction, ...], ...] = field(eq=False, repr=False)
    defaults: PMap[str, Value] = field(eq=False, repr=False)
    """What each variable holds at the start: 0, false or null."""
    checked: bool = field(default=False, eq=False, repr=False)
    """Was it found type-correct?"""

    def __reduce__(self) -> Any:
        return compiled, (self.program, self.checked)

    def __deepcopy__(self, _: object) -> Code:
        return self


def compiled(program: syntax.Program, checked: bool = False) -> Code:
    """The program made ready. It may be ill-typed (then it gets stuck in time), but not have a `Missing`.

    `checked` is for `check_program` to say: no ship takes one that is not.
    """
    types: dict[str, Type] = {}
    _declare(program.body, types)
    blocks: list[tuple[Instruction, ...]] = []
    _number(program.body, types, blocks)
    defaults = pmap({name: DEFAULTS[type_] for name, type_ in types.items()})
    return Code(program.source, program, tuple(blocks), defaults, checked)


def _declare(block: Block, types: dict[str, Type]) -> None:
    for s in block.statements:
        match s:
            case Declaration(type_, target):
                types[target.name] = type_
            case If(_, then, orelse):
                _declare(then, types)
                if orelse is not None:
                    _declare(orelse, types)
            case While(_, body) | ForEach(_, _, body):
                _declare(body, types)


def _number(block: Block, types: Mapping[str, Type], blocks: list[tuple[Instruction, ...]]) -> int:
    """Put a block's instructions at the next free number, those of the blocks in it behind, and tell the number."""
    number = len(blocks)
    blocks.append(())

    def ready(
        s: Statement, form: Form, e: Expression, wanted: str | None, *inner: Block, target: str = ""
    ) -> Instruction:
        nodes, whole = order(e), typed(e, types)
        numbers = tuple(_number(b, types, blocks) for b in inner)
        sound = whole is not None and wanted in (None, whole.type)
        assert whole is None or whole.steps == len(nodes)
        return Instruction(
            form,
            s,
            nodes,
            numbers,
            target,
            sound=sound,
            closure=whole.closure if sound and whole is not None else None,
            worst=len(nodes) + 1,
        )

    def instruction(s: Statement) -> Instruction | None:
        match s:
            case Declaration(_, target, value) | Assignment(target, value):
                if value is None:
                    return None
                wanted = types.get(target.name, "no type has this name")
                return ready(s, Form.ASSIGN, value, wanted, target=target.name)
            case If(condition, then, orelse):
                inner = (then,) if orelse is None else (then, orelse)
                return ready(s, Form.IF, condition, "bool", *inner)
            case While(condition, body):
                return ready(s, Form.WHILE, condition, "bool", body)
            case ForEach(_, variable, body):
                numbers = (_number(body, types, blocks),)
                sound = types.get(variable.name) == "entity"
                return Instruction(Form.EACH, s, (), numbers, variable.name, sound=sound)
            case Print(value):
                return ready(s, Form.PRINT, value, None)
            case Turn(angle):
                return ready(s, Form.TURN, angle, "double")
            case Act(action):
                return Instruction(Form.ACT, s, action=_ACTIONS[action], sound=True)
            case _:
                assert_never(s)

    made = [instruction(s) for s in block.statements]
    blocks[number] = tuple(i for i in made if i is not None)
    return number
