"""The programs of ships in a scene file: by name or as text, and where each of them is.

A file names a program (`program = "hunter.ast"`) or holds it (`program-text`). What `dump_scene` writes of a program
that has begun to run is its machine, without the text, as JSON (`program-state`).
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, TypeAlias

from fasteroids.actions import Program
from fasteroids.lang import Machine, check_program, parse_program, rendered, started
from fasteroids.lang.diagnostics import Diagnostic
from fasteroids.lang.front import diagnose, diagnose_bytes
from fasteroids.lang.machine.saved import restored, saved
from fasteroids.scene._table import TEXT, Faults, Fields, Table
from fasteroids.units import ModelError

__all__ = ["FIELDS", "Read", "program_of", "row_of"]

Read: TypeAlias = Callable[[str], bytes | str]
"""What a scene's reader is asked for the program of a name, the bytes of a file or a text.

`ModelError` with a sentence if there is none.
"""

FIELDS: Fields = {"program": TEXT, "program-text": TEXT, "program-state": TEXT}
"""The fields of a ship that tell its program."""


_MOST_SHOWN = 10
"""Errors of one program that a scene's report shows."""


def program_of(
    table: Table, values: dict[str, Any], read: Read | None, faults: Faults
) -> Program | None:
    """The program of a ship, taken out of its `values`: None if it has none, or if anything is wrong with it."""
    name, text, state = (values.pop(field, None) for field in FIELDS)
    field = "program" if text is None else "program-text"
    if name is not None and text is not None:
        faults.add(table, "and program-text exclude each other", "program")
        return None
    found: tuple[str, tuple[Diagnostic, ...]] | None = None
    if text is not None:
        found = text, diagnose(text)
    elif name is not None and (data := _read(table, name, read, faults)) is not None:
        found = (data, diagnose(data)) if isinstance(data, str) else diagnose_bytes(data)
    if found is None:
        if state is not None and name is None:
            faults.add(
                table, "needs the program it is the state of, in program-text", "program-state"
            )
        return None
    machine = _machine(table, field, *found, name or "program-text", faults)
    return machine if state is None or machine is None else _resumed(table, machine, state, faults)


def _read(table: Table, name: str, read: Read | None, faults: Faults) -> bytes | str | None:
    try:
        if read is None:
            raise ModelError("cannot be read from here; write the program in program-text")
        return read(name)
    except ModelError as error:
        faults.add(table, str(error), "program")
        return None


def _machine(
    table: Table, field: str, text: str, found: tuple[Diagnostic, ...], name: str, faults: Faults
) -> Machine | None:
    errors = [each for each in found if each.severity == "error"]
    if errors:
        count = "an error" if len(errors) == 1 else f"{len(errors)} errors"
        few = f", of which these are the first {_MOST_SHOWN}" if len(errors) > _MOST_SHOWN else ""
        report = rendered(errors[:_MOST_SHOWN], text, name)
        faults.add(table, f"has {count}{few}\n{report}", field)
        return None
    tree = parse_program(text).program
    assert tree is not None
    return check_program(tree).program


def _resumed(table: Table, machine: Machine, state: str, faults: Faults) -> Machine | None:
    """The machine of the same program as it was saved."""
    try:
        record = json.loads(state)
        if not isinstance(record, dict):
            raise ModelError("must be a machine as dump_scene writes it")
        return restored({**record, "source": machine.code.source}, lambda _: machine.code)
    except (ValueError, RecursionError) as error:
        told = str(error) if isinstance(error, ModelError) else "must be JSON"
        faults.add(table, told, "program-state")
        return None


def row_of(program: Program) -> dict[str, str]:
    """The fields that give back a program as it is; `ModelError` if it is none of the language."""
    if not isinstance(program, Machine):
        raise ModelError("has a program that is no text, and cannot be written to a scene file")
    row = {"program-text": program.code.source}
    if not program.code.source.isascii() and any(
        "\ud800" <= c <= "\udfff" for c in program.code.source
    ):
        raise ModelError("has a program with lone surrogates, which no file of text can hold")
    if program != started(program.code):
        state = {key: value for key, value in saved(program).items() if key != "source"}
        row["program-state"] = json.dumps(state, separators=(",", ":"))
    return row
