"""Time travel: timelines of kept states, questions to a past, recordings.

A world is a value and its future a function of it (laws L1, L11), so a past state is either kept or lived again, with
the same bits.
"""

from fasteroids.history.changes import ABSENT as ABSENT
from fasteroids.history.changes import Changed as Changed
from fasteroids.history.changes import last_change as last_change
from fasteroids.history.conditions import Condition as Condition
from fasteroids.history.conditions import condition as condition
from fasteroids.history.deaths import Course as Course
from fasteroids.history.deaths import Death as Death
from fasteroids.history.deaths import Deed as Deed
from fasteroids.history.deaths import why as why
from fasteroids.history.differences import Difference as Difference
from fasteroids.history.differences import Parted as Parted
from fasteroids.history.differences import diff as diff
from fasteroids.history.differences import first_difference as first_difference
from fasteroids.history.differences import outwardly as outwardly
from fasteroids.history.differences import wholly as wholly
from fasteroids.history.inputs import Act as Act
from fasteroids.history.inputs import Add as Add
from fasteroids.history.inputs import Cut as Cut
from fasteroids.history.inputs import Given as Given
from fasteroids.history.inputs import Input as Input
from fasteroids.history.inputs import Instruct as Instruct
from fasteroids.history.inputs import Place as Place
from fasteroids.history.inputs import Remove as Remove
from fasteroids.history.living import Lived as Lived
from fasteroids.history.living import Told as Told
from fasteroids.history.marks import Kind as Kind
from fasteroids.history.questions import events_of as events_of
from fasteroids.history.questions import first_time as first_time
from fasteroids.history.questions import last_time as last_time
from fasteroids.history.questions import next_state as next_state
from fasteroids.history.questions import previous_state as previous_state
from fasteroids.history.stepping import Point as Point
from fasteroids.history.stepping import Tick as Tick
from fasteroids.history.stepping import at_tick as at_tick
from fasteroids.history.stepping import machine_at as machine_at
from fasteroids.history.stepping import next_statement as next_statement
from fasteroids.history.stepping import next_step as next_step
from fasteroids.history.stepping import next_tick as next_tick
from fasteroids.history.stepping import previous_statement as previous_statement
from fasteroids.history.stepping import previous_step as previous_step
from fasteroids.history.stepping import previous_tick as previous_tick
from fasteroids.history.stepping import tick_at as tick_at
from fasteroids.history.stepping import ticks_of as ticks_of
from fasteroids.history.timeline import BUDGET as BUDGET
from fasteroids.history.timeline import Bookmark as Bookmark
from fasteroids.history.timeline import Timeline as Timeline
from fasteroids.history.timeline import begin as begin

__all__ = [
    "ABSENT",
    "BUDGET",
    "Act",
    "Add",
    "Bookmark",
    "Changed",
    "Condition",
    "Course",
    "Cut",
    "Death",
    "Deed",
    "Difference",
    "Given",
    "Input",
    "Instruct",
    "Kind",
    "Lived",
    "Parted",
    "Place",
    "Point",
    "Remove",
    "Tick",
    "Timeline",
    "Told",
    "at_tick",
    "begin",
    "condition",
    "diff",
    "events_of",
    "first_difference",
    "first_time",
    "last_change",
    "last_time",
    "machine_at",
    "next_state",
    "next_statement",
    "next_step",
    "next_tick",
    "outwardly",
    "previous_state",
    "previous_statement",
    "previous_step",
    "previous_tick",
    "tick_at",
    "ticks_of",
    "wholly",
    "why",
]
