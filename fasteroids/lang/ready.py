"""A program made ready to run: from its tree to a machine that a ship can carry."""

from __future__ import annotations

from attrs import frozen

from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnose
from fasteroids.lang.machine import Machine, started
from fasteroids.lang.machine.code import compiled
from fasteroids.lang.parser import Parsed, parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import Program
from fasteroids.units import ModelError, shown

__all__ = ["Checked", "check_program"]


@frozen
class Checked:
    """What checking a program gave."""

    program: Machine | None
    """The machine before its first step, for `Ship(program=...)`; None if there is an error."""
    diagnostics: tuple[Diagnostic, ...]
    """Every error, by place."""


def check_program(program: Program | Parsed | None) -> Checked:
    """Is a program type-correct (assignment 1.8.3)? If so it is made ready to run.

    `program` is a tree, of `parse_program(text).program` or built by hand, or all that `parse_program` gave; then its
    syntax errors are among the diagnostics. None, the tree of a text with errors, gives no program and no diagnostics.
    What runs is its text, so a tree that was changed, or never had a text, gets its normal form. `ModelError` if it is
    no tree, or one that no text gives.
    """
    if program is None:
        return Checked(None, ())
    if isinstance(program, Parsed):
        if program.program is None:
            return Checked(None, diagnose(program.tree.source))
        program = program.program
    if not isinstance(program, Program):
        raise ModelError(
            f"a program to check is a tree, as parse_program gives; got {shown(program)}"
        )
    if not program.source or parse_program(program.source).tree != program:
        program = _with_text(program)
    diagnostics = diagnose(program.source)
    if any(each.severity == "error" for each in diagnostics):
        return Checked(None, diagnostics)
    return Checked(started(compiled(parse_program(program.source).tree, checked=True)), diagnostics)


def _with_text(program: Program) -> Program:
    try:
        again = parse_program(printed(program)).program
    except AssertionError as error:  # a gap
        raise ModelError(f"this tree is no program: {error}") from None
    if again != program:
        raise ModelError("this tree is no program: its text reads as another one")
    return again
