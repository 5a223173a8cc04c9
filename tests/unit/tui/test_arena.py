"""The widget: it shows what a frame says, in the colours of the palette, and does nothing where nothing moved."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Awaitable, Callable

import pytest
from textual.app import App, ComposeResult
from textual.geometry import Region
from textual.widget import Widget

from fasteroids import Asteroid, Ship, World, evolve
from fasteroids.tui import palette
from fasteroids.tui.arena import Arena
from fasteroids.tui.camera import Frame, Look, frame
from fasteroids.tui.canvas import Cells

WORLD = World(1000, 700).add_all(
    [
        Ship(300, 300, 0, 0, 30, 5e15, 0.0),
        Ship(700, 300, 0, 0, 30, 5e15, 0.0),
        Asteroid(300, 600, 100, 0, 60),
    ]
)

DEFAULT = "c5c8c6"
"""What an SVG of Textual's paints text with that has no colour: blanks."""


class Shown(App[None]):
    """An application that is nothing but an arena."""

    def compose(self) -> ComposeResult:
        yield Arena()


def showing(
    scenario: Callable[[Shown, Arena], Awaitable[None]], size: tuple[int, int] = (60, 20)
) -> None:
    """Run a scenario in an application of this size."""

    async def run() -> None:
        app = Shown()
        async with app.run_test(size=size) as pilot:
            arena = app.query_one(Arena)
            await scenario(app, arena)
            await pilot.pause()

    asyncio.run(run())


def lines(arena: Arena) -> list[str]:
    return [arena.render_line(y).text for y in range(arena.size.height)]


def picture(arena: Arena, world: World = WORLD, kind: str = "ascii") -> Frame:
    return frame(world, Look(arena=kind), arena.content_size.width, arena.content_size.height)


@pytest.mark.parametrize("kind", ["ascii", "braille", "block"])
def test_the_widget_shows_the_rows_of_its_frame(kind):
    async def scenario(app: Shown, arena: Arena) -> None:
        shown = picture(arena, kind=kind)
        assert arena.show(shown)
        assert lines(arena) == [row.text for row in shown.rows]
        assert (arena.content_size.width, arena.content_size.height) == (60, 20)
        assert "A" in app.export_screenshot()

    showing(scenario)


def test_each_run_has_its_colour_and_takes_the_blanks_beside_it():
    async def scenario(_app: Shown, arena: Arena) -> None:
        blank = Cells(" " * 60, ())
        arena.show(Frame(60, (Cells("  a b" + " " * 55, ((2, 3, 2), (4, 5, 10))), blank)))
        segments = [(s.text, s.style) for s in arena.render_line(0)]
        assert [text for text, _ in segments] == ["  a ", "b" + " " * 55]
        inks = [style.color.triplet.hex for _, style in segments]  # type: ignore[union-attr]
        assert inks == [palette.COLOURS[2].hex, palette.COLOURS[10].hex]
        for segment in (*arena.render_line(0), *arena.render_line(1)):
            assert segment.style.bgcolor.triplet.hex == palette.BACKGROUND

    showing(scenario)


def test_an_equal_frame_is_not_drawn_again(monkeypatch):
    refreshed = []

    async def scenario(_app: Shown, arena: Arena) -> None:
        arena.show(picture(arena))
        monkeypatch.setattr(arena, "refresh", lambda *_, **__: refreshed.append(1))
        assert not arena.show(picture(arena))
        assert refreshed == []
        assert arena.show(picture(arena, evolve(WORLD, 2.0)))
        assert refreshed == [1]
        assert arena.frame == picture(arena, evolve(WORLD, 2.0))

    showing(scenario)


def test_a_row_that_stays_keeps_its_strip():
    async def scenario(_app: Shown, arena: Arena) -> None:
        before, after = picture(arena), picture(arena, evolve(WORLD, 2.0))
        arena.show(before)
        strips = [arena.render_line(y) for y in range(20)]
        arena.show(after)
        for y in range(20):
            assert (arena.render_line(y) is strips[y]) == (before.rows[y] == after.rows[y])
        assert 0 < sum(before.rows[y] == after.rows[y] for y in range(20)) < 20

    showing(scenario)


def test_a_frame_of_another_size_is_cut_or_filled_up():
    async def scenario(_app: Shown, arena: Arena) -> None:
        for columns, rows in ((30, 8), (90, 40), (0, 0)):
            arena.show(frame(WORLD, Look(), columns, rows))
            shown = lines(arena)
            assert [len(line) for line in shown] == [60] * 20
            for line, row in zip(shown, arena.frame.rows, strict=False):
                assert line == row.text[:60].ljust(60)
            assert not "".join(shown[rows:]).strip()

    showing(scenario)


@pytest.mark.parametrize("plain", [True, False])
def test_the_lines_are_those_that_textual_would_show(monkeypatch, plain):
    if plain:
        monkeypatch.setenv("NO_COLOR", "1")
    else:
        monkeypatch.delenv("NO_COLOR", raising=False)

    async def scenario(_app: Shown, arena: Arena) -> None:
        arena.show(frame(WORLD, Look(), 50, 15))
        for crop in (Region(0, 0, 60, 20), Region(0, 3, 60, 1), Region(17, 2, 20, 18)):
            ours = [list(strip) for strip in arena.render_lines(crop)]
            assert ours == [list(strip) for strip in Widget.render_lines(arena, crop)]
            assert [sum(len(segment.text) for segment in line) for line in ours] == [
                crop.width
            ] * crop.height

    showing(scenario)


def test_a_picture_places_every_word_by_itself():
    async def scenario(app: Shown, arena: Arena) -> None:
        arena.show(Frame(60, (Cells("  ab b" + " " * 54, ((2, 3, 2), (3, 6, 10))),)))
        shown = arena.render_line(0)
        before = app.export_screenshot()
        with arena.posing():
            cut = arena.render_line(0)
            during = app.export_screenshot()
        assert [s.text for s in cut] == ["  ", "a", "b", " ", "b", " " * 54]
        assert cut.text == shown.text
        assert ">b</text>" in during
        assert ">b</text>" not in before
        assert list(arena.render_line(0)) == list(shown)

    showing(scenario)


@pytest.mark.parametrize("plain", [True, False])
def test_without_colours_nothing_is_coloured_and_everything_is_there(monkeypatch, plain):
    if plain:
        monkeypatch.setenv("NO_COLOR", "1")
    else:
        monkeypatch.delenv("NO_COLOR", raising=False)

    async def scenario(app: Shown, arena: Arena) -> None:
        arena.show(picture(arena))
        await asyncio.sleep(0)
        text = app.export_screenshot()
        styles = set(re.findall(r"-r\d+ \{ fill: #(\w{6})", text)) - {DEFAULT}
        colourful = [code for code in styles if len({code[:2], code[2:4], code[4:]}) > 1]
        assert styles
        assert (colourful == []) is plain
        for sign in ("A", "B", "(", "&gt;"):
            assert sign in text

    showing(scenario)
