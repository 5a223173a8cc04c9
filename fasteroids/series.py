"""Taylor series of bent paths along a direction: how far two formations stay apart, to high order (1.2, 1.5.1).

Two ships that fly side by side bend alike. Bounds that add up what each of them may do see nothing of that; the
series of both, subtracted term by term, do. What is left out of a series is bounded for all times to come.

Limited path. In the variable q = q_0 + w t of `fasteroids.paths` the velocity is c (tanh q, sech q), along the thrust
and across it, and with C = tanh q, S = sech q

    C' = S^2,    S' = -S C,

which gives the coefficients one by one. The derivative f = (S^2, -S C) is analytic but for poles at a distance of
pi / 2 or more from the real axis. For |z - q| <= 1, with y the imaginary part,

    |sech z| <= e sech q / cos 1    and    |(sech z, tanh z)|^2 <= (1 + sin^2 1) / cos^2 1,

so |f| <= K sech q with K = e sqrt(1 + sin^2 1) / cos^2 1 < 12.2, and by Cauchy's estimate the m-th derivative of f at
any later time is at most m! K sech q. Integrated twice from order P - 2, the terms from t^P on are no more than

    K (c / w) sin phi (w t)^P / (P (P - 1)).
"""

from __future__ import annotations

from math import inf
from typing import TypeAlias

from fasteroids.paths import Limited, Path

__all__ = ["ORDER", "Series", "difference", "safe_time", "series"]

ORDER = 12
"""P above: the first order that is bounded, not computed. With it a gap of u c / w is safe for w t = 0.05."""

_K = 12.2

Series: TypeAlias = tuple[list[float], float]
"""Coefficients (km) of the powers 1 to ORDER - 1 of a time in some unit, and the bound of that of ORDER."""


def series(path: Path | None, vx: float, vy: float, nx: float, ny: float, unit: float) -> Series:
    """How far a disc with velocity (vx, vy) km/s moves along the unit vector n, in powers of t / `unit` (s).

    `path` is as it goes on from here; None is straight.
    """
    if isinstance(path, Limited):
        return _limited(path, nx, ny, unit)
    rest = [0.0] * (ORDER - 2)
    if path is not None:
        rest[0] = 0.5 * (path.ax * nx + path.ay * ny) * unit * unit
    return [(vx * nx + vy * ny) * unit, *rest], 0.0


def _limited(path: Limited, nx: float, ny: float, unit: float) -> Series:
    k, omega, reach = path.half, path.rate * unit, path.limit * unit
    along, across = nx * path.ux + ny * path.uy, ny * path.ux - nx * path.uy
    c, s = [(1.0 - k * k) / (1.0 + k * k)], [2.0 * k / (1.0 + k * k)]
    terms = [reach * (along * c[0] + across * s[0])]
    for m in range(1, ORDER - 1):
        factor = omega / m
        mirrored = s[::-1]
        c_next = factor * sum(map(float.__mul__, s, mirrored))
        s.append(-factor * sum(map(float.__mul__, c, mirrored)))
        c.append(c_next)
        terms.append(reach / (m + 1) * (along * c[m] + across * s[m]))
    left = _K / (ORDER * (ORDER - 1)) * path.limit / path.rate * abs(s[0]) * omega**ORDER
    return terms, left


def difference(i: Series, j: Series) -> Series:
    """How the distance along n from i to j changes."""
    return [b - a for a, b in zip(i[0], j[0], strict=True)], i[1] + j[1]


def safe_time(gap: float, change: Series) -> float:
    """A time, in the unit of the series, within which a gap (km, > 0) that changes so stays open; near the longest.

    What closes the gap is added up and what opens it left out, so the sum falls with time. Each term alone would
    need longer than all together: the shortest of these times is halved down to the safe one.
    """
    closing = [min(term, 0.0) for term in change[0]] + [-change[1]]
    alone = [(gap / -term) ** (1.0 / k) for k, term in enumerate(closing, 1) if term < 0.0]
    low, high = 0.0, min(alone, default=inf)
    if high == inf:
        return inf
    for _ in range(8):
        t, total = 0.5 * (low + high), 0.0
        for term in reversed(closing):
            total = (total + term) * t
        if gap + total > 0.0:
            low = t
        else:
            high = t
    return low
