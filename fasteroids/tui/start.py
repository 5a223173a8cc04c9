"""The start screen: it asks what to play, and says so to the app by `Start.Picked`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import ClassVar, Final, Literal, TypeAlias

from textual import events, work
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.message import Message
from textual.screen import Screen
from textual.worker import Worker

from fasteroids.tui.boxes import Ask, Choose
from fasteroids.tui.keyboard import KeyAgain
from fasteroids.tui.keys import Command, Keymap
from fasteroids.tui.launching import FILE, Library, NewGame, Recorded, SceneGame, Wanted
from fasteroids.tui.lists import Choices
from fasteroids.tui.menu import Entry, lines, listed
from fasteroids.tui.panels import Rows
from fasteroids.tui.recent import Brief
from fasteroids.tui.rows import Style

__all__ = ["TITLE", "Pick", "Start"]

TITLE: Final = r"""
 _____ _    ____ _____ _____ ____   ___ ___ ____  ____
|  ___/ \  / ___|_   _| ____|  _ \ / _ \_ _|  _ \/ ___|
| |_ / _ \ \___ \ | | |  _| | |_) | | | | || | | \___ \
|  _/ ___ \ ___) || | | |___|  _ <| |_| | || |_| |___) |
|_|/_/   \_\____/ |_| |_____|_| \_\\___/___|____/|____/
""".strip("\n")

_SHORT: Final = "F A S T E R O I D S"

Asking: TypeAlias = Literal["against", "watch", "scene", "recording"]
Choice: TypeAlias = Literal["one", "two", Asking, "scores", "keys", "quit"]
Pick: TypeAlias = Wanted | Literal["scores", "keys"]

_ENTRIES: Final = (
    Entry[Choice]("One player", "one", "waves of asteroids, three ships"),
    Entry[Choice]("Two players", "two", "the last ship wins"),
    Entry[Choice]("Against a program", "against", "one of those here, or your own"),
    Entry[Choice]("Programs against each other", "watch", "and you look on"),
    Entry[Choice]("Load a scene", "scene", "one of those here, or a file"),
    Entry[Choice]("Load a recording", "recording", "the last games, or a file"),
    Entry[Choice]("High scores", "scores"),
    Entry[Choice]("Keys", "keys", "look at them, change them"),
    Entry[Choice]("Quit", "quit"),
)


class Start(Screen[None], inherit_bindings=False):
    """The first screen, to which Esc leads back from anywhere."""

    BINDINGS: ClassVar[list[BindingType]] = []
    DEFAULT_CSS = """
    Start { align: center middle; overflow: hidden; background: #0b0e14; }
    Start > Rows { height: auto; }
    Start > #menu { height: 9; }
    """

    class Picked(Message):
        """What the player wants."""

        def __init__(self, picked: Pick) -> None:
            super().__init__()
            self.picked = picked

    class Asked(Message):
        """A command that is about the whole game."""

        def __init__(self, command: Command) -> None:
            super().__init__()
            self.command = command

    def __init__(
        self,
        library: Library,
        *,
        keymap: Keymap,
        seed: Callable[[], int],
        recent: Callable[[], list[Brief]],
        notes: tuple[str, ...] = (),
        model: str = "smooth",
    ) -> None:
        """`seed` draws one, `recent` tells the last recordings, `notes` are shown below."""
        super().__init__()
        self.keymap = keymap
        self._library, self._seed, self._recent = library, seed, recent
        self._notes, self._model = notes, model
        self._asking: Worker[None] | None = None

    def compose(self) -> ComposeResult:
        """A title, the choices, a line of notes."""
        yield Rows(id="title")
        yield Choices(_ENTRIES, id="menu")
        yield Rows(id="notes")

    @property
    def menu(self) -> Choices[Choice]:
        """The choices."""
        found: Choices[Choice] = self.query_one("#menu", Choices)
        return found

    def on_mount(self) -> None:
        """Take the room there is."""
        self._fit()

    def on_resize(self) -> None:
        """Another size."""
        self._fit()

    def _fit(self) -> None:
        columns, rows = self.size
        full = columns >= 60 and rows >= 20
        title = (*TITLE.split("\n"), "", "") if full else (_SHORT, "")
        notes = ("", *self._notes) if rows >= len(title) + len(_ENTRIES) + 1 + len(self._notes) else ()  # fmt: skip
        foot = lines("\n".join(notes), columns, Style.DIM) if notes else ()
        width = min(listed(_ENTRIES).width, columns)
        for name, made, wide in (
            ("#title", lines("\n".join(title), columns, Style.WARNING), max(map(len, title))),
            ("#notes", foot, max(map(len, notes), default=1)),
        ):
            widget = self.query_one(name, Rows)
            widget.styles.width, widget.styles.height = min(wide, columns), max(len(made), 1)
            widget.show(made)
        self.menu.styles.width = width
        self.menu.styles.height = max(min(len(_ENTRIES), rows - len(title) - len(notes)), 1)

    # Keys.

    def on_key(self, event: events.Key) -> None:
        """Move, choose, or a command."""
        if self.menu.key(event.key) or isinstance(event, KeyAgain):
            return
        if event.key in ("enter", "space"):
            self._chosen()
        elif event.key == "escape":
            self.post_message(self.Asked(Command.QUIT))
        elif (command := self.keymap.command(event.key)) is not None:
            self.post_message(self.Asked(command))

    def on_choices_chosen(self) -> None:
        """A click chooses."""
        self._chosen()

    def _chosen(self) -> None:
        entry = self.menu.menu.chosen
        if entry is None:
            return
        match entry.value:
            case "one":
                self._picked(NewGame("waves", (None,), self._seed(), self._model))
            case "two":
                self._picked(NewGame("duel", (None, None), self._seed(), self._model))
            case "against" | "watch" | "scene" | "recording" as kind:
                if self._asking is None or self._asking.is_finished:
                    self._asking = self._answered(kind)
            case "scores" | "keys" as kind:
                self._picked(kind)
            case "quit":
                self.post_message(self.Asked(Command.QUIT))

    def _picked(self, picked: Pick) -> None:
        self.post_message(self.Picked(picked))

    @work
    async def _answered(self, kind: Asking) -> None:
        wanted: Wanted | None
        match kind:
            case "against":
                wanted = await self._against()
            case "watch":
                wanted = await self._watch()
            case "scene":
                wanted = await self._scene()
            case "recording":
                wanted = await self._recording()
        if wanted is not None:
            self._picked(wanted)

    # Questions.

    async def _against(self) -> Wanted | None:
        name = await self._program("Which program is against you?")
        if not name:
            return None
        return NewGame("duel", (None, name), self._seed(), self._model)

    async def _watch(self) -> Wanted | None:
        first = await self._program("Which program flies the first ship?")
        second = None if not first else await self._program(f"Which one is against {first}?")
        if not first or not second:
            return None
        return NewGame("duel", (first, second), self._seed(), self._model)

    async def _scene(self) -> Wanted | None:
        name = await self._named("Which scene?", self._library.scenes(), "The path of a scene")
        if name is None:
            return None
        crews = (
            Entry[int]("You fly the first ship", 1),
            Entry[int]("Two players fly the first two", 2),
            Entry[int]("You look on", 0),
        )
        humans = await self.app.push_screen_wait(Choose(f"Who flies in {name}?", crews))
        return None if humans is None else SceneGame(name, humans)

    async def _program(self, title: str) -> str | None:
        return await self._named(title, self._library.programs(), "The path of a program")

    async def _named(self, title: str, known: Mapping[str, str], path: str) -> str | None:
        """One of those that come with the package, or the path of a file."""
        entries = [Entry[str](name, name, said) for name, said in known.items()]
        entries.append(Entry(FILE, ""))
        name = await self.app.push_screen_wait(Choose(title, entries, search=True))
        return await self._path(path) if name == "" else name

    async def _path(self, title: str) -> str | None:
        """The whole path of a file: a short one could be taken for a name, or for standard input."""
        path = await self.app.push_screen_wait(Ask(title))
        if path is None:
            return None
        with suppress(RuntimeError):  # there is no such user
            return str(Path(path).expanduser().absolute())
        return str(Path(path).absolute())

    async def _recording(self) -> Wanted | None:
        entries = [Entry(_said(each), str(each.place), each.title) for each in self._recent()]
        entries.append(Entry(FILE, ""))
        place: str | None = await self.app.push_screen_wait(Choose("Which recording?", entries))
        if place == "":
            place = await self._path("The path of a recording")
        return Recorded(Path(place)) if place else None


def _said(each: Brief) -> str:
    """When it was, and how long."""
    length = "" if each.seconds is None else f"{each.seconds:8.1f} s"
    return f"{each.when}  {length}"
