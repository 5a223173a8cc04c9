"""Scenes by name: their text, and the world of it for any seed."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from pathlib import Path

from attrs import frozen

from fasteroids.cli._bots import boarded
from fasteroids.cli._files import STDIO, names_file, read_limited, read_named, shipped
from fasteroids.cli._guard import Refusal, reason
from fasteroids.scene import SceneError, load_scene
from fasteroids.state import World
from fasteroids.units import ModelError

__all__ = ["Scene", "open_scene", "read_scene"]


@frozen
class Scene:
    """The text of a scene, what to call it, and the folder in which the programs that it names are looked for."""

    title: str
    text: str
    folder: Path

    def world(self, *, seed: int | None, model: str | None) -> World:
        """Its world. `seed` and `model` replace those of the text. `Refusal` says what is wrong with it."""
        try:
            return load_scene(self.text, seed=seed, model=model, read=_reader(self.folder))
        except SceneError as error:
            count = len(error.problems)
            head = f"{self.title} has {count} problems:\n" if count > 1 else f"{self.title}: "
            raise Refusal(head + str(error)) from None


def open_scene(
    scene: str, *, seed: int | None, model: str | None, bots: Sequence[str] = ()
) -> tuple[str, World]:
    """What to call a scene, and its world, as `read_scene` and `Scene.world` give them.

    With `bots` its ships, in the order of their ids, run these programs. `Refusal` says what is wrong with it.
    """
    found = read_scene(scene)
    world = found.world(seed=seed, model=model)
    return found.title, boarded(found.title, world, bots) if bots else world


def read_scene(scene: str) -> Scene:
    """The text of a scene: of a path, of '-' for standard input, or of a shipped one. A path wins."""
    if scene == STDIO:
        if sys.stdin is None:
            raise Refusal("standard input is closed")
        data = read_limited(sys.stdin.buffer, "standard input", "scene")
        return Scene("standard input", _decoded("standard input", data), Path())
    path = Path(scene)
    if not names_file(path) and path.name == scene and (text := shipped().get(scene)) is not None:
        return Scene(scene, text, Path())
    try:
        with path.open("rb") as file:
            title = path.name if path.name.isprintable() else repr(path.name)
            return Scene(title, _decoded(title, read_limited(file, title, "scene")), path.parent)
    except FileNotFoundError:
        raise Refusal(_missing(scene)) from None
    except OSError as error:
        raise Refusal(f"cannot read {reason(error, path)}") from None


def _decoded(title: str, data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        byte = error.object[error.start]
        raise Refusal(
            f"{title}: a scene is text in UTF-8; the byte {byte:#04x} on line {line} is not"
        ) from None


def _missing(scene: str) -> str:
    names = list(shipped())
    near = get_close_matches(scene, names, n=1)
    hint = f" (did you mean {near[0]!r}?)" if near else ""
    known = f", or one of these: {', '.join(names)}" if names else ""
    return f"there is no scene {scene!r}{hint}; give a file, '-' for standard input{known}"


def _reader(folder: Path) -> Callable[[str], bytes]:
    """What reads the programs that a scene in this folder names."""

    def read(name: str) -> bytes:
        if not name:
            raise ModelError("must be the name of a file")
        try:
            return read_named(name, folder)
        except Refusal as refusal:
            raise ModelError(str(refusal.message)) from None

    return read
