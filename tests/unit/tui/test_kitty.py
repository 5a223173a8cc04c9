"""The kitty keyboard protocol: bytes fed to the parser, and a small app under a real pseudo-terminal."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from textual import events
from textual._xterm_parser import XTermParser
from textual.app import App
from textual.message import Message
from textual.screen import Screen

from fasteroids.tui import keyboard, kitty
from fasteroids.tui.driving import chosen_driver
from fasteroids.tui.keyboard import KeyAgain, KeyboardReport, KeyUp

ROOT = Path(__file__).resolve().parents[3]


def seen(message: Message) -> tuple[Any, ...]:
    """What a message says: its class, and the key or whatever it has."""
    match message:
        case KeyboardReport():
            return ("report", message.flags)
        case KeyUp():
            return ("up", message.key)
        case KeyAgain():
            return ("again", message.key, message.character)
        case events.Key():
            return ("down", message.key, message.character)
        case events.Paste():
            return ("paste", message.text)
        case events.MouseEvent():
            return (type(message).__name__, message.x, message.y, message.button)
    return (type(message).__name__,)


def read(*pieces: str) -> list[tuple[Any, ...]]:
    """What a new parser makes of what comes in pieces."""
    parser = kitty.KittyParser()
    return [seen(message) for piece in pieces if piece for message in parser.feed(piece)]


# Keys.


@pytest.mark.parametrize(
    ("down", "again", "up", "key", "character"),
    [
        ("\x1b[97;1:1;97u", "\x1b[97;1:2;97u", "\x1b[97;1:3u", "a", "a"),
        ("\x1b[97;;97u", "\x1b[97;1:2;97u", "\x1b[97;1:3u", "a", "a"),
        ("\x1b[D", "\x1b[1;1:2D", "\x1b[1;1:3D", "left", None),
        ("\x1b[1;1:1A", "\x1b[1;1:2A", "\x1b[1;1:3A", "up", None),
        ("\x1b[32;;32u", "\x1b[32;1:2;32u", "\x1b[32;1:3u", "space", " "),
        ("\x1b[5~", "\x1b[5;1:2~", "\x1b[5;1:3~", "pageup", None),
        ("\x1b[57442;5u", "\x1b[57442;5:2u", "\x1b[57442;1:3u", "left_control", None),
        ("\x1b[113;5:1u", "\x1b[113;5:2u", "\x1b[113;5:3u", "ctrl+q", None),
        ("\x1b[63:63;2:1;63u", "\x1b[63;2:2;63u", "\x1b[63;2:3u", "question_mark", "?"),
        ("\x1b[233;;233u", "\x1b[233;1:2;233u", "\x1b[233;1:3u", "é", "é"),
    ],
)
def test_a_key_goes_down_repeats_and_goes_up(
    down: str, again: str, up: str, key: str, character: str | None
) -> None:
    assert read(down, again, up) == [
        ("down", key, character),
        ("again", key, character),
        ("up", key),
    ]


@pytest.mark.parametrize(("code", "key"), [("27", "escape"), ("13", "enter"), ("9", "tab")])
def test_keys_that_need_no_protocol_go_up_too(code: str, key: str) -> None:
    assert [what[:2] for what in read(f"\x1b[{code}u", f"\x1b[{code};1:3u")] == [
        ("down", key),
        ("up", key),
    ]


def test_a_key_goes_up_under_the_name_it_went_down_with() -> None:
    assert read("\x1b[97;2;65u", "\x1b[97;1:3u") == [("down", "A", "A"), ("up", "A")]
    assert read("\x1b[1;5C", "\x1b[1;1:3C") == [("down", "ctrl+right", None), ("up", "ctrl+right")]
    assert read("\x1b[C", "\x1b[1;5:3C") == [("down", "right", None), ("up", "right")]


def test_two_keys_at_once_go_up_in_any_order() -> None:
    assert read("\x1b[D\x1b[97;;97u\x1b[1;1:3D\x1b[97;1:3u") == [
        ("down", "left", None),
        ("down", "a", "a"),
        ("up", "left"),
        ("up", "a"),
    ]


def test_a_key_that_was_never_seen_down_goes_up_by_its_own_name() -> None:
    assert read("\x1b[1;1:3D", "\x1b[1;2:3D") == [("up", "left"), ("up", "shift+left")]


def test_a_composed_letter_comes_whole_and_goes_up_once() -> None:
    typed = read("\x1b[101;1:1;101:769u", "\x1b[101;1:3u")
    assert [what[0] for what in typed] == ["down", "down", "up"]


def test_the_report_tells_whether_keys_that_go_up_are_reported() -> None:
    assert read("\x1b[?27u", "\x1b[?25u", "\x1b[?0u") == [
        ("report", 27),
        ("report", 25),
        ("report", 0),
    ]
    assert [KeyboardReport(flags).key_up for flags in (27, 25, 0)] == [True, False, False]


def test_terminals_without_the_protocol_are_read_as_by_textual() -> None:
    plain = "aA?é \t\r\x1b[A\x1b[1;2D\x1bOP\x1b[15~\x1b[I\x1b[O\x1b[<0;3;4M\x1b[<0;3;4m\x1b[200~two\nlines\x1b[201~\x01"
    ours, textuals = kitty.KittyParser(), XTermParser()
    assert [seen(message) for message in ours.feed(plain)] == [
        seen(message) for message in textuals.feed(plain)
    ]


# Anything, in any pieces.

PIECES = (
    "\x1b[97;1:1;97u",
    "\x1b[97;1:2;97u",
    "\x1b[97;1:3u",
    "\x1b[1;1:3D",
    "\x1b[D",
    "\x1b[57442;5:1u",
    "\x1b[57442;5:3u",
    "\x1b[?27u",
    "\x1b[<35;10;5M",
    "\x1b[<0;10;5m",
    "\x1b[200~pasted \x07 text;1:3u\x1b[201~",
    "\x1b[I",
    "\x1b[48;40;120;800;1200t",
    "\x1b[?2026;2$y",
    "q",
    "é",
)

tokens = st.lists(st.sampled_from(PIECES), max_size=8)


@given(tokens, st.data())
def test_where_the_bytes_are_split_makes_no_difference(
    parts: list[str], data: st.DataObject
) -> None:
    text = "".join(parts)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=6)))
    pieces = [text[a:b] for a, b in zip([0, *cuts], [*cuts, len(text)], strict=True)]
    assert read(*pieces) == read(text)


@given(tokens)
def test_each_piece_is_read_without_the_others(parts: list[str]) -> None:
    def names(messages: Iterable[tuple[Any, ...]]) -> list[str]:
        return [message[0] for message in messages]

    assert names(read(*parts)) == [name for part in parts for name in names(read(part))]


def test_what_is_pasted_is_never_taken_for_keys() -> None:
    assert read("\x1b[200~97;1:3u\x1b[201~") == [("paste", "97;1:3u")]


garbage = st.lists(
    st.one_of(
        st.sampled_from(
            ["\x1b", "\x1b[", ";", ":", "u", "~", "?", "<", "M", "\x00", "D", "\x1b[200~", "9" * 9]
        ),
        st.sampled_from(PIECES),
        st.integers(0, 10**8).map(str),
        st.text(max_size=4),
    ),
    max_size=30,
).map("".join)


@given(garbage)
def test_no_bytes_make_the_parser_fail_and_it_goes_on_reading(text: str) -> None:
    parser = kitty.KittyParser()
    list(parser.feed(text + "\x1b[201~" + " " * 40))
    assert [seen(message) for message in parser.feed("\x1b[1;1:3D")] == [("up", "left")]


@given(st.lists(st.integers(97, 122), max_size=100))
def test_only_a_few_keys_are_remembered_as_down(codes: list[int]) -> None:
    parser = kitty.KittyParser()
    for code in codes:
        list(parser.feed(f"\x1b[{code * 7};1:1u"))
    assert len(parser._down) <= 32


# The app.


def test_keys_that_go_up_come_to_the_screen_and_the_app() -> None:
    came: list[tuple[Any, ...]] = []

    class Looking(Screen[None]):
        def on_key_up(self, event: KeyUp) -> None:
            came.append(("screen", *seen(event)))

        def on_key(self, event: events.Key) -> None:
            came.append(("screen", *seen(event)))

        def on_keyboard_report(self, event: KeyboardReport) -> None:
            came.append(("screen", *seen(event)))

    class Small(App[None]):
        def on_mount(self) -> None:
            self.push_screen(Looking())

        def on_key_up(self, event: KeyUp) -> None:
            came.append(("app", *seen(event)))

    async def play() -> None:
        app = Small()
        async with app.run_test() as pilot:
            await pilot.pause()
            for message in (KeyAgain("a", "a"), KeyUp("left"), KeyboardReport(27)):
                app.post_message(message)
                await pilot.pause()

    import asyncio

    asyncio.run(play())
    assert came == [
        ("screen", "again", "a", "a"),
        ("screen", "up", "left"),
        ("app", "up", "left"),
        ("screen", "report", 27),
    ]


def test_the_driver_is_chosen_with_this_textual() -> None:
    assert chosen_driver() == (kitty.KittyDriver, "")


def test_a_textual_with_other_private_names_gets_its_own_driver_and_a_sentence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    class Renamed(kitty.XTermParser):  # type: ignore[name-defined, misc]
        """As if the method that is overridden had another name."""

    monkeypatch.setattr(kitty, "KittyParser", Renamed)
    assert chosen_driver() == (
        None,
        "keys that go up are not read: not with this version of Textual",
    )


def test_a_system_without_such_terminals_gets_textuals_driver_and_a_sentence(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "fasteroids.tui.kitty", None)
    monkeypatch.delattr("fasteroids.tui.kitty")
    assert chosen_driver() == (None, "keys that go up are not read: not on this system")
    assert keyboard.KeyUp("a").key == "a"


@pytest.mark.parametrize(
    ("name", "value", "variable"),
    [
        ("DRIVER", "textual.drivers.web_driver:WebDriver", "TEXTUAL_DRIVER names another driver"),
        ("DISABLE_KITTY_KEY", True, "TEXTUAL_DISABLE_KITTY_KEY is set"),
    ],
)
def test_what_the_environment_says_of_the_driver_is_respected(
    name: str, value: object, variable: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(f"textual.constants.{name}", value)
    assert chosen_driver() == (None, f"keys that go up are not read: {variable}")


# A real terminal.

APP = """
import os, signal, sys
from textual.app import App
from fasteroids.tui.driving import chosen_driver
from fasteroids.tui.keyboard import KeyAgain

class Small(App):
    def on_mount(self): os.write(1, b"READY")
    def on_key_up(self, event):
        os.write(1, f"UP={event.key};".encode())
        if event.key == "q": self.exit()
        if event.key == "x": raise ValueError("on purpose")
        if event.key == "z":
            signal.signal(signal.SIGALRM, lambda *_: sys.exit(3))
            signal.raise_signal(signal.SIGALRM)
    def on_key(self, event):
        os.write(1, f"{type(event).__name__}={event.key};".encode())
    def on_keyboard_report(self, event): os.write(1, f"REPORT={event.flags};".encode())

app = Small(driver_class=chosen_driver().driver)
app.run()
sys.exit(app.return_code)
"""


class Terminal:
    """A program under a pseudo-terminal."""

    def __init__(self, code: str) -> None:
        self.master, slave = os.openpty()
        environment = {**os.environ, "TERM": "xterm-kitty", "PYTHONPATH": str(ROOT)}
        self.program = subprocess.Popen(
            [sys.executable, "-c", code],
            stdin=slave,
            stdout=slave,
            stderr=slave,
            env=environment,
            start_new_session=True,
        )
        os.close(slave)
        self.output = b""

    def send(self, data: bytes) -> None:
        os.write(self.master, data)

    def until(self, wanted: bytes | None) -> None:
        """Read until something was shown, or the end."""
        give_up = time.monotonic() + 60
        while wanted is None or wanted not in self.output:
            assert time.monotonic() < give_up, self.output
            if select.select([self.master], [], [], 1)[0]:
                try:
                    data = os.read(self.master, 65_536)
                except OSError:  # nobody has the other side any more
                    data = b""
                if not data:
                    assert wanted is None, self.output
                    return
                self.output += data

    def close(self) -> int:
        self.until(None)
        os.close(self.master)
        return self.program.wait(60)


@pytest.mark.parametrize(("last", "code"), [(b"q", 0), (b"x", 1), (b"z", 3)])
def test_a_terminal_is_asked_for_types_read_and_left_clean_however_the_app_ends(
    last: bytes, code: int
) -> None:
    terminal = Terminal(APP)
    terminal.until(b"READY")
    terminal.send(b"\x1b[?27u\x1b[D\x1b[1;1:2D\x1b[1;1:3D\xff")
    terminal.until(b"UP=left;")
    terminal.send(b"\x1b[%d;1:3u" % ord(last))
    assert terminal.close() == code
    output = terminal.output
    for shown in (b"REPORT=27;", b"Key=left;", b"KeyAgain=left;", b"UP=left;"):
        assert shown in output
    assert output.index(b"\x1b[>25u") < output.index(b"\x1b[=2;2u") < output.index(b"\x1b[?u")
    assert output.count(b"\x1b[<u") == output.count(b"\x1b[>25u") == 1
    ending = output[output.index(b"\x1b[<u") :]
    assert b"\x1b[?1049l" in ending
    assert b"\x1b[?25h" in ending
    assert output.rindex(b"\x1b[?1003l") > output.rindex(b"\x1b[?1003h")


def test_an_app_whose_terminal_is_gone_ends() -> None:
    terminal = Terminal(
        APP.replace(
            "import os",
            "import os, signal; signal.signal(signal.SIGHUP, signal.SIG_IGN); import os",
            1,
        )
    )
    terminal.until(b"READY")
    os.close(terminal.master)
    try:
        terminal.program.wait(60)
    finally:
        if terminal.program.poll() is None:
            terminal.program.send_signal(signal.SIGKILL)
            terminal.program.wait()
