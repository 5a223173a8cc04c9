"""What is odd about a program that has no error: warnings, each with its place and, where it is safe, a fix.

    flow      what is never reached, and loops that burn their fuel
    names     variables that are never read, never set, or not used at all
    equality  doubles compared with `==` and `!=`
    nulls     entities that may be null where they are read
    course    what the parser of 2013 read otherwise, or refused; only on demand

A fix keeps the meaning of the program: its actions, what it prints, and what stops it, though not the count of its
small steps.
"""

from __future__ import annotations

from fasteroids.lang.checker import declared
from fasteroids.lang.checker.uses import constructs
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.lint import _course, _equality, _flow, _names, _nulls
from fasteroids.lang.syntax import Program

__all__ = ["warnings"]


def warnings(tree: Program, *, course: bool = False) -> tuple[Diagnostic, ...]:
    """All warnings about a program without syntax and type errors, by place. Never raises for such a one.

    With `course` also what the parser of the course of 2013 would have read otherwise, or refused: about most programs
    that were not written for it. A tree that was built, and has no text, gets no fixes and no places.
    """
    program = constructs(tree)
    types = declared(tree)
    found = [
        *_flow.warnings(tree),
        *_names.warnings(tree, program),
        *_equality.warnings(program, types),
        *_nulls.warnings(tree, types, _names.never_set(program)),
    ]
    if course:
        found += _course.warnings(tree, program)
    return tuple(sorted(found, key=lambda each: each.span))
