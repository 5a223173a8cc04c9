"""What whoever starts the app decides, and a place for sentences until it can show them. Pure."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from attrs import field, frozen

from fasteroids.tui.picture import View
from fasteroids.tui.settings import DEFAULTS, Settings

__all__ = ["Notices", "Options"]


@frozen
class Options:
    """What the command line decides.

    `folder` is where recordings and pictures go, None for nowhere; `seed` and `model` None where nobody says; `notes`
    are shown on the start screen; without `timer` the time of games goes on by `Play.go_on` alone.
    """

    view: View = field(factory=View)
    settings: Settings = DEFAULTS
    folder: Path | None = None
    sound: bool = False
    window: bool = False
    seed: int | None = None
    model: str = "smooth"
    notes: tuple[str, ...] = ()
    timer: bool = True


class Notices:
    """Takes sentences for the user, and keeps them until there is somewhere to show them."""

    def __init__(self) -> None:
        self._waiting: list[str] = []
        self._show: Callable[[str], object] | None = None

    def __call__(self, sentence: str) -> None:
        """Show a sentence, now or later."""
        if self._show is None:
            self._waiting.append(sentence)
        else:
            self._show(sentence)

    def shown_by(self, show: Callable[[str], object]) -> None:
        """From now on sentences are shown this way, those that wait first."""
        self._show = show
        for sentence in self._waiting:
            show(sentence)
        self._waiting.clear()
