"""The start screen: each of its choices leads into a game and back, and errors are sentences."""

from __future__ import annotations

from pathlib import Path

import pytest
from textual.pilot import Pilot
from textual.widgets import Input

from fasteroids.cli._arcade import Shelf
from fasteroids.tui.app import Arcade
from fasteroids.tui.boxes import Tell
from fasteroids.tui.launching import NewGame
from fasteroids.tui.lists import Choices
from fasteroids.tui.play import Play
from fasteroids.tui.recent import briefs
from fasteroids.tui.start import TITLE, Start
from tests.unit.tui.arcades import arcade, chosen, flown, live, run, settled, text, typed


@pytest.mark.parametrize("size", [(80, 24), (40, 12), (60, 20), (200, 60), (20, 5), (1, 1)])
def test_it_shows_its_title_and_every_choice_where_there_is_room(
    tmp_path: Path, size: tuple[int, int]
) -> None:
    async def look(app: Arcade, pilot: Pilot[int]) -> None:
        shown = text(app)
        if size[0] >= 40 and size[1] >= 12:
            title = TITLE if size[0] >= 60 else "F A S T E R O I D S"
            assert shown[0].strip() == title.split("\n")[0].strip()
            assert {"> One player", "  Quit"} <= {line[:12].rstrip() for line in shown}
        assert all(line.isascii() and len(line) <= size[0] for line in shown)
        await typed(pilot, "up", "up", "down", "pagedown", "home", "end")
        assert any(line.startswith("> Quit"[: size[0]]) for line in text(app))

    run(arcade(tmp_path), look, size=size)


@pytest.mark.parametrize(
    ("steps", "mode", "players"),
    [
        (["One player"], "waves", [("you", True)]),
        (["Two players"], "duel", [("one", True), ("two", True)]),
        (["Against a program", "sitter"], "duel", [("you", True), ("sitter", False)]),
        (
            ["Programs against each other", "shooter", "sitter"],
            "duel",
            [("shooter", False), ("sitter", False)],
        ),
        (
            ["Programs against each other", "sitter", "sitter"],
            "duel",
            [("sitter", False), ("sitter 2", False)],
        ),
        (
            ["Load a scene", "pair", "You fly the first ship"],
            "duel",
            [("west", True), ("east", False)],
        ),
        (
            ["Load a scene", "pair", "Two players fly the first two"],
            "duel",
            [("west", True), ("east", True)],
        ),
        (["Load a scene", "pair", "You look on"], "free", [("east", False)]),
    ],
)
def test_each_choice_leads_into_a_game_and_esc_back_and_out(
    tmp_path: Path, steps: list[str], mode: str, players: list[tuple[str, bool]]
) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        for step in steps:
            await chosen(app, pilot, step)
        game = live(app).session.game
        assert (game.mode, [(p.name, p.human) for p in game.players]) == (mode, players)
        assert f"seed {live(app).session.world.seed}" in text(app)
        flown(live(app), 0.5)
        assert live(app).session.world.time == pytest.approx(0.5)
        await typed(pilot, "escape")
        assert isinstance(app.screen, Start)
        assert app.is_running
        await typed(pilot, "escape")

    app = run(arcade(tmp_path), play)
    assert app.return_value == 0
    [brief] = briefs(tmp_path / "recordings")
    assert brief.whole
    assert brief.seconds == pytest.approx(0.5)


def test_a_mouse_is_as_good_as_keys(tmp_path: Path) -> None:
    async def click(app: Arcade, pilot: Pilot[int]) -> None:
        await pilot.click(Choices, offset=(5, 2))
        await settled(pilot)
        await pilot.click(Choices, offset=(5, 1))
        await settled(pilot)
        assert [p.name for p in live(app).session.game.players] == ["you", "sitter"]

    run(arcade(tmp_path), click)


def test_seeds_are_new_each_time_but_for_the_one_that_was_asked_for(tmp_path: Path) -> None:
    seeds = []

    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        for _ in range(4):
            await chosen(app, pilot, "One player")
            seeds.append(live(app).session.world.seed)
            await typed(pilot, "escape")

    run(arcade(tmp_path, seed=42), play)
    assert seeds[0] == 42
    assert len(set(seeds)) > 2


def test_esc_goes_back_one_question_at_a_time(tmp_path: Path) -> None:
    async def ask(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Programs against each other")
        await chosen(app, pilot, "shooter")
        assert "Which one is against shooter?" in " ".join(text(app))
        await typed(pilot, "escape")
        assert isinstance(app.screen, Start)

    run(arcade(tmp_path), ask)


async def answered(app: Arcade, pilot: Pilot[int], path: str) -> None:
    """Choose a file, by its path."""
    await chosen(app, pilot, "a file ...")
    app.screen.query_one(Input).value = path
    await typed(pilot, "enter")


def test_the_errors_of_a_program_are_shown_as_a_report(tmp_path: Path) -> None:
    async def ask(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Against a program")
        await answered(app, pilot, str(tmp_path / "bad.ast"))
        assert isinstance(app.screen, Tell)
        assert "bad.ast:1:1 error FA101" in text(app)
        await typed(pilot, "escape")
        assert isinstance(app.screen, Start)

    run(arcade(tmp_path), ask)


@pytest.mark.parametrize("path", ["-", "~nobody-at-all/x", "a" * 300, "x\0y", "."])
def test_odd_paths_are_told_in_a_sentence(tmp_path: Path, path: str) -> None:
    async def ask(app: Arcade, pilot: Pilot[int]) -> None:
        for kind in ("Load a scene", "Load a recording"):
            await chosen(app, pilot, kind)
            await answered(app, pilot, path)
            if kind == "Load a scene":
                await typed(pilot, "enter")
            assert isinstance(app.screen, Tell)
            await typed(pilot, "enter")
            assert isinstance(app.screen, Start)

    app = arcade(tmp_path)
    app._library = Shelf()
    run(app, ask, size=(200, 24))


def test_ctrl_c_tells_how_to_leave(tmp_path: Path) -> None:
    async def leave(app: Arcade, pilot: Pilot[int]) -> None:
        told: list[str] = []
        app.tell = told.append  # type: ignore[method-assign, assignment]
        await typed(pilot, "ctrl+c")
        await chosen(app, pilot, "One player")
        await typed(pilot, "ctrl+c")
        assert told == ["Ctrl+Q or Esc on the start screen quits"] * 2

    run(arcade(tmp_path), leave)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [(None, "No such file"), (b"", "the file is empty"), (b"{}\n", "line 1"), (b"\xff\n", "UTF-8")],
)
def test_a_recording_that_cannot_be_read_is_told_in_a_sentence(
    tmp_path: Path, content: bytes | None, sentence: str
) -> None:
    place = tmp_path / "odd.fast.jsonl"
    if content is not None:
        place.write_bytes(content)

    async def ask(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Load a recording")
        await answered(app, pilot, str(place))
        assert isinstance(app.screen, Tell)
        assert sentence in " ".join(text(app))

    run(arcade(tmp_path), ask, size=(160, 24))


def test_a_recording_is_looked_at_again_and_taken_over(tmp_path: Path) -> None:
    async def first(app: Arcade, pilot: Pilot[int]) -> None:
        flown(live(app), 3.0)
        await typed(pilot, "b", "escape")

    run(arcade(tmp_path, wanted=NewGame("waves", (None,), 7)), first)

    async def again(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Load a recording")
        assert "waves: you" in " ".join(text(app))
        await typed(pilot, "enter")
        play = live(app)
        assert not play.session.live
        assert play.session.game.mode == "waves"
        assert play.session.timeline.world.time == pytest.approx(3.0)
        assert list(play.session.timeline.bookmarks) == ["1"]
        await typed(pilot, "shift+right", "shift+right")
        assert play.session.game.wave == 1
        await typed(pilot, "t")
        flown(play, 0.5)
        assert play.session.world.time == pytest.approx(2.5)

    run(arcade(tmp_path), again)
    assert len(briefs(tmp_path / "recordings")) == 1  # a look is not recorded again


def test_typing_finds_a_program(tmp_path: Path) -> None:
    async def ask(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Against a program")
        await typed(pilot, "s", "i", "t")
        await typed(pilot, "enter")
        assert [p.name for p in live(app).session.game.players] == ["you", "sitter"]

    run(arcade(tmp_path), ask)


def test_a_window_is_a_frame_in_the_middle(tmp_path: Path) -> None:
    async def look(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        spots = {each.id: each.region for each in play.query("#status, #middle, #strip, #said")}
        assert {spot.width for spot in spots.values()} == {100}
        assert (spots["status"].x, spots["status"].y) == (30, 9)
        assert spots["said"].bottom == 9 + 32
        await pilot.resize_terminal(90, 30)
        await settled(pilot)
        assert play.query_one("#status").region.width == 90

    run(arcade(tmp_path, wanted=NewGame("waves", (None,), 1), window=True), look, size=(160, 50))


def test_nothing_is_written_without_a_folder(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "One player")
        flown(live(app), 0.5)
        await typed(pilot, "f12")
        assert isinstance(app.screen, Play)

    run(arcade(tmp_path, folder=None), play)
    assert not list(tmp_path.iterdir())
