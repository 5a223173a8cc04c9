"""What is wanted becomes a session; a recording becomes the past that it tells."""

from __future__ import annotations

import gzip
import io
from pathlib import Path

import pytest

from fasteroids import Fire
from fasteroids.entities import Ship
from fasteroids.history import Act
from fasteroids.history.living import Told
from fasteroids.history.recording import read
from fasteroids.tui.game import LIVES
from fasteroids.tui.keeping import Keeper
from fasteroids.tui.launching import (
    NewGame,
    Recorded,
    SceneGame,
    launched,
    new_seed,
    with_seed,
)
from fasteroids.tui.recent import brief, briefs
from fasteroids.tui.session import Session, beat, bookmarked, look_at, take_over
from fasteroids.units import ModelError
from tests.unit.tui.arcades import Library


def kept(folder: Path, wanted: NewGame | SceneGame, seconds: float = 3.0) -> tuple[Session, Path]:
    """Some seconds of a game, and its recording."""
    begun = launched(wanted, Library())
    keeper = Keeper(folder, begun.title, pytest.fail)
    session = begun.session
    keeper.follow(session)
    for i in range(round(seconds * 30)):
        human = session.game.players[0].ship
        session = beat(session, 1 / 30, [(human, Fire())] if human and i % 20 == 0 else [])
        keeper.follow(session)
    session = bookmarked(session, "end")
    keeper.follow(session)
    keeper.close()
    assert keeper.path is not None
    return session, keeper.path


@pytest.mark.parametrize(
    "wanted",
    [
        NewGame("waves", (None,), 7),
        NewGame("duel", (None, "shooter"), 7),
        NewGame("duel", (None, None), 7),
        NewGame("waves", ("shooter",), 7),
        SceneGame("pair", 1),
        SceneGame("pair", 0, model="spec"),
    ],
)
def test_a_recording_is_the_past_that_was_lived(
    tmp_path: Path, wanted: NewGame | SceneGame
) -> None:
    live, place = kept(tmp_path, wanted)
    again = launched(Recorded(place), Library()).session
    assert not again.live
    assert again.place == again.timeline.first.place
    assert again.timeline.world == live.timeline.world
    start = live.timeline.first.place
    lived = [(s.place, s.world.entities) for s in live.timeline.forwards(start) if s.died or s.born]
    told = [(s.place, s.world.entities) for s in again.timeline.forwards(start) if s.died or s.born]
    assert told == lived
    assert again.timeline.bookmarks["end"].state.place == live.timeline.last.place
    final = again.games[again.timeline.name][-1][1]
    assert (final.mode, final.wave, final.ended) == (live.game.mode, live.game.wave, live.game.ended)  # fmt: skip
    assert [(p.points, p.lives, p.human) for p in final.players] == [
        (p.points, p.lives, p.human) for p in live.game.players
    ]


def test_a_recording_that_was_cut_short_is_lived_as_far_as_it_goes(tmp_path: Path) -> None:
    _, place = kept(tmp_path, NewGame("waves", (None,), 7))
    lines = place.read_bytes().splitlines(keepends=True)
    place.write_bytes(b"".join(lines[: len(lines) // 2]) + b'{"type":"ev')
    found = launched(Recorded(place), Library()).session
    assert "cut short" in found.said
    last = found.timeline.world.time
    assert 0.0 < last < 3.0
    assert not brief(place).whole
    over = take_over(found)
    assert over.live


def test_waves_bring_the_program_its_next_ship(tmp_path: Path) -> None:
    session = launched(NewGame("waves", ("shooter",), 3), Library()).session
    for _ in range(6000):
        session = beat(session, 0.1)
        if session.game.players[0].lives < LIVES and session.game.players[0].ship is not None:
            break
    ship = session.world[session.game.players[0].ship or 0]
    assert isinstance(ship, Ship)
    assert ship.program is not None
    assert not session.game.players[0].human


def test_seeds_decide_and_are_drawn_anew(tmp_path: Path) -> None:
    wanted = NewGame("waves", (None,), 5)
    assert launched(wanted, Library()).session.world == launched(wanted, Library()).session.world
    assert with_seed(wanted, 6) == NewGame("waves", (None,), 6)
    assert with_seed(SceneGame("pair"), 6) == SceneGame("pair", seed=6)
    assert with_seed(Recorded(tmp_path), 6) == Recorded(tmp_path)
    drawn = {new_seed() for _ in range(20)}
    assert len(drawn) > 15
    assert all(0 <= seed < 1_000_000 for seed in drawn)


def test_who_flies_in_a_scene() -> None:
    def pilots(wanted: SceneGame) -> list[bool]:
        world = launched(wanted, Library()).session.world
        return [ship.program is not None for ship in world.ships]

    assert pilots(SceneGame("pair", 0)) == [False, True]
    assert pilots(SceneGame("pair", 2)) == [False, False]  # a human's ship obeys nobody else
    assert pilots(SceneGame("pair", 1, ("shooter",))) == [False, True]
    assert pilots(SceneGame("pair", 0, ("shooter",))) == [True, True]
    assert pilots(SceneGame("pair", 2, pilot="shooter")) == [True, True]


@pytest.mark.parametrize(
    ("wanted", "sentence"),
    [
        (SceneGame("nowhere"), "there is no scene"),
        (SceneGame("pair", 3), "two players need two ships; this scene has 2"),
        (SceneGame("pair", 2, ("shooter",)), "there is no ship left for a program"),
        (SceneGame("pair", 0, ("shooter",) * 3), "3 programs are too many for 2 ships"),
        (SceneGame("pair", 1, ("nobody",)), "there is no bot"),
        (NewGame("duel", (None, "nobody"), 1), "there is no bot"),
        (Recorded(Path("/nowhere")), "cannot read /nowhere: No such file"),
        (Recorded(Path("/")), "cannot read /: Is a directory"),
    ],
)
def test_what_cannot_be_had_is_a_sentence(
    wanted: NewGame | SceneGame | Recorded, sentence: str
) -> None:
    with pytest.raises(ModelError, match=sentence):
        launched(wanted, Library())


def test_the_recording_of_another_future_has_the_bookmarks_of_its_past(tmp_path: Path) -> None:
    session = launched(NewGame("waves", (None,), 7), Library()).session
    session = bookmarked(beat(session, 0.2), "early")
    session = bookmarked(beat(beat(session, 0.2), 0.2), "late")
    keeper = Keeper(tmp_path, "another", pytest.fail)
    keeper.follow(beat(take_over(look_at(session, 0.4)), 0.1))
    keeper.close()
    assert keeper.path is not None
    again = launched(Recorded(keeper.path), Library()).session.timeline
    early = session.timeline.bookmarks["early"].state
    assert {name: mark.state.place for name, mark in again.bookmarks.items()} == {
        "early": early.place
    }


# Recordings in short.


def test_a_recording_in_short_agrees_with_the_whole(tmp_path: Path) -> None:
    live, place = kept(tmp_path, NewGame("duel", (None, "sitter"), 11), 1.0)
    found = brief(place)
    assert (found.title, found.seed, found.whole) == ("duel: you against sitter", 11, True)
    assert found.seconds == pytest.approx(live.world.time)
    assert found.size == place.stat().st_size
    packed = tmp_path / "z.fast.jsonl.gz"
    packed.write_bytes(gzip.compress(place.read_bytes()))
    again = brief(packed)
    assert (again.title, again.seed, again.seconds) == (found.title, 11, found.seconds)
    assert [each.place for each in briefs(tmp_path)] == [packed, place]


@pytest.mark.parametrize(
    "data",
    [
        b"", b"\n", b"\xff\xfe", b"{", b"[]", b"{}", b'{"type":"header"}', b"\x1f\x8b", b"\x1f\x8bxx",
        b'{"type":"header","title":3,"seed":"x"}\n{"time":"soon"}\n', b"[" * 100_000,
    ],
)  # fmt: skip
def test_no_file_is_too_odd_to_be_listed(tmp_path: Path, data: bytes) -> None:
    place = tmp_path / "odd.fast.jsonl"
    place.write_bytes(data)
    found = brief(place)
    assert found.title
    assert not found.whole
    assert found.seed is None
    assert brief(tmp_path / "gone.fast.jsonl").title.startswith("cannot be read: ")
    assert brief(tmp_path).title


def test_what_a_human_did_is_an_input_of_the_recording(tmp_path: Path) -> None:
    live, place = kept(tmp_path, NewGame("waves", (None,), 7), 1.0)
    given = [each.what for each in read(place.read_bytes()).givens]
    start = live.timeline.first.place
    told = [s.what.what for s in live.timeline.forwards(start) if isinstance(s.what, Told)]
    assert given == told
    assert Act(1, Fire()) in given
    assert io.BytesIO(place.read_bytes()).readline().startswith(b'{"type":"header"')


def test_what_is_no_file_is_no_recording_and_what_cannot_be_written_says_why_in_words(
    tmp_path: Path,
) -> None:
    _, path = kept(tmp_path, NewGame("duel", (None, "shooter"), 7), seconds=0.5)
    (tmp_path / "20000101-000000.fast.jsonl").mkdir()
    assert [each.place for each in briefs(tmp_path)] == [path]

    told: list[str] = []
    begun = launched(NewGame("duel", (None, "shooter"), 7), Library())
    Keeper(path / "below", begun.title, told.append).follow(begun.session)
    assert told == [f"this game is not recorded: {path / 'below'}: Not a directory"]
