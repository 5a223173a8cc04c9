"""Texts made ready to run, and a view to run them on."""

from __future__ import annotations

from fasteroids.lang.code import Code, compiled
from fasteroids.lang.machine import Halted, Machine, Running, started, step
from fasteroids.lang.parser import parse_program
from fasteroids.lang.values import Seen
from fasteroids.testing import DictView

SHIP = Seen(1, "ship", 10.0, 20.0, 1.0, -1.0, 5.0)
ROCK = Seen(2, "asteroid", 40.0, 60.0, 0.0, 2.0, 8.0)
BULLET = Seen(3, "bullet", 70.0, 20.0, 250.0, 0.0, 3.0)
RIVAL = Seen(4, "ship", 90.0, 90.0, 0.0, 0.0, 6.0)


def view(*entities: Seen, direction: float = 0.5) -> DictView:
    """What ship 1 sees; without entities given it sees one of each kind and a rival."""
    some = entities or (SHIP, ROCK, BULLET, RIVAL)
    return DictView({e.id: e for e in some}, 1, direction)


def ready(text: str) -> Code:
    """A text without syntax errors, well-typed or not."""
    parsed = parse_program(text)
    assert parsed.diagnostics == ()
    return compiled(parsed.tree)


def loaded(text: str) -> Machine:
    """Its machine before the first step."""
    return started(ready(text))


def stepped(machine: Machine, steps: int, seen: DictView | None = None) -> Running:
    """The machine some steps later, still running."""
    for _ in range(steps):
        assert isinstance(machine, Running)
        machine = step(machine, seen or view()).machine
    assert isinstance(machine, Running)
    return machine


def to_the_end(text: str, seen: DictView | None = None) -> tuple[Halted, int]:
    """The machine at its end, and the steps it took."""
    machine, steps = loaded(text), 0
    while isinstance(machine, Running):
        machine = step(machine, seen or view()).machine
        steps += 1
        assert steps < 10_000
    return machine, steps
