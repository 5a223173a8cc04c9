"""Many steps at once: whole instructions by their closures, on variables in a dictionary that changes.

This is an optimisation and nothing else. It does an instruction only if the fuel covers the worst the instruction may
cost, if it is well-typed, and if no operation in it gets stuck; any other it leaves untouched for the small steps of
`fasteroids.lang.machine`. So it never stops inside an instruction, and what it did is what the steps would have done
(law L12, tests/properties/test_machine.py).
"""

from __future__ import annotations

from math import inf
from typing import Any, TypeAlias

from fasteroids.actions import Action, Turn
from fasteroids.lang.closures import Reading
from fasteroids.lang.code import Code, Form
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import ForEach
from fasteroids.lang.values import Seen, Stuck, shown

ASSIGN, IF, WHILE, EACH, PRINT, TURN, ACT = Form  # an attribute of a class costs more than a global

__all__ = ["Entry", "leap", "visited"]

Entry: TypeAlias = tuple[int, int, list[Seen] | None]
"""A frame between two instructions: block, index, and in a for-each the entities still to visit, the next one last."""


def visited(loop: ForEach, world: Reading) -> list[Seen]:
    """The entities a for-each is to visit, the first one last."""
    looks = (world.entity(i) for i in reversed(world.ids(loop.kind)))
    return [seen for seen in looks if seen is not None]


def leap(
    code: Code,
    stack: list[Entry],
    env: dict[str, Any],
    world: Reading,
    left: int,
    prints: list[str],
) -> tuple[int, Action | None, Span | None]:
    """Do whole instructions until an action, the end (the stack is empty), or one that needs the small steps.

    Changes `stack` (outermost entry first, not empty; without those that stand at the end of their block), `env` and
    `prints`. Returns the fuel left, and the action with its place in the text.
    """
    blocks = code.blocks
    world.skipped = 0
    number, index, rest = stack.pop()
    block = blocks[number]
    action: Action | None = None
    span: Span | None = None
    while action is None:
        while index == len(block):
            if not stack:
                return left, None, None
            number, index, rest = stack.pop()
            block = blocks[number]
        instruction = block[index]
        if instruction.worst > left or not instruction.sound:
            break
        form = instruction.form
        value: Any = None
        if instruction.closure is not None:
            try:
                value = instruction.closure(env, world)
            except Stuck:
                break
        if form is ASSIGN:
            env[instruction.target] = value
            index += 1
        elif form is IF:
            index += 1
            if value or len(instruction.blocks) == 2:
                stack.append((number, index, None))
                number, index = instruction.blocks[0 if value else 1], 0
                block = blocks[number]
        elif form is EACH:
            if rest is None:
                rest = visited(instruction.statement, world)  # type: ignore[arg-type]
            if rest:
                env[instruction.target] = rest.pop()
                stack.append((number, index, rest))
                number, index = instruction.blocks[0], 0
                block = blocks[number]
            else:
                index += 1
            rest = None
        elif form is WHILE:
            if value:
                stack.append((number, index, None))
                number, index = instruction.blocks[0], 0
                block = blocks[number]
            else:
                index += 1
        elif form is PRINT:
            prints.append(shown(value))
            index += 1
        else:
            if form is TURN and not -inf < value < inf:
                break
            action, span = instruction.action or Turn(value), instruction.span
            index += 1
        left -= instruction.worst - world.skipped
        world.skipped = 0
    stack.append((number, index, rest))
    stack[:] = [entry for entry in stack if entry[1] < len(blocks[entry[0]])]
    return left, action, span
