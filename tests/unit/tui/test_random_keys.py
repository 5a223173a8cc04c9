"""Whatever is typed, clicked, pasted or resized, in whatever order, the app lives and the session makes sense.

What happens is drawn from a seed. If something breaks, the test tells all that was done up to there.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest
from hypothesis import settings
from textual import events
from textual.keys import _character_to_key
from textual.message import Message
from textual.pilot import Pilot

from fasteroids.history.recording import read, verified
from fasteroids.tui.app import Arcade
from fasteroids.tui.keeping import recordings
from fasteroids.tui.keyboard import KeyAgain, KeyboardReport, KeyUp
from fasteroids.tui.keys import PRESETS, Command
from fasteroids.tui.launching import NewGame, SceneGame, Wanted
from fasteroids.tui.session import Session
from tests.unit.tui.arcades import arcade, run, settled

STEPS = 10_000 if settings().max_examples > 1_000 else 400
TOGETHER = 12  # what is done before it has its effect, at most
STARTS: dict[str, Wanted | None] = {
    "start": None,
    "waves": NewGame("waves", (None,), 5),
    "duel": NewGame("duel", (None, "shooter"), 6),
    "programs": SceneGame("pair", 0, ("shooter", "shooter")),
}

LEAVING = {key for c in (Command.QUIT, Command.BACK) for key in PRESETS["arrows"][c]}
COMMANDS = sorted({key for keys in PRESETS["arrows"].values() for key in keys} - LEAVING)
OTHERS = (
    "enter",
    "tab",
    "backspace",
    "delete",
    "home",
    "end",
    "pageup",
    "pagedown",
    "f1",
    "escape",
    "ctrl+c",
    "ctrl+z",
    "ignore",
    "é",
)
TEXTS = (
    "",
    "x",
    "1.5",
    "velocity of #1 changes",
    "fire;\nskip;\n",
    "\x1b[31m\x00",
    "é 界 \u202e",
    "9" * 400,
)
SIZES = ((1, 1), (39, 11), (40, 12), (59, 19), (60, 20), (80, 24), (100, 32), (120, 40), (200, 60))


def deeds(random: Random, columns: int, rows: int) -> Iterator[Message | tuple[int, int] | float]:
    """What a user does next: events, another size of the terminal, or nothing for some seconds."""
    kind = random.random()
    if kind < 0.60:
        key = random.choice(COMMANDS if random.random() < 0.8 else OTHERS)
        yield _pressed(random, key)
    elif kind < 0.68:
        letter = chr(random.randrange(33, 127))
        yield events.Key(_character_to_key(letter), letter)
    elif kind < 0.73:
        yield KeyUp(random.choice(COMMANDS))
    elif kind < 0.74:
        yield KeyboardReport(random.choice((0, 3)))
    elif kind < 0.77:
        yield events.Paste(random.choice(TEXTS))
    elif kind < 0.80:
        yield random.choice((*SIZES, (random.randint(1, 200), random.randint(1, 60))))
    elif kind < 0.81:
        yield random.choice((events.AppBlur, events.AppFocus))()
    elif kind < 0.90:
        yield from _clicked(random, columns, rows)
    else:
        yield random.choice((0.0, 1 / 60, 1 / 30, 0.1, 0.25, 10.0))


def _pressed(random: Random, key: str) -> events.Key:
    character = key if len(key) == 1 else " " if key == "space" else None
    return (KeyAgain if random.random() < 0.1 else events.Key)(key, character)


def _clicked(random: Random, columns: int, rows: int) -> Iterator[Message]:
    x, y = random.randrange(columns), random.randrange(rows)
    kinds: tuple[type[events.MouseEvent], ...] = (
        events.MouseMove,
        events.MouseDown,
        events.MouseUp,
    )
    if random.random() < 0.3:
        kinds = (random.choice((events.MouseScrollUp, events.MouseScrollDown, events.MouseMove)),)
    for kind in kinds:
        yield kind(None, x, y, 0, 0, random.choice((1, 1, 3)), False, False, False, x, y)


def told(deed: Message | tuple[int, int] | float) -> str:
    """A deed in a word."""
    match deed:
        case events.Key():
            return f"{type(deed).__name__} {deed.key}"
        case KeyUp():
            return f"KeyUp {deed.key}"
        case events.MouseEvent():
            return f"{type(deed).__name__} {deed.x},{deed.y}"
        case events.Paste():
            return f"Paste {deed.text!r}"
    return repr(deed)


def sane(session: Session) -> None:
    """It looks at a moment of its past, and the game of that moment is known."""
    timeline, place = session.timeline, session.place
    assert timeline.first.place <= place <= timeline.last.place
    assert session.world.now <= timeline.world.now
    assert timeline.first.world.now <= session.world.now
    assert session.game is session.games[timeline.name][-1][1] or not session.live
    assert session.running in (-1, 0, 1)
    assert session.fate is None or session.at is not None
    assert timeline.name in timeline.lines


async def lived(app: Arcade, pilot: Pilot[int], random: Random, steps: int, done: list[str]) -> int:
    """Do so many random things, or until the app is left; how many were done."""
    count = 0
    while count < steps and app.return_value is None:
        for _ in range(random.randint(1, TOGETHER)):
            for deed in deeds(random, *app.size):
                count += 1
                done.append(told(deed))
                if isinstance(deed, float):
                    await pilot.pause()
                    if app.playing is not None and app.playing.is_active:
                        app.playing.go_on(deed)
                elif isinstance(deed, tuple):
                    await pilot.resize_terminal(*deed)
                else:
                    app.post_message(deed)
        await settled(pilot) if app.return_value is None else None
        if app.playing is not None:
            sane(app.playing.session)
    return count


@pytest.mark.parametrize("start", STARTS)
def test_nothing_that_is_done_in_any_order_breaks_a_game(start: str, tmp_path: Path) -> None:
    random, left = Random(f"keys {start}"), STEPS // len(STARTS)
    done: list[str] = []
    while left > 0:
        app = arcade(tmp_path, wanted=STARTS[start])

        async def scenario(app: Arcade, pilot: Pilot[int]) -> None:
            nonlocal left
            left -= await lived(app, pilot, random, left, done)

        try:
            run(app, scenario, size=random.choice(SIZES))
        except BaseException:
            print(f"{start}, after {len(done)} deeds:", *done, sep="\n  ")
            raise
        assert app.return_value in (None, 0)
        done.append("-- the app was left")
    for file in recordings(tmp_path / "recordings"):
        assert verified(read(file.read_bytes())).difference is None
