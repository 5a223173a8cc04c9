"""`fasteroids new`: a commented program or scene to start from, which runs at once."""

from __future__ import annotations

import re
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Final, Literal

import click

from fasteroids.cli._files import write_whole
from fasteroids.cli._guard import DONE, Refusal

__all__ = ["MOST_CHARACTERS", "command"]

MOST_CHARACTERS: Final = 60
"""Of a name."""

_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_DEVICE: Final = re.compile(r"con|prn|aux|nul|com[0-9]|lpt[0-9]", re.IGNORECASE)
"""What Windows takes for a device, with any ending."""

_ENDINGS: Final = {"bot": ".ast", "scene": ".toml"}


@click.command("new")
@click.argument("kind", type=click.Choice([*_ENDINGS]), metavar="bot|scene")
@click.argument("name")
@click.option("--force", is_flag=True, help="Write over a file that is there.")
def command(kind: Literal["bot", "scene"], name: str, force: bool) -> int:
    """Write a commented starting point that runs at once, into the folder you are in.

    `new bot NAME` writes the ship program NAME.ast, `new scene NAME` the scene NAME.toml. The scene's ship is flown by
    NAME.ast if that is there, else by a small program in the scene. A NAME starts with a letter; letters from a to z
    or A to Z, digits, '-' and '_' follow. What to do next is said on standard error. Exit codes: 0 done, 2 the name
    will not do, the file is there already, or it cannot be written.
    """
    _check(name)
    place = name + _ENDINGS[kind]
    text = _program(name) if kind == "bot" else _scene(name)
    if force:
        write_whole(place, text)
    else:
        _write_new(place, text)
    click.echo(f"Wrote {place}. Next:", err=True)
    for line in _next(kind, name):
        click.echo(f"  {line}", err=True)
    return DONE


def _check(name: str) -> None:
    """`Refusal` if a file of this name would be a nuisance: to a shell, to a scene, to another system."""
    bare = re.sub(r"\.(ast|toml)\Z", "", name)
    if bare != name and _NAME.fullmatch(bare):
        raise Refusal(f"give the name without its ending: {bare!r}, not {name!r}")
    if not _NAME.fullmatch(name):
        raise Refusal(
            "a name is a letter from a to z or A to Z, then such letters, digits, '-' and '_'; "
            f"{name!r} is not"
        )
    if len(name) > MOST_CHARACTERS:
        raise Refusal(f"a name has at most {MOST_CHARACTERS} characters; this one has {len(name)}")
    if _DEVICE.fullmatch(name):
        raise Refusal(f"{name!r} is the name of a device on Windows; take another")


# Texts.


def _filled(template: str, **values: str) -> str:
    text = (files("fasteroids") / "templates" / template).read_text(encoding="utf-8")
    return Template(text).substitute(values)


def _program(name: str) -> str:
    return _filled("bot.ast", name=name)


def _scene(name: str) -> str:
    if _beside(name, "bot"):
        flown = f'program = "{name}.ast"'
    else:
        flown = _filled("program.toml", name=name).rstrip("\n")
    return _filled("scene.toml", name=name, program=flown)


def _beside(name: str, kind: Literal["bot", "scene"]) -> bool:
    """Is there a file of this kind with this name?"""
    return Path(name + _ENDINGS[kind]).is_file()


def _next(kind: Literal["bot", "scene"], name: str) -> list[str]:
    """What to do with the new file: commands."""
    run = [
        f"fasteroids run {name}.toml --for 10",
        f"fasteroids trace {name}.toml --ship {name} --to 0.2",
    ]
    if kind == "scene":
        return run
    check = f"fasteroids check {name}.ast"
    if not _beside(name, "scene"):
        return [check, f"fasteroids new scene {name}", *run]
    return [check, f'put program = "{name}.ast" under a ship in {name}.toml, if it is not there']


# Files.


def _write_new(place: str, text: str) -> None:
    """Write a file that is not there yet, all of it or nothing. Nothing else can come between."""
    path = Path(place)
    try:
        with path.open("xb") as file:
            try:
                file.write(text.encode("utf-8"))
                file.flush()
            except BaseException:
                with suppress(OSError):
                    path.unlink()
                raise
    except FileExistsError:
        raise Refusal(f"{place!r} is there already; --force writes over it") from None
    except OSError as error:
        raise Refusal(f"cannot write {place!r}: {error.strerror}") from None
