"""A program that remembers the small steps of its last tick: what `fasteroids trace` and a debugger show.

A world does not know that it runs one: the future is that of the machine inside.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from attrs import evolve, field, frozen

from fasteroids.actions import Action, Ticked, View
from fasteroids.lang.machine._machine import Frame, Machine, Running, place, refreshed, step
from fasteroids.lang.machine.values import Value, exact
from fasteroids.lang.source import Span

__all__ = ["Step", "Traced"]


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
        """What a node of an expression came to, in a tuple, as it may be null; None if a statement was done."""
        frame = self.before.todo.first
        if not isinstance(frame, Frame) or not isinstance(self.after, Running):
            return None
        now = self.after.todo.first
        if (
            not isinstance(now, Frame)
            or now.done <= frame.done
            or len(self.after.todo) != len(self.before.todo)
        ):
            return None
        return (now.operands[-1],) if now.operands else None

    @property
    def changed(self) -> Mapping[str, Value]:
        """The variables that hold another value than before; of an entity, those that hold another one."""
        old, new = self.before.store, self.after.store
        if old is new:
            return {}
        return {name: new[name] for name in sorted(new) if exact(new[name]) != exact(old[name])}


@frozen
class Traced:
    """A machine, and the steps of its last tick. A program in the sense of `fasteroids.actions.Program`."""

    machine: Machine
    steps: tuple[Step, ...] = field(default=(), repr=False)

    @property
    def running(self) -> bool:
        """Does it still have something to do?"""
        return self.machine.running

    def tick(self, view: View) -> Ticked:
        """As the machine's own tick, step by step."""
        steps = tuple(_steps(refreshed(self.machine, view), view))
        ticked = self.machine.tick(view)
        assert isinstance(ticked.program, Machine)
        assert not steps or steps[-1].after == ticked.program, "the trace is not what happens"
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
