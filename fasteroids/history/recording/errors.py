"""What is wrong with a recording, in a sentence."""

from __future__ import annotations

from fasteroids.units import ModelError

__all__ = ["RecordingError"]


class RecordingError(ModelError):
    """A file that is no recording, or none that this version can read; the sentence names the line."""

    line: int | None
    """The line, from 1; None if the whole file is meant."""

    def __init__(self, message: str, line: int | None = None) -> None:
        self.line = line
        super().__init__(message if line is None else f"line {line}: {message}")
