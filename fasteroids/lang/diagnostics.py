"""What is wrong with a program, as a value: code, place, one plain sentence, a hint with the fix."""

from __future__ import annotations

from typing import Literal

from attrs import frozen

from fasteroids.lang.source import Span

__all__ = ["Diagnostic", "Edit", "Note", "Severity"]

Severity = Literal["error", "warning"]


@frozen
class Note:
    """Another place that a diagnostic speaks of: "declared as an entity here"."""

    text: str
    span: Span


@frozen
class Edit:
    """Put `text` in the place of a piece of source."""

    span: Span
    text: str


@frozen
class Diagnostic:
    """One fault. `message` is a plain sentence without a full stop, `hint` tells the fix, if there is a likely one.

    `code` is `FA` and three digits; `fasteroids.lang.codes` says what it means and its phase. `label` is the short
    text under the piece pointed at. `fix`, where not empty, mends the text.
    """

    code: str
    message: str
    span: Span
    hint: str | None = None
    label: str = ""
    notes: tuple[Note, ...] = ()
    fix: tuple[Edit, ...] = ()
    severity: Severity = "error"
