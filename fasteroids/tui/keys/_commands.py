"""Everything a key can ask of the game."""

from __future__ import annotations

from enum import Enum
from typing import Final, Literal, TypeAlias

__all__ = ["FLIGHT", "Command", "Group"]

Group: TypeAlias = Literal[
    "Player one", "Player two", "Time", "Search", "Selection", "Program", "View", "Game"
]
"""The headings of the help screen, in its order."""


class Command(Enum):
    """A command: its value is its name in the config file; `group` and `says` are for the help screen."""

    group: Group
    says: str

    def __new__(cls, name: str, group: Group, says: str) -> Command:
        """A member whose value is the name alone."""
        self = object.__new__(cls)
        self._value_ = name
        self.group, self.says = group, says
        return self

    ONE_LEFT = "one-left", "Player one", "turn left"
    ONE_RIGHT = "one-right", "Player one", "turn right"
    ONE_THRUST = "one-thrust", "Player one", "thrust"
    ONE_FIRE = "one-fire", "Player one", "fire"

    TWO_LEFT = "two-left", "Player two", "turn left"
    TWO_RIGHT = "two-right", "Player two", "turn right"
    TWO_THRUST = "two-thrust", "Player two", "thrust"
    TWO_FIRE = "two-fire", "Player two", "fire"

    PAUSE = "pause", "Time", "pause, or go on"
    SLOWER = "slower", "Time", "slower"
    FASTER = "faster", "Time", "faster"
    BACK_FRAME = "back-frame", "Time", "back by a frame"
    FORWARD_FRAME = "forward-frame", "Time", "forward by a frame"
    BACK_EVENT = "back-event", "Time", "back by an event"
    FORWARD_EVENT = "forward-event", "Time", "forward by an event"
    BACK_TICK = "back-tick", "Time", "back by a tick of the programs (0.2 s)"
    FORWARD_TICK = "forward-tick", "Time", "forward by a tick of the programs (0.2 s)"
    BACK_SECOND = "back-second", "Time", "back by a second"
    FORWARD_SECOND = "forward-second", "Time", "forward by a second"
    FIRST = "first", "Time", "to the beginning"
    LAST = "last", "Time", "to the newest moment"
    TAKE_OVER = "take-over", "Time", "take over here"

    PREVIOUS_DEATH = "previous-death", "Search", "to the previous death"
    NEXT_DEATH = "next-death", "Search", "to the next death"
    PREVIOUS_SHOT = "previous-shot", "Search", "to the previous shot"
    NEXT_SHOT = "next-shot", "Search", "to the next shot"
    PREVIOUS_CONTACT = "previous-contact", "Search", "to the previous contact of the selected one"
    NEXT_CONTACT = "next-contact", "Search", "to the next contact of the selected one"
    BOOKMARK = "bookmark", "Search", "set a bookmark here"
    PREVIOUS_BOOKMARK = "previous-bookmark", "Search", "to the previous bookmark"
    NEXT_BOOKMARK = "next-bookmark", "Search", "to the next bookmark"
    WHY = "why", "Search", "why did I die?"

    SELECT_PREVIOUS = "select-previous", "Selection", "select the previous one"
    SELECT_NEXT = "select-next", "Selection", "select the next one"

    PROGRAM_BACK = "program-back", "Program", "back by a statement"
    PROGRAM_FORWARD = "program-forward", "Program", "forward by a statement"
    BREAKPOINT = "breakpoint", "Program", "set or remove a breakpoint"
    BREAK_WHEN = "break-when", "Program", "a breakpoint on a condition, or on a line by its number"
    RUN_BACK = "run-back", "Program", "run back to a breakpoint"
    RUN_FORWARD = "run-forward", "Program", "run forward to a breakpoint"
    EDIT = "edit", "Program", "edit the program"
    DIFFERENCE = "difference", "Program", "what is different in this line"

    ARENA = "arena", "View", "switch between Braille, blocks and ASCII"
    OVERLAY = "overlay", "View", "paths and contacts to come"
    GHOSTS = "ghosts", "View", "ghosts of another future"
    PANELS = "panels", "View", "show or hide the panels"
    CHOOSE = "choose", "View", "choose a line of the panel"
    SCREENSHOT = "screenshot", "View", "save a picture and the scene"

    MUTE = "mute", "Game", "sound on or off"
    HELP = "help", "Game", "these keys"
    PALETTE = "palette", "Game", "all commands"
    BACK = "back", "Game", "back, and from the start screen out"
    QUIT = "quit", "Game", "quit"

    @property
    def player(self) -> Literal[1, 2] | None:
        """Whose ship it flies: 1 or 2, None for what flies no ship."""
        return {"Player one": 1, "Player two": 2}.get(self.group)  # type: ignore[return-value]


FLIGHT: Final = frozenset(command for command in Command if command.player is not None)
"""The commands that fly a ship."""
