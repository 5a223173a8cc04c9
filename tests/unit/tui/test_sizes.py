"""Terminals of every size, in all arenas, with panels and without: a picture, or one line that says what is needed."""

from __future__ import annotations

import asyncio
from itertools import product
from pathlib import Path
from time import perf_counter, sleep

import pytest
from attrs import evolve
from textual.pilot import Pilot

from fasteroids.history import Place
from fasteroids.tui.app import Arcade
from fasteroids.tui.arena import Arena
from fasteroids.tui.camera import frame
from fasteroids.tui.canvas import SURFACES
from fasteroids.tui.chronicle import chronicle_of
from fasteroids.tui.launching import SceneGame, launched
from fasteroids.tui.overlay import overlay
from fasteroids.tui.panels import Rows
from fasteroids.tui.picture import View, film, look_of, pane, status, told, too_small
from fasteroids.tui.session import Session, beat, look
from fasteroids.tui.settings import DEFAULTS
from tests.unit.tui.arcades import Library, arcade, flown, live, run, settled, typed

WIDTHS = (1, 2, 3, 7, 20, 39, 40, 59, 60, 80, 99, 100, 120, 200)
HEIGHTS = (1, 2, 3, 7, 11, 12, 19, 20, 24, 40, 60)
PAIR = SceneGame("pair", 1, ("shooter",))


def moments() -> dict[str, Session]:
    """A game with shots as it goes on, with a ship selected; and its past, stepped through."""
    now = launched(PAIR, Library()).session
    for _ in range(20):
        now = beat(now, 0.1)
    now = evolve(now, selected=2)
    return {"now": now, "past": look(now, Place(*now.timeline.first.place))}


@pytest.mark.parametrize("arena", SURFACES)
@pytest.mark.parametrize("when", ["now", "past"])
def test_every_size_has_a_picture_of_just_that_size(arena: str, when: str) -> None:
    session, ascii = moments()[when], arena == "ascii"
    chronicle = chronicle_of(session.timeline)
    seen = look_of(session, View(arena=arena), overlay(session.world))
    for width, height in product(WIDTHS, HEIGHTS):
        shown = frame(session.world, seen, width, height)
        strip = film(session, chronicle, max(width, 3), ascii=ascii)
        side = pane(session, chronicle, width, height)
        around = [status(session, width, ascii=ascii, note="keys: held"), told("a b", width), *side]
        texts = [*(row.text for row in shown.rows), *(row.text for row in around)]
        assert (len(shown.rows), len(side)) == (height, height)
        assert {len(text) for text in texts} == {width}, (width, height)
        assert len(strip.rows[0].text) == max(width, 3)
        assert not ascii or all(text.isascii() for text in (*texts, strip.rows[0].text))


def test_a_terminal_is_too_small_below_40_by_12() -> None:
    for width, height in product(WIDTHS, HEIGHTS):
        line = too_small(width, height)
        assert (line is None) is (width >= 40 and height >= 12)
        assert line is None or line == f"needs 40 x 12, has {width} x {height}"


def scene(app: Arcade) -> tuple[list[str], bool]:
    """The rows of the arena, and whether there is a pane beside it."""
    play = live(app)
    return [row.text for row in play.query_one(Arena).frame.rows], play.query_one("#side").display


@pytest.mark.parametrize("arena", SURFACES)
def test_the_screen_follows_the_terminal(arena: str, tmp_path: Path) -> None:
    async def resized(app: Arcade, pilot: Pilot[int]) -> None:
        flown(live(app), 1.0)
        for size in (
            (120, 40),
            (59, 19),
            (39, 12),
            (1, 1),
            (40, 11),
            (40, 12),
            (100, 20),
            (100, 19),
        ):
            await pilot.resize_terminal(*size)
            await settled(pilot)
            rows, wide = scene(app)
            lines = [
                row.text
                for name in ("status", "strip", "said")
                for row in live(app).query_one(f"#{name}", Rows).rows
            ]
            if too_small(*size):
                assert rows == [
                    f"needs 40 x 12, has {size[0]} x {size[1]}"[: size[0]].ljust(size[0])
                ]
                assert lines == []
            else:
                widget = live(app).query_one(Arena)
                assert (len(rows), {len(row) for row in rows}) == (
                    widget.size.height,
                    {widget.size.width},
                )
                assert {len(line) for line in lines} == {size[0]}
            assert wide is (size[0] >= 100 and size[1] >= 20)
        await pilot.resize_terminal(120, 40)
        for hidden in (True, False):
            await pilot.press("f3")
            await settled(pilot)
            rows, wide = scene(app)
            assert wide is not hidden
            assert {len(row) for row in rows} == {120 if hidden else 80}

    run(arcade(tmp_path, wanted=PAIR, view=View(arena=arena)), resized, size=(120, 40))


def test_frames_that_come_too_late_are_left_out_and_the_time_of_the_game_is_not(
    tmp_path: Path,
) -> None:
    async def stalled(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        frames, time = play.frames, play.session.world.time
        sleep(0.2)  # nobody else has a turn meanwhile: six frames are due
        start = perf_counter()
        for _ in range(8):
            await asyncio.sleep(0)
        assert play.frames - frames <= 2 + 30 * (perf_counter() - start)
        while play.frames - frames < 3:
            await pilot.pause(0.01)
        assert play.session.world.time - time >= 0.2

    settings = evolve(DEFAULTS, fps=30)
    run(arcade(tmp_path, wanted=PAIR, settings=settings, timer=True), stalled)


def test_nothing_is_drawn_while_time_stands_still(tmp_path: Path) -> None:
    async def paused(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        await typed(pilot, "p")
        frames = play.frames
        flown(play, 1.0)
        assert play.frames == frames
        await typed(pilot, "e")
        assert play.frames == frames + 1
        await typed(pilot, "p")
        flown(play, 0.5)
        assert play.frames > frames + 4

    run(arcade(tmp_path, wanted=PAIR), paused)
