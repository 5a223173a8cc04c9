"""The JSON of a line, read strictly: what RFC 8259 leaves to each reader is refused here."""

from __future__ import annotations

import json
from math import isfinite
from typing import Any, Final, NoReturn

from fasteroids.history.recording.errors import RecordingError
from fasteroids.units import shown

__all__ = ["MOST_CHARACTERS", "parsed"]

MOST_CHARACTERS: Final = 64 * 1024 * 1024
"""A longer line is none of a recording. A limit, so that a slip (a disk image) does not fill the memory."""


def parsed(text: str) -> dict[str, Any]:
    """The record in a line: strict JSON, an object, each key once, no number beyond the doubles."""
    if len(text) > MOST_CHARACTERS:
        raise RecordingError(f"a line has at most {MOST_CHARACTERS} characters; this one has more")
    try:
        record = _decoder.decode(text)
    except RecordingError:
        raise
    except RecursionError:
        raise RecordingError("is nested too deeply") from None
    except json.JSONDecodeError as error:
        raise RecordingError(f"is no JSON: {error.msg} at column {error.colno}") from None
    except ValueError:  # an integer of more digits than Python reads
        raise RecordingError("has a whole number of too many digits") from None
    if not isinstance(record, dict):
        raise RecordingError(f"must be an object of JSON; got {shown(record)}")
    return record


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    record = dict(pairs)
    if len(record) < len(pairs):
        seen: set[str] = set()
        twice = next(name for name, _ in pairs if name in seen or seen.add(name))  # type: ignore[func-returns-value]
        raise RecordingError(f"has the key {shown(twice)} twice")
    return record


def _finite(text: str) -> float:
    number = float(text)
    if not isfinite(number):
        raise RecordingError(f"{shown(text)} is beyond the largest double")
    return number


def _constant(name: str) -> NoReturn:
    raise RecordingError(f"{name} is no number of JSON")


_decoder = json.JSONDecoder(object_pairs_hook=_once, parse_float=_finite, parse_constant=_constant)
