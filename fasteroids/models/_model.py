"""What an accuracy level is: a record of functions and a name."""

from __future__ import annotations

from typing import Literal, Protocol

from attrs import frozen

__all__ = ["ContactTime", "Model", "ThrustRule"]

ThrustRule = Literal["literal", "smooth"]


class ContactTime(Protocol):
    """Seconds until two discs touch: x, y, vx, vy, radius of i, then of j (km, km/s).

    NEVER (inf) if they will not; 0.0 if they overlap and approach; never negative.
    """

    def __call__(
        self,
        xi: float, yi: float, vxi: float, vyi: float, ri: float,
        xj: float, yj: float, vxj: float, vyj: float, rj: float, /,
    ) -> float: ...  # fmt: skip


@frozen
class Model:
    """A decision level and a thrust rule.

    ``filtered`` answers with plain floats, or UNDECIDED (nan), and then ``exact`` is asked. A level that
    always decides never answers UNDECIDED. ``promise`` says in a sentence what may be relied on.
    """

    name: str
    filtered: ContactTime
    exact: ContactTime
    thrust: ThrustRule
    promise: str

    def contact_time(
        self,
        xi: float, yi: float, vxi: float, vyi: float, ri: float,
        xj: float, yj: float, vxj: float, vyj: float, rj: float,
    ) -> float:  # fmt: skip
        """The filter and, where it is undecided, the exact formula."""
        t = self.filtered(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)
        return t if t == t else self.exact(xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj)
