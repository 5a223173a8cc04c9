"""The ship language: text to tree, tree to faults, program to machine (assignment 1.8).

    parse_program(text)      a tree, and every syntax error
    check_program(program)   a machine that a ship can carry, or every type error
    diagnose(text)           all errors of a text
    rendered(...)            errors as people read them
    step, run, tick          the machine: a small step, many, a tick's worth

It knows no world. A machine sees a `fasteroids.actions.View`, which a dictionary can be.
"""

from fasteroids.lang.diagnostics import Diagnostic as Diagnostic
from fasteroids.lang.front import diagnose as diagnose
from fasteroids.lang.machine import Halted as Halted
from fasteroids.lang.machine import Machine as Machine
from fasteroids.lang.machine import Running as Running
from fasteroids.lang.machine import run as run
from fasteroids.lang.machine import started as started
from fasteroids.lang.machine import step as step
from fasteroids.lang.machine import tick as tick
from fasteroids.lang.parser import Parsed as Parsed
from fasteroids.lang.parser import parse_program as parse_program
from fasteroids.lang.ready import Checked as Checked
from fasteroids.lang.ready import check_program as check_program
from fasteroids.lang.report import rendered as rendered
from fasteroids.lang.source import Span as Span

__all__ = [
    "Checked",
    "Diagnostic",
    "Halted",
    "Machine",
    "Parsed",
    "Running",
    "Span",
    "check_program",
    "diagnose",
    "parse_program",
    "rendered",
    "run",
    "started",
    "step",
    "tick",
]
