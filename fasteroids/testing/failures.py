"""A failing world is kept as a scene, the smallest one last."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from attrs import evolve
from hypothesis.errors import UnsatisfiedAssumption

from fasteroids.entities import Ship
from fasteroids.scene import dump_scene
from fasteroids.state import World, replaced

__all__ = ["FOLDER", "keeping"]

FOLDER = Path(os.environ.get("FASTEROIDS_FAILURES", "failures"))
"""Where failing worlds are written: ./failures, or what FASTEROIDS_FAILURES names."""


@contextmanager
def keeping(law: str, world: World) -> Iterator[None]:
    """Write `world` to FOLDER/law.toml if the block fails. Hypothesis runs its smallest example last.

    Open it with ``fasteroids run failures/LAW.toml``. Programs are left out, and named in a comment.
    """
    try:
        yield
    except UnsatisfiedAssumption:
        raise
    except Exception:
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / f"{law}.toml").write_text(_scene(world), encoding="utf-8")
        raise


def _scene(world: World) -> str:
    comments, changed = [], []
    for entity_id, f in world.all_flights().items():
        ship = f.entity
        if isinstance(ship, Ship) and ship.program is not None:
            comments.append(f"# ship {entity_id} runs {ship.program!r}\n")
            plain = evolve(f, entity=evolve(ship, program=None), next_tick=None)
            changed.append((world.slot_of(entity_id), plain))
    bare = replaced(evolve(world), world.clock, changed, (), ())
    return "".join(comments) + dump_scene(bare)
