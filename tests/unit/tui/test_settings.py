"""The config file as text."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.tui.keys import PRESETS, Command, bound, preset
from fasteroids.tui.settings import DEFAULTS, MOST_FPS, Settings, read_settings, text_of
from fasteroids.tui.terminal import ARENAS

settings = st.builds(
    Settings,
    st.builds(
        bound,
        st.sampled_from(sorted(PRESETS)).map(preset),
        st.sampled_from(list(Command)),
        st.lists(st.sampled_from(["a", "p", "?", "Ctrl+X", "F1"]), max_size=3),
    ),
    st.sampled_from([None, *ARENAS]),
    st.integers(1, MOST_FPS),
    st.booleans(),
)


@given(settings)
def test_settings_are_read_back_from_their_text(chosen: Settings) -> None:
    assert read_settings(text_of(chosen)) == (chosen, ())


def test_an_empty_file_is_the_defaults() -> None:
    assert read_settings("") == (Settings(preset("arrows"), None, 30, True), ())
    assert read_settings(text_of(DEFAULTS)) == (DEFAULTS, ())


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ('arena = "brail"', 'arena = "brail": must be one of "ascii", "braille", "block"'),
        ("arena = []", 'arena = []: must be one of "ascii", "braille", "block"'),
        ("fps = 0", "fps = 0: must be an integer from 1 to 120"),
        ("fps = true", "fps = true: must be an integer from 1 to 120"),
        ("fps = 30.0", "fps = 30.0: must be an integer from 1 to 120"),
        ('sound = "no"', 'sound = "no": must be true or false'),
        ('sonud = "no"', 'sonud = "no": there is no such setting (did you mean sound?)'),
        (
            'preset = "vin"',
            'preset = "vin": must be one of "arrows", "azerty", "vim" (did you mean vim?)',
        ),
    ],
)
def test_one_wrong_line_is_told_and_spoils_no_other(line: str, message: str) -> None:
    text = f'{line}\n[keys]\nmute = ["u"]\n'
    read, problems = read_settings(text)
    assert [str(problem) for problem in problems] == [f"line 1: {message}"]
    assert (read.arena, read.fps, read.sound) == (DEFAULTS.arena, DEFAULTS.fps, DEFAULTS.sound)
    assert read.keymap == bound(preset(), Command.MUTE, ["u"])


def test_a_file_that_is_no_toml_is_told_with_each_line_and_the_defaults_are_used() -> None:
    read, problems = read_settings("fps = = 3\nsound = false\narena = nothing\n")
    assert read == DEFAULTS
    assert [problem.line for problem in problems] == [1, 3]


@given(st.text())
def test_any_text_gives_settings(text: str) -> None:
    read, problems = read_settings(text)
    assert read == DEFAULTS or not problems
