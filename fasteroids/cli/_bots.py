"""Programs by name, for the ships of a scene: `--bots turret,mine.ast`."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import Final

from fasteroids.cli._files import read_named, shipped_programs
from fasteroids.cli._guard import Refusal
from fasteroids.lang import Machine, check_program, parse_program
from fasteroids.lang.front import diagnose_bytes
from fasteroids.lang.report import legible, rendered
from fasteroids.state import World
from fasteroids.units import ModelError

__all__ = ["boarded", "read_bot"]

_MOST_SHOWN: Final = 20
"""Errors of one program that are shown; `fasteroids check` shows as many."""


def boarded(title: str, world: World, bots: Sequence[str]) -> World:
    """The world of this title whose ships, in the order of their ids, run these programs.

    `Refusal` if there is not one for each ship, or if one cannot be read or has errors.
    """
    from fasteroids.arena import flown  # not needed without bots

    programs = [read_bot(name) for name in bots]
    try:
        return flown(world, programs)
    except ModelError as error:
        raise Refusal(f"{title}: {error}") from None


def read_bot(name: str) -> Machine:
    """The program of a file, or one that comes with the package, ready to run. A file wins.

    `Refusal` if there is none, and if it has errors, which it shows as `fasteroids check` does.
    """
    if name not in shipped_programs() and not Path(name).exists():
        raise Refusal(_missing(name))
    text, found = diagnose_bytes(read_named(name))
    errors = [each for each in found if each.severity == "error"]
    if errors:
        count = "an error" if len(errors) == 1 else f"{len(errors)} errors"
        few = f", of which these are the first {_MOST_SHOWN}" if len(errors) > _MOST_SHOWN else ""
        report = rendered(errors[:_MOST_SHOWN], text, name)
        raise Refusal(f"{legible(name)} has {count}{few}\n{report}")
    machine = check_program(parse_program(text)).program
    assert machine is not None
    return machine


def _missing(name: str) -> str:
    shipped = list(shipped_programs())
    here = sorted(path.name for path in Path().glob("*.ast"))
    near = get_close_matches(name, [*here, *shipped], n=1)
    hint = f" (did you mean {near[0]!r}?)" if near else ""
    return f"there is no bot {name!r}{hint}; give a file, or one of these: {', '.join(shipped)}"
