"""Recordings: a past as a file of JSON Lines, to be shown, compared, and lived again with the same bits.

    Recorder, RecordingFile    write one, state by state
    read                       the bytes of a file -> Recording
    verified, differing        does it still happen? where do two part?

A recording holds the first world, what the world outside did and, under literal thrust, where time was cut: enough to
live it again. It also holds what happened, so that it tells something where it cannot be lived again, and so that a
change of the rules, or of a platform's sin and cos, is found by its first difference. `schema.json` beside this module
describes the lines.

Nothing here opens a file, reads a clock or knows a path.
"""

from fasteroids.history.recording.errors import RecordingError as RecordingError
from fasteroids.history.recording.files import RecordingFile as RecordingFile
from fasteroids.history.recording.lines import Bookmark as Bookmark
from fasteroids.history.recording.lines import Entered as Entered
from fasteroids.history.recording.lines import Event as Event
from fasteroids.history.recording.lines import Hash as Hash
from fasteroids.history.recording.lines import Header as Header
from fasteroids.history.recording.lines import Line as Line
from fasteroids.history.recording.lines import Print as Print
from fasteroids.history.recording.lines import Result as Result
from fasteroids.history.recording.lines import Snapshot as Snapshot
from fasteroids.history.recording.lines import record_of as record_of
from fasteroids.history.recording.lines import time_of as time_of
from fasteroids.history.recording.reading import Recording as Recording
from fasteroids.history.recording.reading import read as read
from fasteroids.history.recording.verifying import Difference as Difference
from fasteroids.history.recording.verifying import Verified as Verified
from fasteroids.history.recording.verifying import differing as differing
from fasteroids.history.recording.verifying import parting as parting
from fasteroids.history.recording.verifying import verified as verified
from fasteroids.history.recording.writing import Recorder as Recorder
from fasteroids.history.recording.writing import headed as headed

__all__ = [
    "Bookmark",
    "Difference",
    "Entered",
    "Event",
    "Hash",
    "Header",
    "Line",
    "Print",
    "Recorder",
    "Recording",
    "RecordingError",
    "RecordingFile",
    "Result",
    "Snapshot",
    "Verified",
    "differing",
    "headed",
    "parting",
    "read",
    "record_of",
    "time_of",
    "verified",
]
