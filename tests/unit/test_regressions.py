"""The smallest scene of every bug there was, and what should happen in it."""

from __future__ import annotations

from pathlib import Path

from fasteroids import happenings, load_scene

SCENES = Path(__file__).resolve().parents[1] / "scenes"


def log(name: str, until: float) -> list[tuple[float, str, tuple[int, ...], str]]:
    world = load_scene((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    return [(h.time, h.kind, h.entities, h.effect) for h, _ in happenings(world, until)]


def test_survivor_of_a_contact_looks_again() -> None:
    """Law that found it: L3."""
    assert log("survivor", 4.0) == [
        (1.3, "contact", (1, 3), "die"),
        (3.3, "contact", (2, 3), "bounce"),
    ]
