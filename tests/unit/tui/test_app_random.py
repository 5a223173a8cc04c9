"""Whatever is typed, pasted and resized, the app goes on."""

from __future__ import annotations

import os
import random
from pathlib import Path
from typing import Final

import pytest
from textual import events
from textual.pilot import Pilot

from fasteroids.tui.app import Arcade
from fasteroids.tui.keyboard import KeyAgain, KeyUp
from fasteroids.tui.keys import preset
from fasteroids.tui.recent import briefs
from tests.unit.tui.arcades import arcade, run, settled

EVENTS: Final = 10_000 if os.environ.get("FASTEROIDS_PROFILE") == "long" else 100

KEYS: Final = (
    *(key for keys in preset().keys.values() for key in keys),
    *("enter", "enter", "enter", "down", "down", "escape", "tab", "backspace", "delete"),
    *("ctrl+c", "ctrl+z", "q", "é", "ignore"),
)
PASTES: Final = ("hello", "\x1b[31m\n" * 10, "/nowhere", "", "\0")


@pytest.mark.parametrize("seed", [1, 2])
def test_random_keys_pastes_and_sizes_leave_the_app_alive(
    tmp_path: Path, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    draw = random.Random(seed)
    ends: list[int] = []

    def one(app: Arcade) -> events.Event:
        kind = draw.random()
        key = draw.choice(KEYS)
        if kind < 0.7:
            return events.Key(key, key if len(key) == 1 else None)
        if kind < 0.85:
            return KeyAgain(key, None)
        return KeyUp(key) if kind < 0.95 else events.Paste(draw.choice(PASTES))

    async def type_on(app: Arcade, pilot: Pilot[int]) -> None:
        monkeypatch.setattr(app, "exit", lambda *_, **__: ends.append(1))
        for number in range(EVENTS):
            app.post_message(one(app))
            if number % 10 == 0:
                await pilot.resize_terminal(draw.randint(1, 150), draw.randint(1, 50))
            if draw.random() < 0.2:
                await pilot.pause()
            play = app.playing
            if play is not None and play.is_active:
                play.go_on(0.1)
        await settled(pilot)
        assert app.is_running
        assert app.return_code is None

    run(arcade(tmp_path), type_on)
    assert all(each.seconds is not None for each in briefs(tmp_path / "recordings"))
