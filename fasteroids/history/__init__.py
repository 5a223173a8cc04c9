"""Time travel: timelines of kept states, questions to a past, recordings.

A world is a value and its future a function of it (laws L1, L11), so a past state is either kept or lived again, with
the same bits.
"""

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
from fasteroids.history.timeline import BUDGET as BUDGET
from fasteroids.history.timeline import Bookmark as Bookmark
from fasteroids.history.timeline import Timeline as Timeline
from fasteroids.history.timeline import begin as begin

__all__ = [
    "BUDGET",
    "Act",
    "Add",
    "Bookmark",
    "Cut",
    "Given",
    "Input",
    "Instruct",
    "Lived",
    "Place",
    "Remove",
    "Timeline",
    "Told",
    "begin",
]
