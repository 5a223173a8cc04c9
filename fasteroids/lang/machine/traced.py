"""A program that remembers the small steps of its last tick: what `fasteroids trace` and a debugger show.

A world does not know that it runs one: the future is that of the machine inside.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from typing import Final

from attrs import evolve, field, frozen

from fasteroids.actions import Action, Program, Ticked, View
from fasteroids.lang.machine._machine import Frame, Halted, Machine, Running, place, refreshed, step
from fasteroids.lang.machine.steps import Test
from fasteroids.lang.machine.values import Value, exact
from fasteroids.lang.source import Span

__all__ = ["MOST_STEPS", "Step", "Traced", "machine_in"]


MOST_STEPS: Final = 100_000
"""So many steps of a tick are kept. A world may grant a tick far more fuel."""


@frozen
class Step:
    """One small step: the machine before and after it, and what came out."""

    before: Running
    after: Machine
    action: Action | None = None
    printed: str | None = None

    @property
    def span(self) -> Span:
        """The piece of text that was done: a node of an expression, or a statement."""
        return place(self.before)

    @property
    def value(self) -> tuple[Value] | None:
        """What a node of an expression came to, in a tuple, as it may be null.

        None if a statement was done, or the left side of `&&` or `||` did not decide.
        """
        frame, after = self.before.todo.first, self.after
        if not isinstance(frame, Frame) or not isinstance(after, Running):
            return None
        instruction = self.before.code.blocks[frame.block][frame.index]
        if frame.done == len(instruction.nodes):
            return None
        now = after.todo.first
        assert isinstance(now, Frame)
        if isinstance(instruction.nodes[frame.done], Test) and now.done == frame.done + 1:
            return None  # true && ...: the right side decides
        return (now.operands[-1],)

    @property
    def changed(self) -> Mapping[str, Value]:
        """The variables that hold another value than before; of an entity, those that hold another one."""
        old, new = self.before.store, self.after.store
        if old is new:
            return {}
        return {name: new[name] for name in sorted(new) if exact(new[name]) != exact(old[name])}


@frozen
class Traced:
    """A machine and the (first `MOST_STEPS`) steps of its last tick: an `actions.Program`."""

    machine: Machine
    steps: tuple[Step, ...] = field(default=(), repr=False)

    @property
    def checked(self) -> bool:
        """Was its program found type-correct?"""
        return self.machine.checked

    @property
    def running(self) -> bool:
        """Does it still have something to do?"""
        return self.machine.running

    def tick(self, view: View) -> Ticked:
        """As the machine's own tick, step by step."""
        steps = tuple(islice(_steps(refreshed(self.machine, view), view), MOST_STEPS))
        ticked = self.machine.tick(view)
        assert isinstance(ticked.program, Machine)
        if 0 < len(steps) < MOST_STEPS:
            assert steps[-1].after == ticked.program, "the trace is not what happens"
        return ticked._replace(program=evolve(self, machine=ticked.program, steps=steps))


def _steps(machine: Machine, view: View) -> Iterator[Step]:
    for _ in range(view.fuel):
        if not isinstance(machine, Running):
            return
        before = machine
        machine, action, printed = step(before, view)
        yield Step(before, machine, action, printed)
        if action is not None:
            return


def machine_in(program: Program | None) -> Machine | None:
    """The machine that a program is, or that it traces; None if there is none in it."""
    if isinstance(program, Traced):
        return program.machine
    return program if isinstance(program, Running | Halted) else None
