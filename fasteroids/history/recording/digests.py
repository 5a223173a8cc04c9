"""Fingerprints: of a state, so that two can be compared by a line, and of this platform's sin and cos.

Both are BLAKE2b of 16 bytes, in hexadecimal, over doubles in their eight bytes, least first. They are functions of the
values alone: not of the platform, the version of Python, the seed of its hashes, or the slots of a world.
"""

from __future__ import annotations

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
from fasteroids.lang.machine import Frame, Halted
from fasteroids.lang.machine.values import Seen, Value
from fasteroids.state import Flight, World

__all__ = ["digest", "libm", "named"]

_SIZE: Final = 16  # bytes of a fingerprint

_FLIGHT: Final = Struct("<qqdddddddq")
"""id, since (window, offset), x, y, vx, vy, radius, max_speed, bounced_off."""

_DOUBLE: Final = Struct("<cd").pack
_STATE: Final = Struct("<5d").pack


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
    store = dict(program.store)
    parts = [named(program.code.source).encode()]
    parts += [_of_value(store[name]) for name in sorted(store)]
    if isinstance(program, Halted):
        stop = f";halted {program.reason!r} {program.span and tuple(program.span)!r}"
        return b"".join(parts) + stop.encode("utf-8", "backslashreplace")
    for f in program.todo:
        if isinstance(f, Frame):
            parts.append(b";%d %d %d " % (f.block, f.index, f.done))
            parts += map(_of_value, f.operands)
        else:
            parts.append(b";each %d %d " % (f.block, f.index))
            parts += map(_of_value, f.rest)
    return b"".join(parts)


def _of_value(value: Value) -> bytes:
    """A value of a variable or an operand: a letter for its type, and its bits; every nan is the same."""
    if type(value) is float:
        return _DOUBLE(b"d", value) if value == value else b"nan"
    if value is None:
        return b"n"
    if isinstance(value, Seen):
        state = _STATE(value.x, value.y, value.vx, value.vy, value.radius)
        return b"e%d %b" % (value.id, value.kind.encode()) + state
    return b"t" if value else b"f"


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
