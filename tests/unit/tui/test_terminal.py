"""What a terminal can show, from its variables."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.tui.terminal import terminal_of

UTF8 = {"TERM": "xterm-256color", "LANG": "en_GB.UTF-8"}


@pytest.mark.parametrize(
    "locale",
    [
        {"LANG": "en_GB.UTF-8"},
        {"LANG": "C.utf8"},
        {"LC_CTYPE": "UTF-8"},
        {"LC_ALL": "de_DE.UTF-8@euro"},
        {"LC_ALL": "nl_BE.UTF-8", "LC_CTYPE": "C", "LANG": "C"},
        {"LC_CTYPE": "nl_BE.UTF-8", "LANG": "C"},
        {"LC_ALL": "", "LC_CTYPE": "", "LANG": "nl_BE.UTF-8"},
    ],
)
def test_braille_where_the_locale_that_counts_names_utf8(locale: dict[str, str]) -> None:
    assert terminal_of({"TERM": "xterm", **locale}).arena == "braille"


@pytest.mark.parametrize(
    "locale",
    [
        {},
        {"LANG": "C"},
        {"LANG": ""},
        {"LANG": "en_GB.ISO-8859-1"},
        {"LANG": "en_GB.UTF-16"},
        {"LC_ALL": "C", "LC_CTYPE": "en_GB.UTF-8", "LANG": "en_GB.UTF-8"},
        {"LC_CTYPE": "POSIX", "LANG": "en_GB.UTF-8"},
        {"LC_MESSAGES": "en_GB.UTF-8"},
    ],
)
def test_ascii_where_it_does_not(locale: dict[str, str]) -> None:
    assert terminal_of({"TERM": "xterm", **locale}).arena == "ascii"


@pytest.mark.parametrize("term", ["linux", "linux-16color", "dumb", "vt100", "vt220", "vt52"])
def test_ascii_on_terminals_whose_fonts_have_no_braille(term: str) -> None:
    terminal = terminal_of({**UTF8, "TERM": term})
    assert terminal.arena == "ascii"
    assert f"TERM is {term}" in terminal.note


@pytest.mark.parametrize(
    "term", ["xterm", "xterm-kitty", "tmux-256color", "vte-256color", "foot", ""]
)
def test_braille_on_others(term: str) -> None:
    assert terminal_of({**UTF8, "TERM": term}).arena == "braille"


def test_no_color_counts_if_it_is_not_empty() -> None:
    assert terminal_of(UTF8).colour
    assert terminal_of({**UTF8, "NO_COLOR": ""}).colour
    assert not terminal_of({**UTF8, "NO_COLOR": "1"}).colour
    assert not terminal_of({**UTF8, "TERM": "dumb"}).colour


def test_the_note_says_what_was_chosen_and_why() -> None:
    assert terminal_of(UTF8).note == "Braille: the locale names UTF-8"
    dumb = terminal_of({**UTF8, "TERM": "dumb"}).note
    assert dumb == "ASCII: TERM is dumb; no colours: the terminal is dumb"
    assert (
        terminal_of({"NO_COLOR": "1"}).note
        == "ASCII: no locale names UTF-8; no colours: NO_COLOR is set"
    )


@given(
    st.dictionaries(st.sampled_from(["TERM", "LANG", "LC_ALL", "LC_CTYPE", "NO_COLOR"]), st.text())
)
def test_any_environment_gives_a_note_of_one_style(environment: dict[str, str]) -> None:
    terminal = terminal_of(environment)
    assert terminal.note.startswith({"ascii": "ASCII: ", "braille": "Braille: "}[terminal.arena])
