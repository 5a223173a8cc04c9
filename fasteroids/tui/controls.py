"""From keys to what ships are told: two players' hands as a value.

Two modes. `held`: the terminal reports when a key goes up, so a ship turns while its key is down, and thrusts while
its key is down. `steps`: it does not, and nothing tells a finger that stays down from one that taps; so a ship turns
by a step a press, a larger one while the key repeats, and the thruster is a switch. In both a shot is a press. The
first key that is seen to go up makes it `held`, for both players: they share the keyboard.

What happens within a frame is kept until `acted` asks. All functions are total: a key that goes up twice, or was never
down, changes nothing.
"""

from __future__ import annotations

from math import inf, isfinite, pi
from typing import Final, Literal, TypeAlias

from attrs import evolve, frozen

from fasteroids.actions import Action, Fire, Thrust, ThrustOff, Turn
from fasteroids.tui.keys import Command

__all__ = [
    "FIRST_TURN",
    "MOST_SHOTS",
    "REPEAT_DELAY",
    "REPEAT_GAP",
    "REPEAT_TURN",
    "STEP_TURN",
    "TURN_RATE",
    "Hand",
    "Hands",
    "Mode",
    "acted",
    "let_go",
    "pressed",
    "released",
    "reported",
    "synced",
]

Mode: TypeAlias = Literal["held", "steps"]

TURN_RATE: Final = 1.25 * pi
"""How fast a ship turns while its key is held, rad/s."""

FIRST_TURN: Final = pi / 60
"""What a press turns at once in mode `held`, rad: a tap shorter than a frame turns too."""

STEP_TURN: Final = pi / 24
"""What a press turns in mode `steps`, rad."""

REPEAT_TURN: Final = pi / 16
"""What a repeat turns in mode `steps`, rad."""

REPEAT_GAP: Final = 0.1
"""Presses of one key that come faster than this, s, are the terminal's repeats: they come 20 to 40 a second."""

REPEAT_DELAY: Final = 0.7
"""The first repeat comes within this time of the press, s; usual are 0.2 to 0.6."""

MOST_SHOTS: Final = 3
"""Shots kept for one call of `acted`; a ship has no more bullets at a time."""


@frozen
class Hand:
    """One player's: what is held, what is asked for since the last `acted`, and what the ship was told.

    `left`, `right`: is the key down (mode `held`)? `thrust`: is the thruster to be on? `told`: is it on, as far as the
    ship was told? `turn` rad and `shots` are still to be given. `before`: what the thruster was to be before the last
    press of its key. `since`: the user's seconds since each key was last pressed.
    """

    left: bool = False
    right: bool = False
    thrust: bool = False
    told: bool = False
    turn: float = 0.0
    shots: int = 0
    before: bool = False
    since: tuple[tuple[Command, float], ...] = ()

    def age(self, command: Command) -> float:
        """Seconds since the key of a command was last pressed; infinite if it never was."""
        return dict(self.since).get(command, inf)


@frozen
class Hands:
    """Both players' hands, and the mode of the keyboard."""

    mode: Mode = "steps"
    one: Hand = Hand()
    two: Hand = Hand()

    def of(self, player: Literal[1, 2]) -> Hand:
        """A player's."""
        return self.one if player == 1 else self.two


def _with(hands: Hands, player: Literal[1, 2], hand: Hand) -> Hands:
    return evolve(hands, one=hand) if player == 1 else evolve(hands, two=hand)


def pressed(hands: Hands, command: Command, *, again: bool = False) -> Hands:
    """A key went down; `again`: the terminal says that it is a repeat. Commands that fly no ship change nothing."""
    player = command.player
    if player is None:
        return hands
    hand = hands.of(player)
    hand = _held(hand, command, again) if hands.mode == "held" else _stepped(hand, command, again)
    ages = {**dict(hand.since), command: 0.0}
    return _with(hands, player, evolve(hand, since=tuple(ages.items())))


def _what(command: Command) -> str:
    return str(command.value).partition("-")[2]


def _held(hand: Hand, command: Command, again: bool) -> Hand:
    match _what(command):
        # A repeat of a key that is not known to be down: it was let go of by `let_go` and never went up.
        case "left":
            return hand if hand.left else evolve(hand, left=True, turn=hand.turn + FIRST_TURN)
        case "right":
            return hand if hand.right else evolve(hand, right=True, turn=hand.turn - FIRST_TURN)
        case "thrust":
            return evolve(hand, thrust=True)
    return hand if again else _shot(hand)


def _stepped(hand: Hand, command: Command, again: bool) -> Hand:
    age = hand.age(command)
    again = again or age < REPEAT_GAP
    step = REPEAT_TURN if again else STEP_TURN
    match _what(command):
        case "left":
            return evolve(hand, turn=hand.turn + step)
        case "right":
            return evolve(hand, turn=hand.turn - step)
        case "thrust" if again:
            # The key is held. If the press before this one was its first repeat, it switched by mistake.
            return evolve(hand, thrust=hand.before)
        case "thrust":
            # After a short time it may be the first repeat; what follows will tell.
            on = not hand.thrust
            return evolve(hand, thrust=on, before=hand.thrust if age < REPEAT_DELAY else on)
    return hand if again else _shot(hand)


def _shot(hand: Hand) -> Hand:
    return evolve(hand, shots=min(hand.shots + 1, MOST_SHOTS))


def released(hands: Hands, command: Command | None) -> Hands:
    """A key went up, of a command or of none: the mode is `held` from now on."""
    hands = reported(hands)
    player = None if command is None else command.player
    if command is None or player is None:
        return hands
    hand = hands.of(player)
    match _what(command):
        case "left":
            hand = evolve(hand, left=False)
        case "right":
            hand = evolve(hand, right=False)
        case "thrust":
            hand = evolve(hand, thrust=False)
    return _with(hands, player, hand)


def reported(hands: Hands) -> Hands:
    """The terminal is known to report when keys go up. A thruster that was switched on stays on until then."""
    return hands if hands.mode == "held" else evolve(hands, mode="held")


def let_go(hands: Hands) -> Hands:
    """All keys are let go of, as when the game is paused or the terminal loses the focus: thrusters go off."""

    def emptied(hand: Hand) -> Hand:
        return Hand(told=hand.told)

    return evolve(hands, one=emptied(hands.one), two=emptied(hands.two))


def synced(hands: Hands, player: Literal[1, 2], thruster: bool) -> Hands:
    """The player flies another ship now, or the same one at another time, whose thruster is as told.

    A switch (mode `steps`) is as the ship is; a key that is held goes on to say what the ship is to do.
    """
    hand = hands.of(player)
    wanted = thruster if hands.mode == "steps" else hand.thrust
    return _with(hands, player, evolve(hand, told=thruster, thrust=wanted, before=wanted))


def acted(
    hands: Hands, elapsed: float, *, speed: float = 1.0
) -> tuple[Hands, tuple[tuple[Literal[1, 2], Action], ...]]:
    """What the players' ships are told now, `elapsed` seconds after the last time, and the hands after it.

    For each player, in this order: a turn, the thruster if it changes, shots. `speed` is how much time passes in the
    game meanwhile, per second: a held key turns a ship in the game's time, while keys repeat in that of the user.
    Either that is negative or not finite counts as 0. The same time cut into more calls turns a ship by the same angle.
    """
    elapsed, speed = _sound(elapsed), _sound(speed)
    one, first = _acted(hands.one, elapsed, speed)
    two, second = _acted(hands.two, elapsed, speed)
    told: list[tuple[Literal[1, 2], Action]] = [(1, action) for action in first]
    told += [(2, action) for action in second]
    return Hands(hands.mode, one, two), tuple(told)


def _sound(number: float) -> float:
    return number if isfinite(number) and number > 0 else 0.0


def _acted(hand: Hand, elapsed: float, speed: float) -> tuple[Hand, list[Action]]:
    angle = hand.turn + (hand.left - hand.right) * TURN_RATE * elapsed * speed
    actions: list[Action] = [Turn(angle)] if angle and isfinite(angle) else []
    if hand.thrust != hand.told:
        actions.append(Thrust() if hand.thrust else ThrustOff())
    actions += [Fire()] * hand.shots
    ages = ((command, age + elapsed) for command, age in hand.since)
    after = Hand(
        hand.left,
        hand.right,
        hand.thrust,
        told=hand.thrust,
        before=hand.before,
        since=tuple((command, age) for command, age in ages if age < REPEAT_DELAY),
    )
    return after, actions
