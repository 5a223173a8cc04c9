"""What a recording tells without being lived again: who was in it, and a summary."""

from __future__ import annotations

from collections import Counter
from typing import Any, Final

from fasteroids.actions import Fire
from fasteroids.cli._columns import aligned
from fasteroids.cli._narrate import census, counted, label, listed, number
from fasteroids.entities import id_of
from fasteroids.events import Happened
from fasteroids.history.inputs import Act, Add, Remove
from fasteroids.history.recording import Bookmark, Entered, Event, Hash, Print, Recording, Snapshot

__all__ = ["Cast", "summary", "told"]

_MOST_DEATHS: Final = 20
"""Deaths told to people; JSON has all of them."""


class Cast:
    """Who was in a recording: `ids`, `names` by id where there are, `died` by id the line of a death, from 0.

    `deaths` are the lines themselves, in order.
    """

    def __init__(self, recording: Recording) -> None:
        self.labels = {id_of(e): label(e) for e in recording.world.entities.values()}
        self.names = {id_of(e): e.name for e in recording.world.entities.values() if e.name}
        self.died: dict[int, int] = {}
        self.deaths: list[Event | Entered] = []
        for i, line in enumerate(recording.lines):
            if isinstance(line, Event):
                self._born(line.happened.born, shot=line.happened.kind == "tick")
                self._died(i, line, line.happened.died)
            elif isinstance(line, Entered):
                self._entered(i, line)

    @property
    def ids(self) -> list[int]:
        """The ids of all, in order."""
        return sorted(self.labels)

    def meant(self, who: str) -> list[int]:
        """The ids of those of a name, else the one whose id it is."""
        named = [i for i in self.ids if self.names.get(i) == who]
        return named or [i for i in self.ids if who.removeprefix("#") == str(i)]

    def called(self, entity: int) -> str:
        """What people call an entity."""
        return self.labels.get(entity, f"#{entity}")

    def _born(self, ids: tuple[int, ...], *, shot: bool) -> None:
        for i in ids:
            self.labels[i] = f"{'bullet' if shot else 'asteroid'} #{i}"

    def _died(self, index: int, line: Event | Entered, ids: tuple[int, ...]) -> None:
        if ids:
            self.deaths.append(line)
        for i in ids:
            self.died[i] = index

    def _entered(self, index: int, line: Entered) -> None:
        match line.given.what:
            case Add(entity):
                for i in line.born:
                    self.labels[i] = entity.name or f"{entity.kind} #{i}"
                    if entity.name:
                        self.names[i] = entity.name
            case Act(_, Fire()):
                self._born(line.born, shot=True)
                self._died(index, line, line.died)
            case Remove():
                pass  # taken out, which is no death


def summary(recording: Recording, title: str) -> dict[str, Any]:
    """How it was made, how far it goes, what happened, who died, its bookmarks, and whether it is whole."""
    header, cast = recording.header, Cast(recording)
    lines, result = recording.lines, recording.result
    events = Counter(line.happened.kind for line in lines if isinstance(line, Event))
    kinds = {
        "inputs": Entered, "prints": Print, "hashes": Hash, "snapshots": Snapshot,
    }  # fmt: skip
    return {
        "file": title,
        "title": header.title,
        "format": header.format,
        "rules": header.rules,
        "fasteroids": header.fasteroids,
        "python": header.python,
        "model": header.model,
        "seed": header.seed,
        "fuel": header.fuel,
        "cuts": header.cuts,
        "slice": header.slice,
        "programs": [_program(name, text) for name, text in recording.texts.items()],
        "first": census(recording.world),
        "start": recording.world.time,
        "time": recording.time,
        "ended": None if result is None else result.ended,
        "short": recording.short,
        "lines": len(lines) + 1,
        "events": dict(sorted(events.items())),
        **{name: sum(isinstance(line, kind) for line in lines) for name, kind in kinds.items()},
        "deaths": [_death(line, cast) for line in cast.deaths],
        "bookmarks": [
            {"name": mark.name, "time": mark.place.time}
            for mark in lines
            if isinstance(mark, Bookmark)
        ],
    }  # fmt: skip


def _program(name: str, text: str) -> dict[str, Any]:
    return {"sha256": name, "lines": len(text.splitlines())}


def _death(line: Event | Entered, cast: Cast) -> dict[str, Any]:
    """Who died in a line, and how: in a contact, at a wall, or of a shot; who else was in it, and what was left."""
    born: tuple[int, ...] = ()
    if isinstance(line, Entered):
        assert isinstance(line.given.what, Act)
        time, died, how = line.given.place.time, line.died, "shot"
        others: tuple[int, ...] = (line.given.what.ship,)
    else:
        happened: Happened = line.happened
        time, died = happened.time, happened.died
        how = "shot" if happened.kind == "tick" else happened.kind
        others = tuple(i for i in happened.entities if i not in died)
        born = tuple(i for i in happened.born if i not in died)
    told: dict[str, Any] = {
        "time": time,
        "died": died,
        "who": [cast.called(i) for i in died],
        "how": how,
    }
    return told | {
        name: [cast.called(i) for i in ids] for name, ids in (("with", others), ("left", born))
    }


# For people.


def told(found: dict[str, Any]) -> list[str]:
    """A summary as lines."""
    by = f"fasteroids {_plain(found['fasteroids'])}, Python {_plain(found['python'])}"
    rows = [
        ("recording", found["file"]),
        ("of", f"{_plain(found['title'] or 'a world')}: {found['first']}"),
        ("made by", f"{by}, format {found['format']}"),
        ("game", _game(found)),
        ("time", f"from {number(found['start'])} s to {number(found['time'])} s, {_end(found)}"),
        ("events", _events(found)),
        ("lines", ", ".join(_lines(found))),
    ]  # fmt: skip
    if found["programs"]:
        rows.append(("programs", ", ".join(_of_program(each) for each in found["programs"])))
    for mark in found["bookmarks"]:
        rows.append(("bookmark", f"{mark['name']!r} at {number(mark['time'])} s"))
    rows += [("death", _fate(death)) for death in found["deaths"][:_MOST_DEATHS]]
    if (left := len(found["deaths"]) - _MOST_DEATHS) > 0:
        rows.append(("", f"and {counted(left, 'more death')}; --json tells all"))
    return aligned(rows)


def _plain(text: str) -> str:
    """A text out of a file, without what a terminal would obey."""
    return text if text.isprintable() else repr(text)


def _game(found: dict[str, Any]) -> str:
    cuts = f", cut every {number(found['slice'])} s" if found["slice"] is not None else ""
    recorded = ", with its cuts" if found["cuts"] == "recorded" else ""
    return f"model {found['model']}, seed {found['seed']}, fuel {found['fuel']}{cuts}{recorded}"


def _end(found: dict[str, Any]) -> str:
    """Why it ended."""
    return found["short"] if found["ended"] is None else f"ended by {_plain(found['ended'])}"


def _events(found: dict[str, Any]) -> str:
    events = found["events"]
    kinds = ", ".join(counted(n, kind) for kind, n in events.items())
    return counted(sum(events.values()), "event") + (f" ({kinds})" if kinds else "")


def _lines(found: dict[str, Any]) -> list[str]:
    kinds = [("inputs", "input"), ("prints", "print"), ("snapshots", "snapshot")]
    counts = [counted(found[name], word) for name, word in kinds]
    hashes = "1 hash" if found["hashes"] == 1 else f"{found['hashes']:,} hashes"
    return [counted(found["lines"], "line"), *counts, hashes]


def _of_program(program: dict[str, Any]) -> str:
    return f"{program['sha256'][:12]} ({counted(program['lines'], 'line')})"


def _fate(death: dict[str, Any]) -> str:
    how = {"contact": "in a contact", "wall": "at a wall", "shot": "of a shot"}[death["how"]]
    by = {"contact": " with ", "shot": " of "}.get(death["how"])
    others = f"{by}{listed(death['with'])}" if by and death["with"] else ""
    others += f", which leaves {listed(death['left'])}" if death["left"] else ""
    verb = "die" if len(death["who"]) > 1 else "dies"
    return f"{number(death['time'])} s: {listed(death['who'])} {verb} {how}{others}"
