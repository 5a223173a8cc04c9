"""Whole stories in the app, told by keys: from the first screen to the last, and what is on disk afterwards."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from golden_screens import GUNS
from textual.pilot import Pilot
from textual.widgets import Input, TextArea

from fasteroids import Asteroid, Ship, World, load_scene
from fasteroids.history.recording import read, verified
from fasteroids.tui.app import Arcade
from fasteroids.tui.breakpoints import AtLine, When
from fasteroids.tui.debugging import breakpoints_of
from fasteroids.tui.editor import Breaking, Editor
from fasteroids.tui.ending import End
from fasteroids.tui.game import Game, Player, ruled
from fasteroids.tui.launching import Launched, NewGame, SceneGame
from fasteroids.tui.panels import Pane, Rows
from fasteroids.tui.session import opened
from fasteroids.tui.start import Start
from fasteroids.tui.visiting import visited
from tests.unit.tui.arcades import arcade, chosen, flown, live, run, settled, text, typed

WIDE = (120, 36)


def guns(at: float | None = None) -> Launched:
    """Two ships, of which one shoots the other after some two seconds, as `fasteroids debug` opens them."""
    world = load_scene(GUNS)
    session = visited(opened(world, ruled(world, 0)), at, "west")
    return Launched(SceneGame("guns", 0), "guns", session)


def last_life() -> Launched:
    """The last ship of a game of waves, half a second before an asteroid hits it."""
    world = World(400, 300, 9, "smooth").add_all(
        [Ship(200, 150, 0, 0, 20, 5e15, 0.0, name="you"), Asteroid(290, 150, -100, 0, 20)]
    )
    session = opened(world, Game("waves", (Player("you", 1, True, lives=1),), wave=3))
    return Launched(NewGame("waves", (None,), 9), "waves: you", session)


def faultless(home: Path, *, at_least: int = 1) -> None:
    """Every recording in the folder, lived again, is what was played."""
    found = sorted((home / "recordings").iterdir())
    assert len(found) >= at_least
    for place in found:
        recording = read(place.read_bytes())
        assert recording.short is None, place
        assert verified(recording).difference is None, place


def pane(app: Arcade) -> list[str]:
    return [row.text.rstrip() for row in live(app).query_one("#pane", Rows).rows]


async def searched(app: Arcade, pilot: Pilot[int]) -> None:
    """The search for a breakpoint to its end."""
    for _ in range(200):
        if live(app).session.seek is None:
            break
        live(app).go_on(0.03)
    await settled(pilot)
    assert live(app).session.seek is None


async def written(app: Arcade, pilot: Pilot[int], old: str, new: str) -> Editor:
    """Replace a piece of the text in the editor, and save it; the editor."""
    assert isinstance(app.screen, Editor)
    editor = app.screen
    area = editor.query_one(TextArea)
    area.text = area.text.replace(old, new)
    await typed(pilot, "ctrl+s")
    return editor


async def worked(app: Arcade, pilot: Pilot[int]) -> None:
    """The other future is lived to its end."""
    for _ in range(200):
        if not isinstance(app.screen, Editor):
            break
        app.screen.go_on()
        await pilot.pause()
    await settled(pilot)
    live(app)


# Stories.


def test_start_play_die_why_rewind_take_over_and_quit(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        flown(live(app), 2.0)
        await settled(pilot)
        assert isinstance(app.screen, End)
        await typed(pilot, "y")
        play = live(app)
        assert play.session.fate is not None
        assert any("inevitable" in line for line in pane(app))
        await typed(pilot, "home")
        assert play.session.world.time == 0.0
        await typed(pilot, "t", "up")  # away from there
        flown(play, 0.3)
        assert play.session.timeline.name == "2"
        assert play.session.game.ended is None
        await typed(pilot, "r")
        assert play.session.compared is not None
        assert any("line main:" in line for line in pane(app))
        await typed(pilot, "escape")
        assert isinstance(app.screen, Start)
        await typed(pilot, "ctrl+q")

    app = run(arcade(tmp_path, wanted=last_life()), story, size=WIDE)
    assert app.return_code == 0
    faultless(tmp_path, at_least=2)


def test_from_the_start_screen_into_a_game_against_a_program_and_through_its_program(
    tmp_path: Path,
) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Against a program")
        await chosen(app, pilot, "shooter")
        play = live(app)
        await typed(pilot, "left")
        flown(play, 1.5)
        await typed(pilot, "p", "e", "e")
        assert play.session.selected == 2
        await typed(pilot, "f7", "f7")
        assert play.session.point is not None
        assert any("program: running" in line for line in pane(app))
        back = play.session.place
        await typed(pilot, "f8", "f8", "f8")
        assert play.session.place > back
        await typed(pilot, "end", "p")
        flown(play, 0.5)
        assert play.session.live

    run(arcade(tmp_path), story, size=WIDE)
    faultless(tmp_path)


def test_a_program_is_stepped_and_run_to_breakpoints_both_ways(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        assert any("ship 'west' program" in line for line in pane(app))
        await typed(pilot, "f8", "f8", "f8", "f9")
        assert play.session.point is not None
        assert play.session.point.statement.line == 4
        assert breakpoints_of(play.session, 1) == (AtLine(4),)
        assert any(line.startswith("*>4") for line in pane(app))
        await typed(pilot, "f5")
        await searched(app, pilot)
        assert play.session.said.startswith("breakpoint, line 4 at 0.6 s")
        await typed(pilot, "f5")
        await searched(app, pilot)
        await typed(pilot, "f4", "f4")
        await searched(app, pilot)
        assert play.session.said.startswith("breakpoint, line 4 at 0.2 s")

    run(arcade(tmp_path, wanted=guns()), story, size=WIDE)
    faultless(tmp_path)


def test_a_breakpoint_on_a_condition_is_asked_for_and_its_faults_are_told(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "f10", *"m == 4", "enter")
        assert isinstance(app.screen, Breaking)
        assert any("`m` is not declared" in line for line in text(app))
        app.screen.query_one(Input).value = "n == 5"
        await typed(pilot, "enter")
        play = live(app)
        [mark] = breakpoints_of(play.session, 1)
        assert isinstance(mark, When)
        assert "* when n == 5" in pane(app)
        await typed(pilot, "f5")
        assert play.session.seek is not None
        await searched(app, pilot)
        assert play.session.said.endswith(": n == 5")
        await typed(pilot, "f10", "escape")
        assert live(app).session.breakpoints == play.session.breakpoints

    run(arcade(tmp_path, wanted=guns()), story, size=WIDE)


def test_esc_stops_a_search_and_does_not_leave_the_game(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "f10", *"n == 900", "enter", "f5")
        play = live(app)
        for _ in range(5):
            play.go_on(0.03)
        assert play.session.said.endswith("Esc stops")
        await typed(pilot, "escape")
        assert live(app).session.seek is None
        time = play.session.place.time
        play.go_on(0.03)
        assert play.session.place.time == time > 0.5
        await typed(pilot, "escape")
        assert isinstance(app.screen, Start)

    run(arcade(tmp_path, wanted=guns()), story, size=WIDE)


def test_a_program_is_edited_and_its_first_difference_is_shown(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        await typed(pilot, "pageup", "f2")
        await written(app, pilot, "fire; }", "firre; }")
        assert isinstance(app.screen, Editor)
        assert not app.screen.working
        assert any(line.startswith("line 5, column 16: ") for line in text(app)), text(app)
        assert app.screen.query_one(TextArea).cursor_location == (4, 15)
        await written(app, pilot, "firre; }", "thrust; }")
        await worked(app, pilot)
        assert play.session.timeline.name == "2"
        assert play.session.world.time == pytest.approx(2.0)
        assert "lines main and 2" in pane(app)
        assert any(line.startswith("They part at 2.200 s") for line in pane(app))
        assert any("thrust; }" in line for line in pane(app))
        await typed(pilot, "enter")
        side = play.query_one(Pane)
        assert side.chosen is not None
        place = side.rows[side.chosen].place
        assert place is not None
        await typed(pilot, "down", "up", "enter", "escape")
        assert side.chosen is None
        assert play.session.place == place
        await typed(pilot, "r")
        assert "lines main and 2" not in pane(app)

    run(arcade(tmp_path, wanted=guns(3.0)), story, size=WIDE)
    faultless(tmp_path, at_least=2)


def test_an_edit_is_given_up_at_any_time(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        before = live(app).session
        await typed(pilot, "home", "f2", "escape")
        assert live(app).session.timeline is before.timeline
        await typed(pilot, "f2", "x", "escape")
        assert isinstance(app.screen, Editor)  # a text that has changed is not lost by one key
        assert any("Esc once more" in line for line in text(app))
        await typed(pilot, "escape")
        await typed(pilot, "f2")
        editor = await written(app, pilot, "fire", "turn 1")
        assert editor.working
        await typed(pilot, "escape")
        assert not editor.working
        assert "turn 1" in editor.text
        await typed(pilot, "escape", "escape")
        assert live(app).session.timeline is before.timeline
        assert live(app).session.timeline.lines.keys() == {"main"}

    run(arcade(tmp_path, wanted=guns(6.0)), story, size=WIDE)


def test_a_click_on_a_line_of_the_panel_leads_there(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        side = play.query_one("#pane", Rows)
        rows = [
            i for i, each in enumerate(side.rows) if each.place not in (None, play.session.place)
        ]
        place = side.rows[rows[0]].place
        await pilot.click("#pane", offset=(3, rows[0]))
        await settled(pilot)
        assert play.session.place == place

    run(arcade(tmp_path, wanted=guns(3.0)), story, size=WIDE)


def test_in_a_narrow_terminal_the_panel_comes_with_the_pause(tmp_path: Path) -> None:
    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        side = play.query_one("#side")
        assert side.display
        await typed(pilot, "p")
        flown(play, 0.3)
        await settled(pilot)
        assert not side.display
        await typed(pilot, "p")
        assert side.display
        await typed(pilot, "i")
        assert not side.display

    run(arcade(tmp_path, wanted=guns()), story, size=(80, 24))


# The law.

FLIGHT = ("left", "right", "up", "space")
TRAVEL = ("p", "comma", "shift+left", "left_square_bracket", "t", "end", "home", "X", "b", "plus")


@pytest.mark.parametrize("seed", range(3))
def test_a_game_played_in_the_app_is_the_same_lived_again_without_it(
    seed: int, tmp_path: Path
) -> None:
    draw = random.Random(seed)

    async def story(app: Arcade, pilot: Pilot[int]) -> None:
        if seed % 2:
            await chosen(app, pilot, "One player")
        else:
            await chosen(app, pilot, "Against a program")
            await chosen(app, pilot, "shooter")
        for _ in range(18):
            await pilot.press(draw.choice(FLIGHT if draw.random() < 0.6 else TRAVEL))
            for play in [app.playing] if app.playing else []:
                for _ in range(draw.randrange(8)):
                    play.go_on(draw.choice((1 / 60, 1 / 30, 0.1)))
        await settled(pilot)
        if isinstance(app.screen, End):
            await typed(pilot, "escape")
        await typed(pilot, "end", "shift+left", "t", "space")
        assert live(app).session.timeline.name != "main"
        live(app).go_on(0.2)

    run(arcade(tmp_path, seed=seed), story)
    faultless(tmp_path, at_least=2)
