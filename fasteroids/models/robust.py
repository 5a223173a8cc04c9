"""`robust`, the default: hit or miss is decided right for all doubles, at the price of a filter.

Contract: the class (hit or miss) is right for the ten doubles given, whatever they are; the time is off by at
most ulp/2 + 4 u cond t; overlapping and approaching is 0.0, overlapping and receding NEVER. The sequence of
events equals the proven one while the growth of errors stays below 36 bits.
"""

from __future__ import annotations

from fasteroids.models._model import Model
from fasteroids.physics import contact_time_exact, contact_time_filtered

__all__ = ["MODEL"]

MODEL = Model(
    name="robust",
    filtered=contact_time_filtered,
    exact=contact_time_exact,
    thrust="literal",
    promise="hit or miss is decided right for all doubles; thrust is kicked at each cut, as the text says",
)
