"""Draw the two rules of thrust as SVG: ``python tools/thrust_picture.py paths > docs/thrust-paths.svg``.

`paths` is one ship under `smooth`, and under `literal` cut at several steps; `error` is how far apart the two rules
are after 1 s, against the step. Every number in a figure is measured as it is drawn. The caption of a figure is its
`<desc>`, and docs/thrust.md quotes it (tests/unit/test_thrust_picture.py).
"""

from __future__ import annotations

import sys
from math import hypot, log10
from statistics import linear_regression
from typing import Callable

from plot import (
    BOTTOM,
    LEFT,
    RIGHT,
    TEXT,
    TOP,
    Plot,
    diamond,
    disc,
    dot,
    framed,
    label,
    legend,
    ring,
    square,
    stroke,
)

from fasteroids import Ship, World, evolve_until, happenings
from fasteroids.physics import thrust

POWER, SMOOTH = "#d55e00", "#56b4e9"
LITERAL = (("#e69f00", "14 5"), ("#f0e442", "6 5"), ("#009e73", "1.5 5"))  # after Okabe and Ito

CURVE_STEP = 0.02
"""How often (s) the curve of `smooth` is looked at: enough for the eye, and looking changes no bit of it."""

PATH_SPAN, ERROR_SPAN = 3.0, 1.0
PATH_STEPS = (1.0, 0.5, 0.2)
ERROR_STEPS = (0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)


def standard(sideways: float, **rest: float) -> Ship:
    """A standard ship that thrusts to the right, and starts with this speed (km/s) across its thrust."""
    return Ship(40, 50, 0, sideways, 10, 5e15, 0.0, thruster=True, **rest)  # type: ignore[arg-type]


def alone(ship: Ship, model: str) -> World:
    """A world with nothing but room for this ship."""
    return World(1000, 1000, model=model).add(ship)


def flown(ship: Ship, model: str, step: float, span: float) -> list[Ship]:
    """The ship at the start and at each cut: every `step` s, a whole number of times in `span` s."""
    world = alone(ship, model)
    seen = [*world.ships]
    cuts = round(span / step)
    for k in range(1, cuts + 1):
        world = evolve_until(world, k * span / cuts)
        seen += world.ships
    return seen


def apart(a: Ship, b: Ship) -> float:
    """The distance between two centres, km."""
    return hypot(a.x - b.x, a.y - b.y)


def first_held(seen: list[Ship], step: float) -> Ship | None:
    """The ship as it left the first cut that clipped its speed; None if none did."""
    for before, after in zip(seen, seen[1:]):
        if thrust(before.vx, before.vy, *before.acceleration, step, before.max_speed)[2]:
            return after
    return None


def paths(steps: tuple[float, ...] = PATH_STEPS) -> str:
    """Where a ship flies in 3 s that starts across its thrust and reaches its limit on the way: 3 steps at most."""
    span = PATH_SPAN
    start = standard(200.0, max_speed=250.0)
    plot = Plot(0, RIGHT - LEFT, 0, BOTTOM - TOP)  # a pixel a km
    curve = flown(start, "smooth", CURVE_STEP, span)
    literals = [flown(start, "robust", step, span) for step in steps]
    off = [apart(seen[-1], curve[-1]) for seen in literals]
    limits = [(h.time, w.ships[0]) for h, w in happenings(alone(start, "smooth"), span)]
    drawn = plot.axes((0, 200, 400, 600, 800), (0, 100, 200, 300, 400, 500), "x, km", "y, km")
    drawn += _start(plot, start)
    for step, seen, far, (colour, dash) in zip(steps, literals, off, LITERAL):
        drawn += _literal(plot, seen, step, colour, dash)
        drawn.append(_named_end(plot, seen[-1], f"{step:g} s steps: {far:.0f} km off", colour))
    drawn.append(plot.line([s.position for s in curve], SMOOTH))
    drawn.append(_named_end(plot, curve[-1], f"smooth, after {span:g} s", SMOOTH))
    for time, at in limits:
        x, y = plot.at(*at.position)
        drawn.append(diamond(x, y, SMOOTH))
        drawn.append(label(x + 20, y + 2, f"limit, {at.speed:.3g} km/s at {time:.3f} s", SMOOTH))
    keys = [(stroke(SMOOTH), "smooth, however cut")]
    keys += [(stroke(*style), f"literal, cut every {h:g} s") for h, style in zip(steps, LITERAL)]
    keys += [
        (dot(24, -5, TEXT), "a cut: the velocity jumps"),
        (ring(24, -5, TEXT), "the first cut that is clipped"),
        (diamond(24, -5, SMOOTH), "the event of kind limit"),
    ]
    ends = [f"{far:.0f} km off with steps of {h:g} s" for h, far in zip(steps, off)]
    caption = (
        f"{span:g} s of a ship with a speed limit of {start.max_speed:g} km/s that starts at {start.speed:g} km/s "
        "across its thrust. Smooth flies a parabola, meets the limit after "
        f"{' and '.join(f'{time:.3f} s' for time, _ in limits)}, and from there turns towards the thrust. "
        f"Literal flies straight from cut to cut, and ends {', '.join(ends)}."
    )
    return framed("One ship under both rules of thrust", caption, drawn + legend(keys))


def _start(plot: Plot, ship: Ship) -> list[str]:
    x, y = plot.at(*ship.position)
    return [
        f'<path d="M{x + 12:.1f} {y:.1f}h70m-12 -7l12 7l-12 7" fill="none" stroke="{POWER}" '
        'stroke-width="3"/>',
        label(x + 92, y + 6, f"thrust, {hypot(*ship.acceleration):.3g} km/s^2"),
        disc(x, y, TEXT),
        label(x - 10, y + 34, f"start, {ship.speed:.3g} km/s up"),
    ]


def _literal(plot: Plot, seen: list[Ship], step: float, colour: str, dash: str) -> list[str]:
    held = first_held(seen, step)
    return [
        plot.line([s.position for s in seen], colour, dash),
        *(dot(*plot.at(*s.position), colour) for s in seen[1:]),
        *([] if held is None else [ring(*plot.at(*held.position), colour)]),
    ]


def _named_end(plot: Plot, ship: Ship, text: str, colour: str) -> str:
    x, y = plot.at(*ship.position)
    return disc(x, y, colour) + label(x + 18, y + 4, text, colour)


def errors(start: Ship, steps: tuple[float, ...], span: float) -> list[tuple[float, float]]:
    """(step in s, km from `smooth` to `literal` after `span` s), for each step."""
    end = flown(start, "smooth", span, span)[-1]
    return [(h, apart(flown(start, "robust", h, span)[-1], end)) for h in steps]


def power_law(points: list[tuple[float, float]]) -> tuple[float, Callable[[float], float]]:
    """The exponent of the power law that fits best on logarithmic axes, and the law."""
    logs = [[log10(v) for v in column] for column in zip(*points)]
    slope, rise = linear_regression(*logs)
    return slope, lambda x: float(10.0 ** (rise + slope * log10(x)))


def error(steps: tuple[float, ...] = ERROR_STEPS) -> str:
    """How far apart the two rules are after 1 s, against the step."""
    span = ERROR_SPAN
    plot = Plot(0.0008, 0.25, 0.05, 40, log10)
    rest, turning = standard(0.0), standard(80.0, max_speed=100.0)
    of_rest, of_turning = errors(rest, steps, span), errors(turning, steps, span)
    (first, law), (second, other) = power_law(of_rest), power_law(of_turning)
    whole = flown(rest, "smooth", span, span)[-1].x - rest.x
    behind = f"{of_rest[0][1]:.3g} km"
    blue, orange = SMOOTH, LITERAL[0][0]
    numbers = f"{turning.speed:g} km/s across, limit {turning.max_speed:g} km/s"
    drawn = [
        *plot.axes(
            (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2),
            (0.1, 0.2, 0.5, 1, 2, 5, 10, 20),
            "step of literal, s",
            f"distance after {span:g} s, km",
        ),
        *_fitted(plot, of_rest, law, blue, dot),
        *_fitted(plot, of_turning, other, orange, square),
        plot.label(0.016, law(0.024), f"standard ship from rest: slope {first:.3f}", blue, "end"),
        plot.label(0.012, other(0.0086), f"{numbers}: slope {second:.3f}", orange),
        plot.label(0.19, law(0.235), f"{behind} of {whole:.3g} km", blue, "end"),
    ]
    caption = (
        f"How far literal is from smooth after {span:g} s. From rest, with steps of {steps[0]:g} s, a standard "
        f"ship is {behind} behind, of {whole:.3g} km flown. One that starts at {turning.speed:g} km/s across its "
        f"thrust and meets its limit of {turning.max_speed:g} km/s on the way is {of_turning[0][1]:.3g} km off. "
        f"The slopes are {first:.3f} and {second:.3f}: half the step, half the error."
    )
    return framed("The distance between the two rules against the step", caption, drawn)


def _fitted(
    plot: Plot,
    points: list[tuple[float, float]],
    law: Callable[[float], float],
    colour: str,
    mark: Callable[[float, float, str], str],
) -> list[str]:
    return [
        plot.line([(h, law(h)) for h, _ in points], colour),
        *(mark(*plot.at(*point), colour) for point in points),
    ]


if __name__ == "__main__":
    sys.stdout.write({"paths": paths, "error": error}[sys.argv[1]]())
