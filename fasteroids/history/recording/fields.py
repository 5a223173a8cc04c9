"""The fields of a record, each taken once and checked, with a sentence for what is wrong; the rest is left over."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf, nan
from typing import Any, Final, TypeVar

from fasteroids.history.recording.errors import RecordingError
from fasteroids.moments import LAST_WINDOW, Clock, Moment, moment_at, seconds
from fasteroids.units import WINDOW, shown

__all__ = ["Fields", "double", "is_id"]

T = TypeVar("T")

_MISSING: Final = object()
_MOST_BITS: Final = 8192  # of an id, as in a scene
_MOST_COUNT: Final = 2**63


class Fields:
    """The fields of a record that were not taken yet."""

    def __init__(self, record: object, what: str = "a line") -> None:
        if not isinstance(record, dict):
            raise RecordingError(f"{what} must be an object of JSON; got {shown(record)}")
        self.rest: dict[str, Any] = dict(record)

    def _take(
        self, name: str, allowed: str, fits: Callable[[Any], bool], default: Any = _MISSING
    ) -> Any:
        value = self.rest.pop(name, _MISSING)
        if value is _MISSING:
            if default is _MISSING:
                raise RecordingError(f'"{name}" is missing')
            return default
        if not fits(value):
            raise _wrong(name, allowed, value)
        return value

    # Plain values.

    def text(self, name: str, default: Any = _MISSING) -> str:
        """A text."""
        value: str = self._take(name, "a text", lambda v: isinstance(v, str), default)
        return value

    def word(self, name: str, allowed: Mapping[str, T] | tuple[str, ...]) -> str:
        """One of some words."""
        value: str = self._take(
            name, f"one of {', '.join(allowed)}", lambda v: isinstance(v, str) and v in allowed
        )
        return value

    def whole(self, name: str, least: int = 0, most: int = _MOST_COUNT) -> int:
        """A whole number within limits."""
        value: int = self._take(
            name,
            f"a whole number from {least} to {most}",
            lambda v: type(v) is int and least <= v <= most,
        )
        return value

    def number(self, name: str, least: float = -inf, default: Any = _MISSING) -> float:
        """A finite number, not below a limit."""
        allowed = "a finite number" if least == -inf else f"a finite number from {least!r}"
        return double(self._take(name, allowed, lambda v: _is_number(v, least), default))

    def seed(self) -> int:
        """The seed of a world: any integer, within what is still printable."""
        value: int = self._take(
            "seed", "an integer", lambda v: type(v) is int and v.bit_length() <= _MOST_BITS
        )
        return value

    def entity(self, name: str) -> int:
        """An id."""
        value: int = self._take(name, "an id, a whole number from 1", is_id)
        return value

    def entities(self, name: str, default: Any = ()) -> tuple[int, ...]:
        """A list of ids."""
        ids = self._take(
            name, "a list of ids", lambda v: isinstance(v, list) and all(map(is_id, v)), default
        )
        return tuple(ids)

    def object(self, name: str) -> dict[str, Any]:
        """An object."""
        value: dict[str, Any] = self._take(name, "an object", lambda v: isinstance(v, dict))
        return value

    def list(self, name: str, default: Any = _MISSING) -> list[Any]:
        """A list."""
        value: list[Any] = self._take(name, "a list", lambda v: isinstance(v, list), default)
        return value

    # Times.

    def moment(self) -> Moment:
        """The moment that `time` tells, or `moment` where that does not do; they must agree."""
        time = self.number("time", 0.0)
        if "moment" not in self.rest:
            return moment_at(time)
        window, offset = self._take(
            "moment", "a number of windows of 1024 s and the seconds in the window", _is_moment
        )
        moment = window, float(offset)
        if seconds(*moment) != time:
            raise RecordingError(
                f'"moment" must be at the "time" of its line, {time!r} s; it is at {seconds(*moment)!r} s'
            )
        return moment

    def clock(self) -> Clock:
        """The clock that these and `residue` tell."""
        return *self.moment(), self.residue()

    def residue(self) -> float:
        """The residue of a clock, s; 0 if there is none."""
        residue = self.number("residue", default=0.0)
        if abs(residue) > 2.0**-42:  # what two sums of offsets can leave
            raise _wrong("residue", f"between -{2.0**-42!r} and {2.0**-42!r} s", residue)
        return residue


def _wrong(name: str, allowed: str, value: object) -> RecordingError:
    return RecordingError(f'"{name}" must be {allowed}; got {shown(value)}')


def is_id(value: object) -> bool:
    """Is it an id?"""
    return type(value) is int and 1 <= value and value.bit_length() <= _MOST_BITS


def _is_number(value: object, least: float = -inf) -> bool:
    """Is it a finite number, not below a limit? A whole number is taken for a double, if it is not too large."""
    if type(value) not in (int, float):
        return False
    number = double(value)
    return -inf < number < inf and number >= least


def double(value: Any) -> float:
    """A number of JSON as a double: nan for null, infinite where it is too large."""
    if value is None:
        return nan
    try:
        return float(value)
    except OverflowError:
        return inf


def _is_moment(value: Any) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and type(value[0]) is int
        and 0 <= value[0] < LAST_WINDOW
        and _is_number(value[1])
        and 0.0 <= double(value[1]) < WINDOW
    )
