"""Fingerprints: of a state, so that two can be compared by a line, and of this platform's sin and cos.

Both are BLAKE2b of 16 bytes, in hexadecimal, over doubles in their eight bytes, least first. They are functions of the
values alone: not of the platform, the version of Python, the seed of its hashes, or the slots of a world.
"""

from __future__ import annotations

import json
import struct
from functools import cache, lru_cache
from hashlib import blake2b, sha256
from math import cos, ldexp, sin, tau
from struct import Struct
from typing import Final

from attrs import fields

from fasteroids.actions import Program
from fasteroids.entities import Asteroid, Bullet, Ship, id_of
from fasteroids.lang import Machine
from fasteroids.lang.machine.saved import saved
from fasteroids.state import Flight, World

__all__ = ["digest", "libm", "named"]

_SIZE: Final = 16  # bytes of a fingerprint

_FLIGHT: Final = Struct("<qqdddddddq")
"""id, since (window, offset), x, y, vx, vy, radius, max_speed, bounced_off."""


def digest(world: World) -> str:
    """A fingerprint of what decides a world's future, but for its clock, which may be cut anywhere.

    That is every flight, in the order of ids, and the next id. Names take no part.
    """
    told = [_told(f) for f in world.flights if f is not None]
    told.sort()
    whole = b"".join([data for _, data in told])
    return blake2b(b"%d;" % world.roster.next_id + whole, digest_size=_SIZE).hexdigest()


def _told(f: Flight) -> tuple[int, bytes]:
    """The id and the bytes of a flight."""
    e, i = f.entity, id_of(f.entity)
    window, offset = f.since
    try:
        data = _FLIGHT.pack(
            i, window, offset, e.x, e.y, e.vx, e.vy, e.radius, e.max_speed, f.bounced_off
        )
    except struct.error:  # an integer of more than 64 bits
        short = _FLIGHT.pack(0, 0, offset, e.x, e.y, e.vx, e.vy, e.radius, e.max_speed, 0)
        data = b"%d %d %d;" % (i, window, f.bounced_off) + short
    if type(e) is Asteroid:
        data += b"a"
    elif type(e) is Bullet:
        data += b"b%d %d;" % (e.source, e.bounced)
    else:
        data += _of_ship(e, f)
    return i, data


def _of_ship(ship: Ship, f: Flight) -> bytes:
    """What the flight of a ship has beside the others'."""
    data = b"s%d " % ship.thruster
    data += struct.pack("<ddd", ship.mass, ship.direction, ship.thrust_power)
    if f.path is not None:
        numbers = [getattr(f.path, a.name) for a in fields(type(f.path))]
        data += struct.pack(f"<{len(numbers)}d", *numbers)
    if ship.program is not None:
        data += _of_program(ship.program)
        data += b"%d;" % (f.next_tick or 0)
    return data


def _of_program(program: Program) -> bytes:
    """A program and where it is. Of one that is no text of the language there is only its repr, which may change."""
    if not isinstance(program, Machine):
        return repr(program).encode("utf-8", "backslashreplace")
    state = {name: value for name, value in saved(program).items() if name != "source"}
    return (
        named(program.code.source) + json.dumps(state, sort_keys=True, separators=(",", ":"))
    ).encode()


@lru_cache(maxsize=256)
def named(text: str) -> str:
    """The name of a program's text in a recording: its SHA-256 in UTF-8, in hexadecimal."""
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


@cache
def libm() -> str:
    """A fingerprint of what sin and cos give on this platform, at 512 angles (rad), small and large."""
    angles = [tau * i / 256 for i in range(256)]
    angles += [ldexp(1.0 + i / 256, i % 64 - 8) for i in range(256)]
    values = [value for angle in angles for value in (sin(angle), cos(angle))]
    return blake2b(struct.pack(f"<{len(values)}d", *values), digest_size=_SIZE).hexdigest()
