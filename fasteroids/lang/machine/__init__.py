"""Programs that run: `_machine` explains it; `code` and `steps` below it, `saved` and `traced` above."""

from fasteroids.lang.machine._machine import Each as Each
from fasteroids.lang.machine._machine import Frame as Frame
from fasteroids.lang.machine._machine import Halted as Halted
from fasteroids.lang.machine._machine import Machine as Machine
from fasteroids.lang.machine._machine import Ran as Ran
from fasteroids.lang.machine._machine import Running as Running
from fasteroids.lang.machine._machine import Stepped as Stepped
from fasteroids.lang.machine._machine import Todo as Todo
from fasteroids.lang.machine._machine import place as place
from fasteroids.lang.machine._machine import refreshed as refreshed
from fasteroids.lang.machine._machine import run as run
from fasteroids.lang.machine._machine import run_by_steps as run_by_steps
from fasteroids.lang.machine._machine import started as started
from fasteroids.lang.machine._machine import step as step
from fasteroids.lang.machine._machine import tick as tick

__all__ = [
    "Each",
    "Frame",
    "Halted",
    "Machine",
    "Ran",
    "Running",
    "Stepped",
    "Todo",
    "place",
    "refreshed",
    "run",
    "run_by_steps",
    "started",
    "step",
    "tick",
]
