"""The kitty keyboard protocol with event types, on top of Textual's parser and driver.

A terminal that speaks the protocol (https://sw.kovidgoyal.net/kitty/keyboard-protocol/) sends for each key
`CSI code ; modifiers : type ; text u` (or another last character), where type is 1 for down, 2 for a repeat, 3 for up.
Textual 8 asks for all but the types, and its parser takes none. Here the type is taken out, Textual reads the rest, and
what it finds is passed on as a key, a `KeyAgain` or a `KeyUp`.

Private names of Textual that are used: `XTermParser._sequence_to_key_events`, the arguments of `XTermParser`, and of
`LinuxDriver` the attributes `fileno`, `exit_event`, `_app`, `_file` and `_debug`. `check` tries those that are not only
handed on, for `chosen_driver`.
"""

from __future__ import annotations

import atexit
import os
import re
from codecs import getincrementaldecoder
from collections.abc import Iterable, Iterator
from contextlib import suppress
from selectors import EVENT_READ, DefaultSelector
from typing import Any, Final, TextIO

from textual import events
from textual._xterm_parser import XTermParser
from textual.drivers.linux_driver import LinuxDriver
from textual.keys import Keys
from textual.message import Message

from fasteroids.tui.keyboard import KeyAgain, KeyboardReport, KeyUp

__all__ = ["RESTORED", "KittyDriver", "KittyParser", "check"]

_KEY: Final = re.compile(
    r"""\x1b\[
        (?P<code>\d{0,7}) (?P<others>(?::\d{0,7}){0,2})
        (?: ; (?P<modifiers>\d{0,4}) (?: : (?P<type>\d?) )? (?P<text> ; [\d:]* )? )?
        (?P<end>[u~A-FHPQRS])""",
    re.VERBOSE,
)
_REPORT: Final = re.compile(r"\x1b\[\?(\d{1,4})u")
_DOWN, _AGAIN, _UP = "1", "2", "3"

_MOST_DOWN: Final = 32  # keys remembered as down; more than fingers

HUNG_UP: Final = 129
"""The exit code of what its terminal ends: 128 and the number of SIGHUP."""

ASK: Final = "\x1b[=2;2u\x1b[?u"
"""Adds event types to what Textual asked for, and asks what is on. Textual's own end takes both back."""

RESTORED: Final = (
    "\x1b[<u\x1b[?1000l\x1b[?1002l\x1b[?1003l\x1b[?1006l\x1b[?1015l\x1b[?1016l\x1b[?2004l\x1b[?2048l\x1b[?1004l"
    "\x1b[?7h\x1b[?1049l\x1b[?25h\x1b[0m"
)
"""A terminal as it was: no protocol of keys, no mouse, no brackets around a paste, the first screen, a cursor."""


class KittyParser(XTermParser):
    """Textual's parser, which also reads types of events and the report of the protocol.

    It never raises for what a terminal sends: a sequence that Textual cannot read becomes no key at all.
    """

    def __init__(self, debug: bool = False) -> None:
        self._down: dict[str, str] = {}
        super().__init__(debug)

    def _sequence_to_key_events(self, sequence: str, alt: bool = False) -> Iterator[events.Key]:
        if report := _REPORT.fullmatch(sequence):
            yield KeyboardReport(int(report[1]))  # type: ignore[misc]  # passed on as it is
        elif match := _KEY.fullmatch(sequence):
            yield from self._keys(sequence, match)
        else:
            yield from self._plain(sequence, alt)

    def _plain(self, sequence: str, alt: bool = False) -> list[events.Key]:
        """What Textual makes of a sequence. It raises for numbers that are no characters, and for lists of them."""
        try:
            return list(super()._sequence_to_key_events(sequence, alt))
        except (ValueError, OverflowError):
            return [events.Key(Keys.Ignore, None)]

    def _keys(self, sequence: str, match: re.Match[str]) -> Iterator[events.Key]:
        kind = match["type"] or _DOWN
        if match["type"] is not None or match["others"]:
            modifiers = "" if match["modifiers"] is None else f";{match['modifiers']}"
            sequence = f"\x1b[{match['code']}{modifiers}{match['text'] or ''}{match['end']}"
        place = f"{match['code'] or 1}{match['end']}"
        # For a key that Textual does not know something must be passed on, or its bytes come back as typed letters.
        keys = self._plain(sequence) or [events.Key(Keys.Ignore, None)]
        if kind == _UP:
            name = self._down.pop(place, keys[0].key)
            yield keys[0] if name == Keys.Ignore else KeyUp(name)  # type: ignore[misc]  # as it is
            return
        self._down[place] = keys[0].key
        if len(self._down) > _MOST_DOWN:
            del self._down[next(iter(self._down))]
        for key in keys:
            yield KeyAgain(key.key, key.character) if kind == _AGAIN else key


class Lasting:
    """A stream for text that takes whatever is written to it, also when the terminal behind it is gone.

    Textual's thread that writes would end with the error, and the app then wait for it for ever.
    """

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write, if there is still somewhere to write to."""
        with suppress(OSError, ValueError):
            return self._stream.write(text)
        return len(text)

    def flush(self) -> None:
        """Hand over what was written, if there is still somewhere."""
        with suppress(OSError, ValueError):
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


class KittyDriver(LinuxDriver):
    """Textual's driver for terminals, which asks for the types of events too.

    The end of the terminal is the end of the app, with the exit code of a hang-up.

    The question only adds to what Textual puts on the stack of the terminal, so all ends that restore Textual's part
    restore this one. At an exit of Python that Textual does not see, the terminal is restored nevertheless.
    """

    def __init__(self, *args: Any, **settings: Any) -> None:
        super().__init__(*args, **settings)
        if self._file is not None:
            self._file = Lasting(self._file)  # type: ignore[assignment]  # all that is used of one

    def start_application_mode(self) -> None:
        """Textual's start, then the question."""
        super().start_application_mode()  # type: ignore[no-untyped-call]
        if getattr(self, "_writer_thread", None) is None:
            return  # in the background: Textual has not started either
        self.write(ASK)
        self.flush()
        atexit.register(self._restore)

    def stop_application_mode(self) -> None:
        """Textual's end."""
        super().stop_application_mode()
        atexit.unregister(self._restore)

    def _restore(self) -> None:
        with suppress(OSError, ValueError):
            os.write(self.fileno, RESTORED.encode())

    def run_input_thread(self) -> None:
        """Read what the terminal sends until the end. Bytes that are no UTF-8 become the sign for that."""
        parser = KittyParser(self._debug)
        decode = getincrementaldecoder("utf-8")("replace").decode
        with DefaultSelector() as selector:
            selector.register(self.fileno, EVENT_READ)
            while not self.exit_event.is_set():
                if selector.select(0.1):
                    try:
                        data = os.read(self.fileno, 4096)
                    except OSError:  # the terminal is gone
                        data = b""
                    if not data:
                        self._app.call_later(self._app.exit, HUNG_UP)
                        break
                    self._pass_on(parser.feed(text) if (text := decode(data)) else ())
                self._pass_on(parser.tick())

    def _pass_on(self, messages: Iterable[Message]) -> None:
        for message in messages:
            self.process_message(message)


def check() -> None:
    """Does the parser read with this version of Textual what it was written for? `AssertionError` or worse if not."""
    parser = KittyParser()
    read = [*parser.feed("\x1b[97;1:1;97u"), *parser.feed("\x1b[97;1:2;97u\x1b[97;1:3u\x1b[?27u")]
    down, again, up, report = read
    if not (
        (type(down), getattr(down, "key", "")) == (events.Key, "a")
        and isinstance(again, KeyAgain)
        and (isinstance(up, KeyUp) and up.key == "a")
        and isinstance(report, KeyboardReport)
        and {"run_input_thread", "process_message", "start_application_mode"}
        <= set(dir(LinuxDriver))
    ):
        raise AssertionError(read)
