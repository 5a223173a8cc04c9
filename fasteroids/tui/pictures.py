"""A picture of the screen, and the scene of that moment beside it, as files."""

from __future__ import annotations

import time
from contextlib import suppress
from pathlib import Path

from fasteroids.scene import dump_scene
from fasteroids.state import World
from fasteroids.units import ModelError

__all__ = ["saved"]


def saved(folder: Path, svg: str, world: World | None) -> str:
    """Write a picture, and the scene of a world if there is one; a sentence that names the files, or says why not.

    A world whose programs are no texts is not written.
    """
    stamp = time.strftime("%Y%m%d-%H%M%S")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        picture = _written(folder, stamp, svg)
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


def _written(folder: Path, stamp: str, svg: str) -> Path:
    """The new file of a picture, over no other."""
    for number in range(1, 1000):
        place = folder / f"{stamp}{'' if number == 1 else f'-{number}'}.svg"
        with suppress(FileExistsError), place.open("x", encoding="utf-8") as file:
            file.write(svg)
            return place
    raise OSError(None, "there are a thousand pictures of this second", str(folder))
