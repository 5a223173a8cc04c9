"""`smooth`: the decisions of `robust`, and thrusting ships on their exact paths (assignment 1.2, 1.6).

Contract: between changes a thrusting ship flies a parabola, and at its speed limit the exact limited curve, so its
path does not depend on how time is cut. Two parabolas: hit or miss decided right, the time off by at most
ulp/2 + 16 u cond t; on the limited curve a contact is never missed and never late. Without a thruster on, the
same bits as `robust`.
"""

from __future__ import annotations

from fasteroids.models._model import Model
from fasteroids.physics import contact_time_exact, contact_time_filtered

__all__ = ["MODEL"]

MODEL = Model(
    name="smooth",
    filtered=contact_time_filtered,
    exact=contact_time_exact,
    thrust="smooth",
    promise="decisions as robust; thrusting ships fly their exact paths, however time is cut",
)
