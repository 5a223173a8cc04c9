"""Randomness as a pure function of (seed, entity id, purpose).

There is no generator and no state, so adding an entity, or asking twice, never changes another's luck.
"""

from __future__ import annotations

import hashlib
import math

__all__ = ["angle", "uniform"]


def uniform(seed: int, entity_id: int, purpose: str) -> float:
    """A number in [0, 1), a multiple of 2^-53, the same for the same arguments on every platform.

    The first 53 bits of the BLAKE2b hash of the three arguments.
    """
    text = f"{seed:x}:{entity_id:x}:{purpose}".encode()
    bits = int.from_bytes(hashlib.blake2b(text, digest_size=8).digest(), "big") >> 11
    return math.ldexp(bits, -53)


def angle(seed: int, entity_id: int, purpose: str) -> float:
    """A direction in [0, 2 pi) rad, drawn as `uniform` does."""
    return uniform(seed, entity_id, purpose) * math.tau
