"""What an arena found, for people and as JSON."""

from __future__ import annotations

import os
import shlex
import shutil
import string
import textwrap
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from typing import Any, Final

from attrs import asdict, frozen

from fasteroids.arena import (
    Played,
    Standing,
    between,
    paired,
    ranked,
    standing,
    wilson,
)
from fasteroids.cli._columns import aligned
from fasteroids.cli._files import STDIO
from fasteroids.cli._narrate import counted, number
from fasteroids.cli._seeds import in_short
from fasteroids.lang.report import legible

__all__ = ["League", "record", "told"]

_WIDE: Final = 100  # columns at most

_ALONE: Final = ("cleared", "died", "timed out")
_DUEL: Final = ("won", "lost", "drawn", "timed out")
"""The outcomes, in the order in which they are told."""

_PLAIN: Final = frozenset(string.ascii_letters + string.digits + " ,./_-")
"""What needs no escape in any quotes of a shell."""


@frozen
class League:
    """An arena that is over: what was asked for, and how the games ended, at least one.

    `field` is the scene as it was given, `asked` the model that replaced its own, if any, `model` the one it had.
    """

    title: str
    field: str
    asked: str | None
    model: str
    limit: float
    seeds: tuple[int, ...]
    bots: tuple[str, ...]
    played: Played

    @property
    def alone(self) -> bool:
        """Is each program alone in the field?"""
        return len(next(iter(self.played)).bots) == 1


def told(league: League) -> Iterator[str]:
    """All of it for people: the table, every two compared, programs that stopped, and the seeds."""
    table = ranked(league.bots, league.played)
    yield _opening(league)
    yield ""
    yield from _table(league, table)
    if len(table) > 1:
        yield ""
        yield from _pairs(league, list(table))
    yield from _stops(league)
    yield ""
    yield from _seeds(league, list(table))


def _opening(league: League) -> str:
    seeds = f"{counted(len(league.seeds), 'seed')} ({in_short(league.seeds)})"
    if league.alone:
        each = "each " if len(league.bots) > 1 else ""
        who = f"{counted(len(league.bots), 'bot')}, {each}alone on {seeds}"
    else:
        who = f"every two of {counted(len(league.bots), 'bot')}, both ways round on {seeds}"
    limit = f"at most {number(league.limit)} s; model {league.model}"
    return "\n".join(_wrapped(f"{league.title}: {who}, {limit}", 0))


# The table.


def _table(league: League, table: dict[str, Standing]) -> list[str]:
    """Programs, from the best on. Intervals are of 95 %; times in s."""
    head: tuple[tuple[str, ...], tuple[str, ...]]
    if league.alone:
        head = (
            ("", "", "", "", "", "timed", "mean", "median", "out of"),
            ("bot", "games", "cleared", "(95 %)", "died", "out", "death", "clears", "fuel"),
        )
    else:
        head = (
            ("", "", "", "", "", "", "timed", "mean", "median", "out of"),
            ("bot", "games", "won", "(95 %)", "lost", "drawn", "out", "death", "wins", "fuel"),
        )
    rows = [*head, *(_row(legible(bot), each, league) for bot, each in table.items())]
    return aligned(rows, right=range(1, len(head[0])))


def _row(name: str, each: Standing, league: League) -> tuple[str, ...]:
    within = wilson(each.won, each.games)
    share = f"{_percent(each.share)} % ({_percent(within.low)}-{_percent(within.high)})"
    drawn = () if league.alone else (f"{each.drawn:,}",)
    return (
        name, f"{each.games:,}", f"{each.won:,}", share, f"{each.lost:,}", *drawn,
        f"{each.timed_out:,}", _seconds(each.death), _seconds(each.clearing), f"{each.fuel:,}",
    )  # fmt: skip


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f}"


def _seconds(time: float | None) -> str:
    return "-" if time is None else f"{time:.1f} s"


# Every two.


def _pairs(league: League, bots: Sequence[str]) -> list[str]:
    rows: list[tuple[str, ...]]
    if league.alone:
        title = "On the same seeds, cleared by"
        rows = [("first", "second", "only first", "only second", "both", "neither", "p")]
    else:
        title = "One against the other"
        rows = [("first", "second", "first won", "second won", "drawn", "timed out", "p")]
    for first, second in combinations(bots, 2):
        *counts, p = _pair(league, first, second).values()
        numbers = (f"{n:,}" for n in counts)
        rows.append((legible(first), legible(second), *numbers, _chance(p)))
    return [title, *aligned(rows, right=range(2, 7))]


def _chance(p: float) -> str:
    return "< 1e-9" if p < 1e-9 else f"{p:.2g}"


# Programs that stopped.


def _stops(league: League) -> Iterator[str]:
    """Programs that did something illegal: a line for each way to."""
    seeds: dict[tuple[str, str, str], list[int]] = defaultdict(list)
    for game, ended in league.played.items():
        for bot, one in zip(game.bots, ended, strict=True):
            if one.stopped is not None:
                where = "" if league.alone else f" in {_versus(game.bots)}"
                seeds[bot, where, one.stopped].append(game.seed)
    if seeds:
        yield ""
        yield "Stopped at an illegal operation"
    for (bot, where, why), some in seeds.items():
        word = "seed" if len(some) == 1 else "seeds"
        yield from _wrapped(f"  {legible(bot)}{where}: {why}; {word} {in_short(some)}", 4)


# The seeds.


def _seeds(league: League, bots: Sequence[str]) -> Iterator[str]:
    """The seeds of each line-up by how it ended, and how to see a game."""
    rank = {bot: place for place, bot in enumerate(bots)}
    lineups = sorted(
        {game.bots for game in league.played}, key=lambda crew: [rank[bot] for bot in crew]
    )
    yield "Seeds" if league.alone else "Seeds, as the first of the two fared"
    for crew in lineups:
        yield f"  {_versus(crew)}"
        for outcome, seeds in _outcomes(league, crew):
            yield from _wrapped(f"    {outcome + ':':<10} {in_short(seeds)}", 15)
    yield ""
    yield f"To see one: {_command(league, lineups[0])}"


def _versus(crew: Iterable[str]) -> str:
    return " against ".join(map(legible, crew))


def _outcomes(league: League, crew: tuple[str, ...]) -> Iterator[tuple[str, list[int]]]:
    seeds: dict[str, list[int]] = defaultdict(list)
    for game, ended in league.played.items():
        if game.bots == crew:
            seeds[ended[0].outcome].append(game.seed)
    for outcome in _ALONE if league.alone else _DUEL:
        if outcome in seeds:
            yield outcome, seeds[outcome]


def _command(league: League, crew: tuple[str, ...]) -> str:
    """A command that plays a game again: of the best one the first that it did not win, if any."""
    games = [game for game in league.played if game.bots == crew]
    game = next((g for g in games if not league.played[g][0].good), games[0])
    model = [] if league.asked is None else ["--model", league.asked]
    seed, limit = str(game.seed), repr(league.limit).removesuffix(".0")
    field = league.field
    if field.startswith("-") and field != STDIO:
        field = f"./{field}"  # or it would be an option
    words = ["run", field, "--seed", seed, "--bots", ",".join(crew), "--for", limit, *model]
    return " ".join(["fasteroids", *map(_quoted, words)])


def _quoted(word: str) -> str:
    """A word for a shell, in which no terminal obeys anything: $'...' if it does not print (POSIX 2024, 2.2.4)."""
    if word.isprintable():
        return shlex.quote(word)
    data = os.fsencode(word)
    return "$'" + "".join(chr(b) if chr(b) in _PLAIN else f"\\x{b:02x}" for b in data) + "'"


def _wrapped(text: str, hanging: int) -> list[str]:
    wide = min(_WIDE, shutil.get_terminal_size((_WIDE, 24)).columns)
    return textwrap.wrap(
        text, max(wide, 2 * hanging), subsequent_indent=" " * hanging,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


# JSON.


def record(league: League) -> dict[str, Any]:
    """All of it, and each game."""
    table = ranked(league.bots, league.played)
    return {
        "field": league.title,
        "model": league.model,
        "limit": league.limit,
        "seeds": in_short(league.seeds),
        "bots": [_standing(bot, each) for bot, each in table.items()],
        "pairs": [
            {"first": first, "second": second} | _pair(league, first, second)
            for first, second in combinations(table, 2)
        ],
        "games": [
            {"bots": game.bots, "seed": game.seed, "ended": [asdict(each) for each in ended]}
            for game, ended in league.played.items()
        ],
    }


def _standing(bot: str, each: Standing) -> dict[str, Any]:
    return {"bot": bot, **asdict(each), "share": each.share, **asdict(wilson(each.won, each.games))}


def _pair(league: League, first: str, second: str) -> dict[str, Any]:
    """How often which of two was better, and `p`, in the order of the columns that tell it."""
    one, other = between(first, second, league.played)
    pair = paired(one, other)
    found: dict[str, Any] = {"only_first": pair.first, "only_second": pair.second}
    if league.alone:
        found |= {"both": pair.both, "neither": pair.neither}
    else:
        games = standing(one.values())
        found |= {"drawn": games.drawn, "timed_out": games.timed_out}
    return found | {"p": pair.p}
