"""What an arena found, as it is told and as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from fasteroids.arena import Ended, Game, Played
from fasteroids.cli._league import League, record, told

# For people.


def league(played: Played, bots: tuple[str, ...], field: str = "field.toml") -> League:
    seeds = tuple(sorted({game.seed for game in played}))
    return League(Path(field).name, field, None, "smooth", 60.0, seeds, bots, played)


def test_alone_a_league_is_told_like_this() -> None:
    cleared, died, late = Ended("cleared", 20.0), Ended("died", 5.0), Ended("timed out", 60.0, 1200)
    stopped = Ended("died", 6.0, 0, "line 3: getx null: e is null")
    a = [cleared, died, cleared, cleared, late]
    b = [died, died, stopped, cleared, stopped]
    played = {
        Game((bot,), seed): (ended,)
        for bot, ends in (("my/b.ast", b), ("a", a))
        for seed, ended in enumerate(ends)
    }
    assert (
        "\n".join(told(league(played, ("my/b.ast", "a"), "my field.toml")))
        == """\
my field.toml: 2 bots, each alone on 5 seeds (0-4), at most 60 s; model smooth

                                              timed   mean  median  out of
bot       games  cleared        (95 %)  died    out  death  clears    fuel
a             5        3  60 % (23-88)     1      1  5.0 s  20.0 s   1,200
my/b.ast      5        1   20 % (4-62)     4      0  5.5 s  20.0 s       0

On the same seeds, cleared by
first  second    only first  only second  both  neither    p
a      my/b.ast           2            0     1        2  0.5

Stopped at an illegal operation
  my/b.ast: line 3: getx null: e is null; seeds 2 4

Seeds
  a
    cleared:   0 2-3
    died:      1
    timed out: 4
  my/b.ast
    cleared:   3
    died:      0-2 4

To see one: fasteroids run 'my field.toml' --seed 1 --bots a --for 60"""
    )


def test_one_against_the_other_a_league_is_told_like_this() -> None:
    won, lost, drawn = Ended("won", 4.0), Ended("lost", 4.0), Ended("drawn", 9.0)
    late, stopped = Ended("timed out", 60.0), Ended("timed out", 60.0, 2, "line 1: turn by nan")
    played = {
        Game(("a", "b"), 0): (won, lost), Game(("b", "a"), 0): (won, lost),
        Game(("a", "b"), 1): (won, lost), Game(("b", "a"), 1): (lost, won),
        Game(("a", "b"), 4): (drawn, drawn), Game(("b", "a"), 4): (late, stopped),
    }  # fmt: skip
    assert (
        "\n".join(told(league(played, ("a", "b"))))
        == """\
field.toml: every two of 2 bots, both ways round on 3 seeds (0-1 4), at most 60 s; model smooth

                                            timed   mean  median  out of
bot  games  won        (95 %)  lost  drawn    out  death    wins    fuel
a        6    3  50 % (19-81)     1      1      1  6.5 s   4.0 s       2
b        6    1   17 % (3-56)     3      1      1  5.2 s   4.0 s       0

One against the other
first  second  first won  second won  drawn  timed out     p
a      b               3           1      1          1  0.62

Stopped at an illegal operation
  a in b against a: line 1: turn by nan; seed 4

Seeds, as the first of the two fared
  a against b
    won:       0-1
    drawn:     4
  b against a
    won:       0
    lost:      1
    timed out: 4

To see one: fasteroids run field.toml --seed 4 --bots a,b --for 60"""
    )


@pytest.mark.parametrize("columns", [40, 80, 300])
def test_long_lists_of_seeds_are_wrapped(columns: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    played = {Game(("a",), seed): (Ended("died", 1.0),) for seed in range(0, 400, 2)}
    lines = list(told(league(played, ("a",))))
    (first,) = [i for i, line in enumerate(lines) if line.startswith("    died:")]
    rows = lines[first : lines.index("", first)]
    assert len(rows) > 5
    assert max(map(len, rows)) <= min(columns, 100)
    assert all(row.startswith(" " * 15) for row in rows[1:])
    assert " ".join(" ".join(rows).split()[1:]) == " ".join(map(str, range(0, 400, 2)))


def test_names_obey_no_terminal() -> None:
    played = {Game(("a\x1b[2J.ast",), 0): (Ended("died", 1.0),)}
    assert "\x1b" not in "\n".join(told(league(played, ("a\x1b[2J.ast",))))


@pytest.mark.parametrize(
    ("field", "bot", "words"),
    [
        ("f.toml", "a\x1b[2J'é\\.ast", "f.toml --seed 0 --bots $'a\\x1b\\x5b2J\\x27\\xc3\\xa9\\x5c.ast'"),
        ("-f.toml", "it's", "./-f.toml --seed 0 --bots 'it'\"'\"'s'"),
        ("-", "日本.ast", "- --seed 0 --bots '日本.ast'"),
    ],
)  # fmt: skip
def test_the_command_it_tells_is_one_for_a_shell(field: str, bot: str, words: str) -> None:
    *_, last = told(league({Game((bot,), 0): (Ended("died", 1.0),)}, (bot,), field))
    assert last == f"To see one: fasteroids run {words} --for 60"


def test_telling_looks_at_each_game_no_more_often_in_large_leagues() -> None:
    """Once it looked at all games for each one that stopped."""

    class Counting(dict[Game, tuple[Ended, ...]]):
        looks = 0

        def __iter__(self) -> Iterator[Game]:
            for game in super().__iter__():
                self.looks += 1
                yield game

    def looks(games: int) -> float:
        stopped = Ended("died", 1.0, 0, "line 1: turn nan")
        played = Counting({Game(("a",), seed): (stopped,) for seed in range(games)})
        list(told(league(played, ("a",))))
        return played.looks / games

    assert looks(300) <= looks(3)


# The record alone.


def test_a_record_is_plain_json() -> None:
    played = {Game(("a",), 0): (Ended("died", 1.0),)}
    found = record(league(played, ("a",)))
    assert json.loads(json.dumps(found, allow_nan=False))["bots"][0]["clearing"] is None
    assert found["pairs"] == []
