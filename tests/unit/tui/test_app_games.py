"""A game in the app: its end, the table of high scores, and the screens over it."""

from __future__ import annotations

from pathlib import Path

import pytest
from attrs import evolve
from textual.events import Key
from textual.pilot import Pilot
from textual.widgets import Input
from textual.widgets._toast import Toast

from fasteroids import Asteroid, Ship, World, load_scene
from fasteroids.history.recording import read, verified
from fasteroids.tui._store import Store
from fasteroids.tui.app import Arcade
from fasteroids.tui.boxes import Choose
from fasteroids.tui.ending import End
from fasteroids.tui.game import Game, Player
from fasteroids.tui.keyboard import KeyAgain, KeyboardReport, KeyUp
from fasteroids.tui.keys import Command
from fasteroids.tui.launching import Launched, NewGame, SceneGame
from fasteroids.tui.lists import Choices
from fasteroids.tui.play import Play
from fasteroids.tui.recent import briefs
from fasteroids.tui.screens import Help, Keys, Palette, Scores
from fasteroids.tui.session import opened
from fasteroids.tui.start import Start
from tests.unit.tui.arcades import arcade, chosen, flown, live, run, settled, text, typed


def doomed(points: int = 500) -> Launched:
    """The last ship of a game of waves, half a second before an asteroid hits it."""
    world = World(400, 300, 9, "smooth").add_all(
        [Ship(200, 150, 0, 0, 20, 5e15, 0.0, name="you"), Asteroid(290, 150, -100, 0, 20)]
    )
    player = Player("you", 1, True, lives=1, points=points)
    session = opened(world, Game("waves", (player,), wave=3))
    return Launched(NewGame("waves", (None,), 9), "waves: you", session)


async def died(app: Arcade, pilot: Pilot[int]) -> End:
    """Play to the end; the screen that tells of it."""
    flown(live(app), 2.0)
    await settled(pilot)
    assert isinstance(app.screen, End)
    return app.screen


def store(folder: Path) -> Store:
    return Store(pytest.fail, folder=folder, config=folder / "config.toml")


def test_a_score_is_entered_with_a_name_and_can_be_looked_at_again(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await died(app, pilot)
        assert {"game over", "wave 3, seed 9"} <= {line.strip() for line in text(app)}
        assert "you: 500 points" in text(app)
        assert "place 1 in the high scores; your name:" in text(app)
        await typed(pilot, *"Ada y", "enter")
        await chosen(app, pilot, "Start screen")
        await chosen(app, pilot, "High scores")
        assert isinstance(app.screen, Scores)
        [line] = [line for line in text(app) if "Ada y" in line]
        assert line.startswith("> ")
        assert {"500", "wave", "3", "seed", "9"} <= set(line.split())
        await typed(pilot, "enter")
        assert not live(app).session.live
        assert live(app).session.timeline.world.time == pytest.approx(2.0)

    run(arcade(tmp_path, wanted=doomed()), play)
    [row] = store(tmp_path).scores().rows
    assert (row.name, row.score, row.wave, row.seed) == ("Ada y", 500, 3, 9)
    assert (tmp_path / "recordings" / row.recording).is_file()


def test_a_score_is_not_lost_when_its_player_walks_away(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await died(app, pilot)
        await typed(pilot, "escape")
        assert not live(app).session.running or live(app).session.game.ended

    run(arcade(tmp_path, wanted=doomed()), play)
    assert [row.name for row in store(tmp_path).scores().rows] == ["nobody"]


def test_a_life_taken_over_from_the_past_is_not_for_the_table(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        flown(live(app), 0.3)
        await typed(pilot, "home", "t")
        await died(app, pilot)
        assert not app.screen.query(Input)

    run(arcade(tmp_path, wanted=doomed()), play)
    assert store(tmp_path).scores().rows == ()


def test_one_key_tells_why_and_the_game_is_taken_over_from_there(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await died(app, pilot)
        await typed(pilot, "y")
        play = live(app)
        assert not play.session.live
        assert play.session.said == "ship 'you' died at 0.500 s in a contact with asteroid #2"
        assert play.session.fate is not None
        await typed(pilot, "t", "up")
        flown(play, 0.3)
        assert play.session.game.ended is None
        flown(play, 3.0)
        await settled(pilot)
        assert isinstance(app.screen, End)  # told again: it is another life

    run(arcade(tmp_path, wanted=doomed(0)), play)


@pytest.mark.parametrize(("label", "same"), [("Play again", False), ("The same again", True)])
def test_another_game_begins(tmp_path: Path, label: str, same: bool) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await died(app, pilot)
        await chosen(app, pilot, label)
        world = live(app).session.world
        assert world.time == 0.0
        assert (world.seed == 9) is same

    run(arcade(tmp_path, wanted=doomed(0)), play)
    assert len(briefs(tmp_path / "recordings")) == 2


def test_a_duel_is_won_by_a_shot(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "space")
        flown(live(app), 2.5)
        await settled(pilot)
        assert isinstance(app.screen, End)
        assert any("west wins" in line for line in text(app))
        assert not app.screen.query(Input)

    run(arcade(tmp_path, wanted=SceneGame("pair", 1)), play)
    [brief] = briefs(tmp_path / "recordings")
    assert verified(read(brief.place.read_bytes())).difference is None


def test_time_stands_still_under_other_screens(tmp_path: Path) -> None:
    async def play(app: Arcade, pilot: Pilot[int]) -> None:
        play = live(app)
        await pilot.pause(0.2)
        assert play.session.world.time > 0.0
        await typed(pilot, "question_mark")
        before = play.session.world.time
        await pilot.pause(0.2)
        assert play.session.world.time == before

    run(arcade(tmp_path, wanted=doomed(), timer=True), play)


# Screens over a game.


def test_help_shows_every_command_with_its_keys(tmp_path: Path) -> None:
    async def look(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "question_mark")
        assert isinstance(app.screen, Help)
        seen = list(text(app))
        for _ in range(8):
            await pilot.press("pagedown")
            seen += text(app)
        assert all(any(command.says in line for line in seen) for command in Command)
        assert any("Space" in line and "fire" in line for line in seen)
        await typed(pilot, "question_mark")
        assert isinstance(app.screen, Start)

    run(arcade(tmp_path), look, size=(100, 24))


def test_the_palette_finds_a_command_and_does_it(tmp_path: Path) -> None:
    async def command(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "ctrl+p")
        assert isinstance(app.screen, Palette)
        assert any("Ctrl+P" in line for line in text(app)) or len(text(app)) > 10
        await typed(pilot, *"pause")
        assert any(line.startswith("> pause, or go on") and "p" in line.split() for line in text(app))  # fmt: skip
        await typed(pilot, "enter")
        assert live(app).session.running == 0
        await typed(pilot, "ctrl+p", *"chakeys", "enter")
        assert isinstance(app.screen, Keys)

    run(arcade(tmp_path, wanted=doomed()), command)


def test_a_letter_finds_nothing_it_is_not_in(tmp_path: Path) -> None:
    async def command(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "ctrl+p", *"qqzz")
        assert app.screen.query_one(Choices).menu.entries == ()
        await typed(pilot, "enter", "down", "backspace", "backspace", "backspace", "backspace")
        assert len(app.screen.query_one(Choices).menu.entries) > len(Command)

    run(arcade(tmp_path, wanted=doomed()), command)


def test_keys_are_changed_on_screen_at_once_and_for_good(tmp_path: Path) -> None:
    async def change(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Keys")
        await chosen(app, pilot, "pause, or go on")
        await typed(pilot, "escape")  # none, after all
        assert app.keymap.keys[Command.PAUSE] == ("p",)
        await typed(pilot, "enter", "f6")
        assert app.keymap.keys[Command.PAUSE] == ("f6",)
        await typed(pilot, "enter", "space")
        assert any("Space is for: fire. Press it again" in line for line in text(app))
        assert app.keymap.command("space") is Command.ONE_FIRE
        await typed(pilot, "space")
        assert app.keymap.command("space") is Command.PAUSE
        await typed(pilot, "escape")
        await chosen(app, pilot, "One player")
        await typed(pilot, "space")
        assert live(app).session.running == 0

    run(arcade(tmp_path), change)
    kept = store(tmp_path).settings().keymap
    assert kept.command("space") is Command.PAUSE
    assert kept.keys[Command.ONE_FIRE] == ()


def test_a_change_is_taken_back_and_presets_go_round(tmp_path: Path) -> None:
    async def change(app: Arcade, pilot: Pilot[int]) -> None:
        await chosen(app, pilot, "Keys")
        await chosen(app, pilot, "pause, or go on")
        await typed(pilot, "f6", "delete")
        assert app.keymap.keys[Command.PAUSE] == ("p",)
        await typed(pilot, "home")
        names = []
        for _ in range(3):
            await typed(pilot, "enter")
            names.append(app.keymap.preset)
        assert names == ["azerty", "vim", "arrows"]

    run(arcade(tmp_path), change)


def test_a_picture_and_the_scene_of_its_moment_are_saved(tmp_path: Path) -> None:
    async def save(app: Arcade, pilot: Pilot[int]) -> None:
        flown(live(app), 0.3)
        await typed(pilot, "f12", "f12")
        pictures = sorted((tmp_path / "pictures").iterdir())
        assert [place.suffix for place in pictures].count(".svg") == 2
        svg, scene = pictures[:2] if pictures[0].suffix == ".svg" else pictures[1::-1]
        assert svg.read_text().startswith("<svg")
        assert svg.stem == scene.stem
        world = load_scene(scene.read_text())
        assert world == live(app).session.world

    run(arcade(tmp_path, wanted=doomed()), save)


def test_a_picture_that_cannot_be_saved_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "pictures").write_text("in the way")
    told: list[str] = []

    async def save(app: Arcade, pilot: Pilot[int]) -> None:
        monkeypatch.setattr(app, "tell", told.append)
        await typed(pilot, "f12")
        assert live(app).session.world.time == 0.0

    run(arcade(tmp_path, wanted=doomed()), save)
    assert len(told) == 1
    assert told[0].startswith("no picture: cannot write ")


def test_sound_is_switched_off_and_on(tmp_path: Path) -> None:
    async def switch(app: Arcade, pilot: Pilot[int]) -> None:
        await typed(pilot, "m")
        assert app.sound.muted
        await typed(pilot, "m")
        assert not app.sound.muted

    run(arcade(tmp_path, wanted=doomed()), switch)


# Keys that go up.


def test_a_held_enter_does_not_run_through_the_menus(tmp_path: Path) -> None:
    async def hold(app: Arcade, pilot: Pilot[int]) -> None:
        app.post_message(KeyAgain("enter", None))
        await settled(pilot)
        assert isinstance(app.screen, Start)
        await chosen(app, pilot, "Against a program")
        app.post_message(KeyAgain("enter", None))
        await settled(pilot)
        assert "Which program is against you?" in " ".join(text(app))

    run(arcade(tmp_path), hold)


def test_keys_that_come_together_open_one_screen_each(tmp_path: Path) -> None:
    """They may be on their way already when a screen comes or goes."""

    async def burst(app: Arcade, pilot: Pilot[int]) -> None:
        async def at_once(*keys: str) -> None:
            for key in keys:
                app.post_message(Key(key, None))
            await settled(pilot)

        await at_once("enter", "enter", "enter")
        assert [type(each) for each in app.screen_stack[1:]] == [Start, Play]
        await at_once("ctrl+p", "ctrl+p", "question_mark")
        assert [type(each) for each in app.screen_stack[1:]] == [Start, Play, Palette]
        await at_once("escape", "escape")
        assert [type(each) for each in app.screen_stack[1:]] == [Start, Play]
        app.post_message(KeyAgain("escape", None))
        await settled(pilot)
        await at_once("escape")
        assert [type(each) for each in app.screen_stack[1:]] == [Start]
        await at_once("down", "down", "enter", "enter")
        assert [type(each) for each in app.screen_stack[1:]] == [Start, Choose]
        await at_once("escape", "escape")
        assert [type(each) for each in app.screen_stack[1:]] == [Start]

    run(arcade(tmp_path), burst)
    assert len(briefs(tmp_path / "recordings")) == 1


def test_sentences_are_shown_as_they_are(tmp_path: Path) -> None:
    async def tell(app: Arcade, pilot: Pilot[int]) -> None:
        app.tell("cannot write [/nowhere] and [b")
        await settled(pilot)
        [toast] = app.screen.query(Toast)
        assert "cannot write [/nowhere] and [b" in str(toast.render())

    run(arcade(tmp_path), tell)


def test_what_the_terminal_says_of_keys_on_the_start_screen_holds_in_games(tmp_path: Path) -> None:
    async def hold(app: Arcade, pilot: Pilot[int]) -> None:
        app.post_message(KeyboardReport(27))
        await settled(pilot)
        await chosen(app, pilot, "One player")
        play = live(app)
        assert play.hands.mode == "held"
        await typed(pilot, "up")
        flown(play, 0.1)
        assert thruster(play.session.world)
        await typed(pilot, "question_mark")  # whoever looks elsewhere holds nothing
        app.post_message(KeyUp("up"))
        await typed(pilot, "escape")
        flown(play, 0.1)
        assert not thruster(play.session.world)

    run(arcade(tmp_path), hold)


def thruster(world: World) -> bool:
    return world.ships[0].thruster


def test_sizes_come_and_go_under_every_screen(tmp_path: Path) -> None:
    async def resize(app: Arcade, pilot: Pilot[int]) -> None:
        for key in ("question_mark", "escape", "ctrl+p", "escape"):
            await pilot.resize_terminal(*{"escape": (30, 8)}.get(key, (1, 1)))
            await typed(pilot, key)
        flown(live(app), 2.0)
        await settled(pilot)
        for size in [(30, 8), (1, 1), (200, 60)]:
            await pilot.resize_terminal(*size)
        await settled(pilot)
        assert isinstance(app.screen, End)

    run(arcade(tmp_path, wanted=evolve(doomed())), resize)
