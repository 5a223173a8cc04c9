"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import Any, TypeVar

import click

from fasteroids import models
from fasteroids.units import ModelError

__all__ = [
    "MAX_EVENTS",
    "SPAN",
    "BotNames",
    "Seconds",
    "bots",
    "max_events",
    "model",
    "scene",
    "seed",
    "span",
]

F = TypeVar("F", bound=Callable[..., Any])

SPAN = 20.0
"""Simulated seconds of a run, if nobody says."""

MAX_EVENTS = 1_000_000
"""Events of a run, if nobody says. A bound, because a scene can have any number of events in a second."""


class Seconds(click.ParamType[float]):
    """A finite number of seconds, at least 0, or above 0 if `positive`."""

    name = "S"

    def __init__(self, *, positive: bool = False) -> None:
        self.positive = positive

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """The number, or a usage error."""
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = -1.0
        if not 0.0 <= number < inf or (self.positive and number == 0.0):
            allowed = "above 0" if self.positive else "0 or more"
            self.fail(f"must be a finite number of seconds, {allowed}; got {value!r}", param, ctx)
        return number


class ModelName(click.ParamType[str]):
    """The name of a model."""

    name = "M"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The name, or a usage error that lists the names there are."""
        try:
            return models.named(value).name
        except ModelError as error:
            self.fail(str(error), param, ctx)

    def shell_complete(
        self, _ctx: click.Context, _param: click.Parameter, incomplete: str
    ) -> list[click.shell_completion.CompletionItem]:
        """The names that begin so."""
        return [
            click.shell_completion.CompletionItem(name)
            for name in models.MODELS
            if name.startswith(incomplete)
        ]


class BotNames(click.ParamType[tuple[str, ...]]):
    """Names of programs with commas between them."""

    name = "A,B,..."

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, ...]:
        """The names, without the blanks around them; a usage error if one is empty."""
        if isinstance(value, tuple):  # a default
            return value
        names = tuple(name.strip() for name in value.split(","))
        if not all(names):
            self.fail(
                f"must be names of programs with commas between them; got {value!r}", param, ctx
            )
        return names


def scene(command: F) -> F:
    """SCENE: a file, standard input, or a shipped scene."""
    return click.argument("scene", type=click.Path(allow_dash=True))(command)


def span(command: F) -> F:
    """--for."""
    return click.option(
        "--for", "span", type=Seconds(), default=SPAN, show_default=True,
        help="Simulated seconds, from the time of the scene on.",
    )(command)  # fmt: skip


def max_events(command: F) -> F:
    """--max-events."""
    return click.option(
        "--max-events", type=click.IntRange(min=0), default=MAX_EVENTS, show_default=True, metavar="N",
        help="Stop after so many events.",
    )(command)  # fmt: skip


def model(command: F) -> F:
    """--model."""
    return click.option(
        "--model", type=ModelName(), metavar="M",
        help=f"Use this model instead of the scene's: {', '.join(models.MODELS)}.",
    )(command)  # fmt: skip


def seed(command: F) -> F:
    """--seed."""
    return click.option(
        "--seed", type=int, metavar="N", help="Use this seed instead of the scene's."
    )(command)


def bots(command: F) -> F:
    """--bots."""
    return click.option(
        "--bots", type=BotNames(), default=(), metavar="A[,B...]",
        help="Programs for the ships, in the order of their ids, instead of the scene's: files, or names of those "
        "that come with the package.",
    )(command)  # fmt: skip
