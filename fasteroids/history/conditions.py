"""Conditions in the ship language: `getx self < 100`, as a predicate of a world.

A condition is an expression seen from a ship: `self` is that ship, the variables are those of its program as the last
tick left them. An entity in a variable is seen as it is in the world asked, as at a tick, so a condition on it changes
between ticks too; a dead one keeps its last state.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from attrs import evolve, field, frozen

from fasteroids.entities import Ship
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnosed
from fasteroids.lang.machine.closures import Closure, Reading, typed
from fasteroids.lang.machine.steps import order
from fasteroids.lang.machine.traced import machine_in
from fasteroids.lang.machine.values import Seen, Stuck, type_of
from fasteroids.lang.parser import parse_program
from fasteroids.lang.report import rendered
from fasteroids.lang.source import NOWHERE, Span
from fasteroids.lang.syntax import Block, Declaration, If, Name, Type
from fasteroids.rules import ShipView
from fasteroids.state import World
from fasteroids.units import ModelError, shown

__all__ = ["Condition", "condition"]

_HEAD: Final = "if (\n"
_TAIL: Final = "\n) {}\n"
"""What makes a statement of a condition. Its text has lines of its own, so that columns stay."""


@frozen
class Condition:
    """A condition seen from a ship, made by `condition`: a predicate of worlds.

    It is total. It does not hold where the ship is dead, where an operation is illegal (`getx null`), and where the
    ship's program has no such variable, or none of that type, because it got another program.
    """

    text: str
    ship: int
    types: Mapping[str, Type] = field(eq=False, repr=False)
    """The variables in it."""
    _closure: Closure = field(eq=False, repr=False)

    def __call__(self, world: World) -> bool:
        """Does it hold in this world?"""
        ship = world.entities.get(self.ship)
        if not isinstance(ship, Ship):
            return False
        view = Reading(ShipView(world, ship))
        variables = self._variables(ship, view)
        if variables is None:
            return False
        try:
            held: bool = self._closure(variables, view)
        except Stuck:
            return False
        return held

    def _variables(self, ship: Ship, view: Reading) -> dict[str, Any] | None:
        """The variables in it, with entities seen anew; None if the ship's program has not got them all."""
        if not self.types:
            return {}
        machine = machine_in(ship.program)
        if machine is None:
            return None
        defaults, found = machine.code.defaults, {}
        for name, wanted in self.types.items():
            if name not in defaults or type_of(defaults[name]) != wanted:
                return None
            value = machine.store[name]
            found[name] = (view.entity(value.id) or value) if isinstance(value, Seen) else value
        return found


def condition(text: str, ship: Ship) -> Condition:
    """The condition that a text states, seen from a ship as a world knows it; compiled once.

    It may name the variables of the program that this ship runs. `ModelError`, with the first fault as the language
    reports faults, if the text is no expression that is true or false; also if the ship has no id.
    """
    if not isinstance(text, str):
        raise ModelError(f"a condition is a text in the ship language; got {shown(text)}")
    if not isinstance(ship, Ship) or ship.id is None:
        raise ModelError(
            f"a condition is seen from a ship as its world knows it; got {shown(ship)}"
        )
    machine = machine_in(ship.program)
    known = {} if machine is None else {n: type_of(v) for n, v in machine.code.defaults.items()}
    declarations = "".join(f"{type_} {name};\n" for name, type_ in sorted(known.items()))
    parsed = parse_program(f"{_HEAD}{text}{_TAIL}{declarations}")
    first, *others = parsed.tree.body.statements or (None,)
    alone = all(isinstance(s, Declaration) and s.value is None for s in others)
    faults = diagnosed(parsed)
    if faults:
        raise ModelError(_told(faults, text, known))
    if not (
        isinstance(first, If) and first.then == Block() and len(others) == len(known) and alone
    ):
        raise ModelError(f"a condition is one expression; got {shown(text)}")
    names = {e.name for e in order(first.condition) if isinstance(e, Name)}
    types = {name: known[name] for name in sorted(names)}
    ready = typed(first.condition, types)
    assert ready is not None, "what the checker passes can be compiled"
    return Condition(text, ship.id, types, ready.closure)


def _told(faults: Sequence[Diagnostic], text: str, known: Mapping[str, Type]) -> str:
    """The first fault that lies in the text, as if the text had stood alone."""
    rows = text.count("\n") + 1
    inside = [each for each in faults if 1 < each.span.line <= rows + 1] or faults[:1]
    fault = inside[0]
    hint = fault.hint
    if fault.code == "FA101":
        hint = f"The ship's program has {', '.join(sorted(known)) or 'no variables'}"
    elif fault is not faults[0] or not _within(fault.span, rows):
        hint = None
    notes = tuple(
        evolve(note, span=_moved(note.span)) for note in fault.notes if _within(note.span, rows)
    )
    fault = evolve(fault, span=_moved(fault.span), notes=notes, hint=hint, fix=())
    return rendered([fault], text, "condition")


def _within(span: Span, rows: int) -> bool:
    return 1 < span.line and span.end_line <= rows + 1


def _moved(span: Span) -> Span:
    """A place in the text, from its place behind the head; of one in the head the start of the text."""
    if span.line == 1:
        return NOWHERE
    return span._replace(line=span.line - 1, end_line=span.end_line - 1)
