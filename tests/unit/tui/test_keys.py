"""Keymaps: presets, what people write for a key, the config file's text, the help screen."""

from __future__ import annotations

import subprocess
import sys
from itertools import product
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from textual.keys import _character_to_key

from fasteroids.tui.keys import (
    FLIGHT,
    PRESETS,
    Command,
    Keymap,
    KeymapError,
    bound,
    cleared,
    free,
    help_rows,
    key_of,
    keymap_of,
    preset,
    spoken,
    text_of,
)
from fasteroids.tui.keys._names import MODIFIER_KEYS, known_keys
from fasteroids.tui.keys._text import keymap_in
from fasteroids.units import ModelError

presets = pytest.mark.parametrize("name", PRESETS)

keys = st.one_of(
    st.sampled_from(known_keys()),
    st.sampled_from("abcdefghijklmnopqrstuvwxyzABCXYZ0123456789é"),
    st.builds("{}+{}".format, st.sampled_from(["ctrl", "alt"]), st.sampled_from("abcxyz")),
)


@st.composite
def keymaps(draw: st.DrawFn) -> Keymap:
    """A preset that was changed on screen a few times."""
    keymap = preset(draw(st.sampled_from(sorted(PRESETS))))
    for command, some in draw(
        st.lists(st.tuples(st.sampled_from(list(Command)), st.lists(keys, max_size=3)), max_size=8)
    ):
        keymap = bound(keymap, command, some)
    return keymap


# Presets.


@presets
def test_every_command_has_a_key_in_every_preset(name: str) -> None:
    assert free(preset(name)) == ()


@presets
def test_the_keys_of_presets_are_written_as_textual_names_them(name: str) -> None:
    for command in Command:
        for key in preset(name).keys[command]:
            assert key_of(key) == key


@presets
def test_no_command_has_a_key_of_a_ship_with_a_modifier_that_flies_one(name: str) -> None:
    keymap = preset(name)
    flying = [key for command in FLIGHT for key in keymap.keys[command]]
    held = {MODIFIER_KEYS[key] for key in flying if key in MODIFIER_KEYS}
    assert held == {"ctrl"}
    for modifier, key in product(held, flying):
        assert keymap.command(f"{modifier}+{key}") is keymap.command(key)


def test_player_two_has_wasd_and_three_keys_to_fire_and_zqsd_on_azerty() -> None:
    arrows, azerty = preset("arrows"), preset("azerty")
    assert [arrows.command(key) for key in "wad"] == [azerty.command(key) for key in "zqd"]
    for key in ("left_control", "tab", "f"):
        assert arrows.command(key) is azerty.command(key) is Command.TWO_FIRE


def test_a_preset_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(ModelError, match="no preset 'emacs'; there are arrows, azerty, vim"):
        preset("emacs")


# Which command a key gives.


def test_a_ship_obeys_caps_lock_and_control_held_by_the_other_player() -> None:
    keymap = preset()
    assert keymap.command("A") is Command.TWO_LEFT
    assert keymap.command("ctrl+left") is Command.ONE_LEFT
    assert keymap.command("ctrl+space") is Command.ONE_FIRE


def test_other_commands_do_not_take_a_changed_key_for_theirs() -> None:
    keymap = preset()
    assert keymap.command("P") is None
    assert keymap.command("ctrl+o") is None
    assert keymap.command("alt+left") is None
    assert keymap.command("shift+left") is Command.BACK_SECOND


def test_control_is_a_modifier_like_others_once_nobody_fires_with_it() -> None:
    keymap = bound(preset(), Command.TWO_FIRE, ["f"])
    assert keymap.command("ctrl+left") is None


@given(keymaps(), st.text(max_size=12))
def test_any_text_has_at_most_one_command(keymap: Keymap, key: str) -> None:
    command = keymap.command(key)
    assert command is None or keymap.keys[command]


@given(keymaps())
def test_the_keys_of_a_command_give_it_and_no_key_has_two(keymap: Keymap) -> None:
    owned = [key for command in Command for key in keymap.keys[command]]
    assert len(owned) == len(set(owned))
    for command in Command:
        assert all(keymap.command(key) is command for key in keymap.keys[command])


# Changing.


def test_a_key_given_to_a_command_is_taken_from_its_owner() -> None:
    keymap = bound(preset(), Command.MUTE, ["p", "F6"])
    assert keymap.keys[Command.MUTE] == ("p", "f6")
    assert free(keymap) == (Command.PAUSE,)
    assert keymap.command("m") is None


def test_clearing_gives_back_the_preset_but_for_keys_that_others_have_now() -> None:
    keymap = bound(bound(preset(), Command.MUTE, ["F6"]), Command.PANELS, ["m", "i"])
    assert cleared(keymap, Command.MUTE).keys[Command.MUTE] == ()
    assert cleared(cleared(keymap, Command.PANELS), Command.MUTE) == preset()


# Names.


@pytest.mark.parametrize(
    ("written", "key"),
    [
        ("?", "question_mark"),
        ("+", "plus"),
        ("Ctrl++", "ctrl+plus"),
        ("-", "minus"),
        (" ", "space"),
        ("Esc", "escape"),
        ("Ctrl+Q", "ctrl+q"),
        ("shift+a", "A"),
        ("Shift+Ctrl+A", "ctrl+shift+a"),
        ("Shift+Left", "shift+left"),
        ("PgUp", "pageup"),
        ("é", "é"),
        ("left_control", "left_control"),
        ("hyphen_minus", "minus"),
    ],
)
def test_keys_are_read_as_people_write_them(written: str, key: str) -> None:
    assert key_of(written) == key


@given(st.characters(codec="latin-1").filter(lambda sign: sign.isprintable()))
def test_characters_are_named_as_textual_names_them(sign: str) -> None:
    if sign != "\xad":
        assert key_of(sign) == _character_to_key(sign)


@given(keys)
def test_a_key_that_was_read_reads_as_itself_and_so_does_what_is_shown(key: str) -> None:
    assert key_of(key_of(key)) == key_of(key)
    if "_" not in key or len(spoken(key)) == 1:
        assert key_of(spoken(key)) == key_of(key)


@given(st.text(max_size=20))
def test_any_text_is_a_key_or_refused_with_a_sentence(text: str) -> None:
    try:
        key = key_of(text)
    except ModelError as error:
        message = str(error)
    else:
        message = ""
        assert key_of(key) == key
    assert not message or message.startswith("there is no ")


# The config file.


@given(keymaps())
def test_a_keymap_is_read_back_from_its_text(keymap: Keymap) -> None:
    assert keymap_of(text_of(keymap)) == keymap


def test_a_command_that_is_named_has_the_keys_it_is_given_and_no_others() -> None:
    keymap = keymap_of('preset = "vim"\n[keys]\nmute = ["F6", "u"]\nhelp = []\n')
    assert keymap.keys[Command.MUTE] == ("f6", "u")
    assert keymap.keys[Command.HELP] == ()
    assert keymap.command("h") is Command.ONE_LEFT


def test_a_key_of_the_preset_may_be_taken_while_another_is_left() -> None:
    keymap = keymap_of('[keys]\nmute = ["i"]')
    assert keymap.keys[Command.PANELS] == ("f3",)


def test_two_commands_may_exchange_their_keys() -> None:
    keymap = keymap_of('[keys]\nmute = ["p"]\npause = ["m"]')
    assert (keymap.command("p"), keymap.command("m")) == (Command.MUTE, Command.PAUSE)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            'preset = "vm"',
            'line 1: preset = "vm": must be one of "arrows", "azerty", "vim" (did you mean vim?)',
        ),
        ("preset = 3", 'line 1: preset = 3: must be one of "arrows", "azerty", "vim"'),
        ("\nkeys = 3", "line 2: keys = 3: must be a table: [keys]"),
        (
            '[keys]\npauze = ["x"]',
            'line 2: [keys], pauze = ["x"]: there is no such command (did you mean pause?)',
        ),
        (
            '[keys]\npause = "x"',
            'line 2: [keys], pause = "x": must be a list of keys, such as ["p", "Enter"]',
        ),
        (
            '[keys]\nmute = [\n"Sapce"]',
            "line 2: [keys], mute = [\"Sapce\"]: there is no key 'Sapce' (did you mean space?)",
        ),
        (
            '[keys]\nmute = ["contrl+x"]',
            "line 2: [keys], mute = [\"contrl+x\"]: there is no modifier 'contrl'; there are alt, ctrl, shift",
        ),
        (
            '[keys]\nmute = ["q"]\nedit = ["q", "f2"]',
            'line 3: [keys], edit = ["q", "f2"]: q is given to mute too (line 2)',
        ),
        (
            '[keys]\nbookmark = ["p"]',
            'line 2: [keys], bookmark = ["p"]: p is pause in the preset, which has no key left: '
            "give it one, or say pause = []",
        ),
        ("a = = 3", "line 1: a = = 3: not TOML: invalid value at column 5"),
    ],
)
def test_what_is_wrong_is_told_in_a_sentence_with_its_line(text: str, sentence: str) -> None:
    with pytest.raises(KeymapError) as caught:
        keymap_of(text)
    assert str(caught.value) == sentence


def test_everything_that_is_wrong_is_told_and_the_rest_is_used() -> None:
    table = {"mute": ["f6"], "puase": ["x"], "help": 3, "edit": ["nokey", "u"]}
    keymap, problems = keymap_in({"preset": "vim", "keys": table}, {})
    assert len(problems) == 3
    assert keymap.keys[Command.MUTE] == ("f6",)
    assert keymap.keys[Command.EDIT] == ("u",)
    assert keymap.keys[Command.HELP] == preset("vim").keys[Command.HELP]


@given(
    st.dictionaries(
        st.sampled_from([*(command.value for command in Command), "nonsense"]),
        st.one_of(
            st.lists(keys | st.text(max_size=3), max_size=3),
            st.integers(),
            st.lists(st.integers(), max_size=2),
        ),
        max_size=8,
    )
)
def test_any_table_gives_a_keymap(table: dict[str, object]) -> None:
    keymap, problems = keymap_in({"keys": table}, {})
    lost = [command for command in free(keymap) if table.get(command.value) != []]
    assert not lost or problems


# Help.


@given(keymaps())
def test_help_names_every_command_once_with_all_its_keys(keymap: Keymap) -> None:
    rows = help_rows(keymap)
    assert sorted(row.command.value for row in rows) == sorted(command.value for command in Command)
    assert list(dict.fromkeys(row.group for row in rows)) == [
        *("Player one", "Player two", "Time", "Search", "Selection", "Program", "View", "Game")
    ]
    for row in rows:
        assert row.keys == ", ".join(spoken(key) for key in keymap.keys[row.command])


def test_keys_are_shown_as_they_are_printed_on_a_keyboard() -> None:
    shown = {row.command: row.keys for row in help_rows(preset())}
    assert shown[Command.HELP] == "?, F1"
    assert shown[Command.BACK_SECOND] == "Shift+Left, PgUp"
    assert shown[Command.TWO_FIRE] == "Left control, Tab, f"
    assert shown[Command.QUIT] == "Ctrl+Q"
    assert "\n".join(shown.values()).isascii()


# Purity.


def test_the_pure_parts_need_no_textual() -> None:
    code = (
        "import sys; sys.modules['textual'] = None\n"
        "import fasteroids.tui.keys, fasteroids.tui.controls, fasteroids.tui.scores\n"
        "import fasteroids.tui.settings, fasteroids.tui.terminal, fasteroids.tui.sound\n"
        "import fasteroids.tui._store"
    )
    root = Path(__file__).resolve().parents[3]
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=root, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
