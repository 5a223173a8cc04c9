"""The keymaps to begin with.

Player one has the arrows and the space bar, player two what the left hand reaches: WASD, and one of Control (where a
terminal reports it), Tab or F to fire. As Control may be held while another key is pressed, no command has Control
with a key that flies a ship.
"""

from __future__ import annotations

from typing import Final

from fasteroids.tui.keys._commands import Command

__all__ = ["DEFAULT", "PRESETS"]

DEFAULT: Final = "arrows"

_C = Command
_ARROWS: Final[dict[Command, tuple[str, ...]]] = {
    _C.ONE_LEFT: ("left",),
    _C.ONE_RIGHT: ("right",),
    _C.ONE_THRUST: ("up",),
    _C.ONE_FIRE: ("space",),
    _C.TWO_LEFT: ("a",),
    _C.TWO_RIGHT: ("d",),
    _C.TWO_THRUST: ("w",),
    _C.TWO_FIRE: ("left_control", "tab", "f"),
    _C.PAUSE: ("p",),
    _C.SLOWER: ("minus",),
    _C.FASTER: ("plus", "equals_sign"),
    _C.BACK_FRAME: ("comma",),
    _C.FORWARD_FRAME: ("full_stop",),
    _C.BACK_EVENT: ("left_square_bracket",),
    _C.FORWARD_EVENT: ("right_square_bracket",),
    _C.BACK_TICK: ("less_than_sign",),
    _C.FORWARD_TICK: ("greater_than_sign",),
    _C.BACK_SECOND: ("shift+left", "pageup"),
    _C.FORWARD_SECOND: ("shift+right", "pagedown"),
    _C.FIRST: ("home",),
    _C.LAST: ("end",),
    _C.TAKE_OVER: ("t",),
    _C.PREVIOUS_DEATH: ("X",),
    _C.NEXT_DEATH: ("x",),
    _C.PREVIOUS_SHOT: ("Z",),
    _C.NEXT_SHOT: ("z",),
    _C.PREVIOUS_CONTACT: ("C",),
    _C.NEXT_CONTACT: ("c",),
    _C.BOOKMARK: ("b",),
    _C.PREVIOUS_BOOKMARK: ("N",),
    _C.NEXT_BOOKMARK: ("n",),
    _C.WHY: ("y",),
    _C.SELECT_PREVIOUS: ("E",),
    _C.SELECT_NEXT: ("e",),
    _C.PROGRAM_BACK: ("f7", "semicolon"),
    _C.PROGRAM_FORWARD: ("f8", "apostrophe"),
    _C.BREAKPOINT: ("f9",),
    _C.BREAK_WHEN: ("f10", "B"),
    _C.RUN_BACK: ("f4",),
    _C.RUN_FORWARD: ("f5",),
    _C.EDIT: ("f2", "ctrl+e"),
    _C.DIFFERENCE: ("r",),
    _C.ARENA: ("v",),
    _C.OVERLAY: ("o",),
    _C.GHOSTS: ("g",),
    _C.PANELS: ("f3", "i"),
    _C.CHOOSE: ("enter",),
    _C.SCREENSHOT: ("f12", "ctrl+g"),
    _C.MUTE: ("m",),
    _C.HELP: ("question_mark", "f1"),
    _C.PALETTE: ("ctrl+p",),
    _C.BACK: ("escape",),
    _C.QUIT: ("ctrl+q",),
}

_AZERTY: Final = {
    **_ARROWS,
    _C.TWO_LEFT: ("q",),
    _C.TWO_THRUST: ("z",),
    # What needs no AltGr there.
    _C.BACK_FRAME: ("comma",),
    _C.FORWARD_FRAME: ("semicolon",),
    _C.BACK_EVENT: ("left_parenthesis",),
    _C.FORWARD_EVENT: ("right_parenthesis",),
    _C.BACK_TICK: ("colon",),
    _C.FORWARD_TICK: ("exclamation_mark",),
    _C.PROGRAM_BACK: ("f7",),
    _C.PROGRAM_FORWARD: ("f8",),
    # Where Z is on other keyboards.
    _C.PREVIOUS_SHOT: ("W",),
    _C.NEXT_SHOT: ("w",),
    # Player two may hold Control and press Q.
    _C.QUIT: ("ctrl+x",),
}

_VIM: Final = {
    **_ARROWS,
    _C.ONE_LEFT: ("h",),
    _C.ONE_RIGHT: ("l",),
    _C.ONE_THRUST: ("k",),
    _C.EDIT: ("i", "f2"),
    _C.PANELS: ("f3",),
    _C.PALETTE: ("colon", "ctrl+p"),
    _C.FIRST: ("home", "circumflex_accent"),
    _C.LAST: ("end", "dollar_sign"),
}

PRESETS: Final = {DEFAULT: _ARROWS, "azerty": _AZERTY, "vim": _VIM}
"""The keys of every command, by the name of the preset."""
