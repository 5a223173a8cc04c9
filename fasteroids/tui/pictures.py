"""A picture of the screen, and the scene of that moment beside it, as files."""

from __future__ import annotations

from pathlib import Path

from fasteroids.scene import dump_scene
from fasteroids.state import World
from fasteroids.tui._store import new_file
from fasteroids.units import ModelError

__all__ = ["saved"]


def saved(folder: Path, svg: str, world: World | None) -> str:
    """Write a picture, and the scene of a world if there is one; a sentence that names the files, or says why not.

    A world whose programs are no texts is not written.
    """
    try:
        picture, file = new_file(folder, ".svg")
        with file:
            file.write(svg.encode())
        if world is None:
            return f"saved {picture}"
        scene = picture.with_suffix(".toml")
        try:
            scene.write_text(dump_scene(world), encoding="utf-8")
        except ModelError as error:
            return f"saved {picture}; the scene is not: {error}"
    except OSError as error:
        return f"no picture: cannot write {error.filename or folder}: {error.strerror or error}"
    return f"saved {picture} and {scene.name}"
