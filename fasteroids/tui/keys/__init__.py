"""What a key means: names of keys to commands, in three presets, and as a reader of the config file wants them.

Pure: a keymap is a value, a text goes in and a text comes out. Keys are named as Textual names them (`left`, `space`,
`ctrl+q`, `question_mark`, `left_control`), which `key_of` makes of what people write (`"?"`, `"Ctrl+Q"`, `"Esc"`).
"""

from __future__ import annotations

from fasteroids.tui.keys._commands import FLIGHT, Command, Group
from fasteroids.tui.keys._keymap import (
    HelpRow,
    Keymap,
    bound,
    cleared,
    free,
    help_rows,
    preset,
)
from fasteroids.tui.keys._names import key_of, spoken
from fasteroids.tui.keys._presets import PRESETS
from fasteroids.tui.keys._text import KeymapError, keymap_in, keymap_of, text_of

__all__ = [
    "FLIGHT",
    "PRESETS",
    "Command",
    "Group",
    "HelpRow",
    "Keymap",
    "KeymapError",
    "bound",
    "cleared",
    "free",
    "help_rows",
    "key_of",
    "keymap_in",
    "keymap_of",
    "preset",
    "spoken",
    "text_of",
]
