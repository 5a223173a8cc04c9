"""Draw a run as SVG: ``python tools/picture.py SCENE SECONDS > docs/run.svg``.

Each entity leaves its path, in a colour and a dash of its own kind; contacts are dots, wall hits ticks, deaths
crosses. Entities that live on are drawn where they end, the others are gone.
"""

from __future__ import annotations

import sys
from pathlib import Path

from fasteroids import Asteroid, Bullet, Ship, World, happenings, load_scene
from fasteroids.entities import Entity

BACK, GRID = "#10141a", "#2a323c"
COLOURS = {Ship: "#56b4e9", Asteroid: "#9aa4b0", Bullet: "#f0e442"}  # after Okabe and Ito
MARKS = {"contact": "#e69f00", "wall": "#009e73"}


def draw(world: World, until: float) -> str:
    """The picture of a run, as the text of an SVG file."""
    paths: dict[int, list[tuple[float, float]]] = {
        i: [e.position] for i, e in world.entities.items()
    }
    kinds = {i: type(e) for i, e in world.entities.items()}
    marks: list[str] = []
    h = world.height
    unfold = happenings(world, until)
    before = world
    while True:
        try:
            happened, after = next(unfold)
        except StopIteration as stop:
            end: World = stop.value
            break
        for i in happened.entities:
            if i in after:
                paths[i].append(after[i].position)
        for i in happened.died:
            if i in before and happened.at:
                x, y = happened.at
                paths[i].append((x, y))
                marks.append(cross(x, h - y))
        for i in happened.born:
            if i in after:
                paths[i], kinds[i] = [after[i].position], type(after[i])
        if happened.at and not happened.died:
            x, y = happened.at
            marks.append(
                f'<circle cx="{x:.1f}" cy="{h - y:.1f}" r="4" fill="{MARKS[happened.kind]}"/>'
            )
        before = after
    for i, e in end.entities.items():
        paths[i].append(e.position)
    lines = [line(paths[i], kinds[i], h) for i in paths]
    discs = [disc(e, h) for e in end.entities.values()]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-6 -6 {world.width + 12} {h + 12}" '
            f'font-family="monospace" font-size="15">',
            f'<rect x="0" y="0" width="{world.width}" height="{h}" fill="{BACK}" stroke="{GRID}" stroke-width="6"/>',
            *lines,
            *marks,
            *discs,
            "</svg>",
            "",
        ]
    )


def line(points: list[tuple[float, float]], kind: type[Entity], height: float) -> str:
    """The path of an entity."""
    text = " ".join(f"{x:.1f},{height - y:.1f}" for x, y in points)
    dash = ' stroke-dasharray="2 7"' if kind is Asteroid else ""
    return (
        f'<polyline points="{text}" fill="none" stroke="{COLOURS[kind]}" stroke-opacity="0.75" '
        f'stroke-width="1.8"{dash}/>'
    )


def cross(x: float, y: float) -> str:
    """A death."""
    return (
        f'<path d="M{x - 9:.1f} {y - 9:.1f}l18 18m0 -18l-18 18" stroke="#d55e00" stroke-width="4" '
        'stroke-linecap="round"/>'
    )


def disc(e: Entity, height: float) -> str:
    """An entity where the run ended, with its name."""
    y = height - e.y
    colour = COLOURS[type(e)]
    shape = (
        f'<circle cx="{e.x:.1f}" cy="{y:.1f}" r="{e.radius}" fill="{colour}" fill-opacity="0.25" '
        f'stroke="{colour}" stroke-width="2.5"/>'
    )
    name = e.name or f"#{e.id}"
    return (
        shape
        + f'<text x="{e.x:.1f}" y="{y + 5:.1f}" text-anchor="middle" fill="#e8ecf0">{name}</text>'
    )


if __name__ == "__main__":
    scene, seconds = sys.argv[1:]
    sys.stdout.write(draw(load_scene(Path(scene).read_text(encoding="utf-8")), float(seconds)))
