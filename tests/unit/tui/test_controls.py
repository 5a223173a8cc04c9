"""From keys to actions, with and without keys that are seen to go up."""

from __future__ import annotations

from math import inf, nan
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fasteroids.actions import Action, Fire, Thrust, ThrustOff, Turn
from fasteroids.tui.controls import (
    FIRST_TURN,
    MOST_SHOTS,
    REPEAT_TURN,
    STEP_TURN,
    TURN_RATE,
    Hands,
    acted,
    let_go,
    pressed,
    released,
    reported,
    synced,
)
from fasteroids.tui.keys import FLIGHT, Command

LEFT, RIGHT = Command.ONE_LEFT, Command.ONE_RIGHT
THRUST, FIRE = Command.ONE_THRUST, Command.ONE_FIRE
HELD = reported(Hands())


def told(hands: Hands, elapsed: float = 0.0, *, speed: float = 1.0) -> list[Action]:
    """What player one's ship is told now."""
    return [action for player, action in acted(hands, elapsed, speed=speed)[1] if player == 1]


def after(hands: Hands, elapsed: float) -> Hands:
    return acted(hands, elapsed)[0]


def held_for(command: Command, seconds: float, *, delay: float = 0.5, gap: float = 0.03) -> Hands:
    """A key that is held on a terminal that only repeats: a press, and repeats that look like presses."""
    hands = pressed(Hands(), command)
    now, following = 0.0, delay
    while following <= seconds:
        hands = pressed(after(hands, following - now), command)
        now, following = following, following + gap
    return hands


# Held.


def test_a_ship_turns_while_its_key_is_down() -> None:
    down = after(pressed(HELD, LEFT), 0.0)
    assert told(down, 0.5) == [Turn(TURN_RATE * 0.5)]
    assert told(after(down, 0.5), 0.25) == [Turn(TURN_RATE * 0.25)]
    assert told(released(down, LEFT), 0.5) == []


def test_a_tap_shorter_than_a_frame_turns_and_thrusts_not() -> None:
    tapped = released(pressed(HELD, RIGHT), RIGHT)
    assert told(tapped, 0.03) == [Turn(-FIRST_TURN)]
    assert told(released(pressed(HELD, THRUST), THRUST), 0.03) == []


def test_both_sides_at_once_turn_nowhere() -> None:
    assert told(pressed(pressed(HELD, LEFT), RIGHT), 1.0) == []


def test_the_thruster_is_on_while_its_key_is_down_and_told_once() -> None:
    down = pressed(HELD, THRUST)
    assert told(down) == [Thrust()]
    assert told(after(down, 0.1)) == []
    up = released(after(down, 0.1), THRUST)
    assert told(up) == [ThrustOff()]
    assert told(after(up, 0.1)) == []


def test_repeats_that_the_terminal_reports_change_nothing() -> None:
    down = HELD
    for command in (LEFT, THRUST, FIRE):
        down = pressed(down, command)
    again = down
    for command in (LEFT, THRUST, FIRE):
        again = pressed(again, command, again=True)
    assert (
        told(again, 0.1)
        == told(down, 0.1)
        == [Turn(FIRST_TURN + TURN_RATE * 0.1), Thrust(), Fire()]
    )


def test_slow_motion_slows_a_turn_down() -> None:
    down = after(pressed(HELD, LEFT), 0.0)
    assert told(down, 0.5, speed=0.25) == [Turn(TURN_RATE * 0.5 * 0.25)]


def test_a_finger_that_stays_down_over_a_pause_is_noticed_by_its_next_repeat() -> None:
    paused = let_go(after(pressed(HELD, THRUST), 0.1))
    assert told(paused) == [ThrustOff()]
    assert told(pressed(after(paused, 0.0), THRUST, again=True)) == [Thrust()]


@given(st.lists(st.floats(0, 0.2), max_size=20))
def test_frames_of_any_length_turn_by_the_same_angle(cuts: list[float]) -> None:
    hands, whole = after(pressed(HELD, LEFT), 0.0), sum(cuts)
    turned = 0.0
    for cut in cuts:
        hands, actions = acted(hands, cut)
        turned += sum(action.angle for _, action in actions if isinstance(action, Turn))
    assert turned == pytest.approx(TURN_RATE * whole)


# Steps.


def test_a_press_turns_by_a_step_and_time_by_nothing() -> None:
    once = pressed(Hands(), LEFT)
    assert told(once, 0.5) == [Turn(STEP_TURN)]
    assert told(after(once, 0.5), 0.5) == []


def test_a_key_that_repeats_turns_by_larger_steps() -> None:
    assert told(pressed(after(after(pressed(Hands(), LEFT), 0.01), 0.02), LEFT)) == [
        Turn(REPEAT_TURN)
    ]
    assert told(pressed(after(pressed(Hands(), LEFT), 0.15), LEFT)) == [Turn(STEP_TURN)]


def test_the_thruster_is_a_switch() -> None:
    on = after(pressed(Hands(), THRUST), 1.0)
    assert told(pressed(Hands(), THRUST)) == [Thrust()]
    assert told(on) == []
    assert told(pressed(on, THRUST)) == [ThrustOff()]


def test_two_quick_presses_switch_on_and_off() -> None:
    twice = pressed(after(pressed(Hands(), THRUST), 0.2), THRUST)
    assert told(twice) == [ThrustOff()]
    assert told(after(twice, 0.5)) == []


@pytest.mark.parametrize("delay", [0.2, 0.25, 0.4, 0.5, 0.66])
@pytest.mark.parametrize("gap", [0.025, 0.033, 0.05, 0.09])
def test_a_finger_that_stays_on_thrust_leaves_it_on(delay: float, gap: float) -> None:
    held = held_for(THRUST, delay + 7 * gap, delay=delay, gap=gap)
    assert held.one.thrust
    # A while later another one, held as long, leaves it off.
    hands = pressed(after(held, 2.0), THRUST)
    hands = pressed(after(hands, delay), THRUST)
    for _ in range(5):
        hands = pressed(after(hands, gap), THRUST)
    assert not hands.one.thrust


def test_a_finger_that_stays_on_fire_shoots_no_stream() -> None:
    assert len(told(held_for(FIRE, 0.0))) == 1
    hands, shots = pressed(Hands(), FIRE), 0
    for elapsed in (0.5, *[0.03] * 30):
        hands, actions = acted(hands, elapsed)
        shots += len(actions)
        hands = pressed(hands, FIRE)
    assert shots <= 2


def test_keys_repeat_in_the_users_time_whatever_the_speed_of_the_game() -> None:
    for speed in (0.1, 1.0, 16.0):
        hands, _ = acted(pressed(Hands(), LEFT), 0.03, speed=speed)
        assert told(pressed(hands, LEFT)) == [Turn(REPEAT_TURN)]


# Which of the two.


def test_the_first_key_that_goes_up_makes_the_mode_held_and_ends_what_it_began() -> None:
    hands = after(pressed(pressed(Hands(), THRUST), LEFT), 0.1)
    assert hands.mode == "steps"
    left_up = released(hands, LEFT)
    assert left_up.mode == "held"
    assert told(left_up) == []
    assert told(released(left_up, THRUST)) == [ThrustOff()]


def test_a_key_that_flies_nothing_tells_the_mode_too() -> None:
    assert released(Hands(), None).mode == "held"
    assert released(Hands(), Command.HELP).mode == "held"


# Both.


def test_two_players_do_not_disturb_each_other() -> None:
    hands = HELD
    for command in (LEFT, Command.TWO_RIGHT, Command.TWO_THRUST, FIRE):
        hands = pressed(hands, command)
    hands, actions = acted(released(hands, LEFT), 0.0)
    assert actions == (
        (1, Turn(FIRST_TURN)),
        (1, Fire()),
        (2, Turn(-FIRST_TURN)),
        (2, Thrust()),
    )
    assert acted(hands, 1.0)[1] == ((2, Turn(-TURN_RATE)),)


def test_a_shot_a_press_but_no_more_than_a_ship_can_have() -> None:
    hands = HELD
    for count in range(1, 6):
        hands = pressed(hands, FIRE)
        assert told(hands) == [Fire()] * min(count, MOST_SHOTS)
    assert told(after(hands, 0.0)) == []


@pytest.mark.parametrize("hands", [Hands(), HELD])
def test_letting_go_releases_everything(hands: Hands) -> None:
    for command in FLIGHT:
        hands = pressed(hands, command)
    hands, _ = acted(hands, 0.1)
    for command in FLIGHT:
        hands = pressed(hands, command)
    hands, actions = acted(let_go(hands), 1.0)
    assert actions == ((1, ThrustOff()), (2, ThrustOff()))
    assert acted(hands, 1.0)[1] == ()


def test_a_ship_taken_over_is_told_what_the_hand_wants() -> None:
    assert told(synced(Hands(), 1, True)) == []
    assert told(pressed(synced(Hands(), 1, True), THRUST)) == [ThrustOff()]
    assert told(synced(HELD, 1, True)) == [ThrustOff()]
    assert told(synced(after(pressed(HELD, THRUST), 0.0), 1, False)) == [Thrust()]


moves = st.one_of(
    st.tuples(st.just("down"), st.sampled_from(list(Command))),
    st.tuples(st.just("again"), st.sampled_from(list(Command))),
    st.tuples(st.just("up"), st.sampled_from([None, *Command])),
    st.tuples(st.just("let go"), st.none()),
    st.tuples(st.just("frame"), st.sampled_from([0.0, 0.03, 0.6, -1.0, inf, nan, 1e308])),
    st.tuples(st.just("ship"), st.booleans()),
)


@given(st.lists(moves, max_size=30))
def test_whatever_comes_ships_are_told_sound_things_and_no_thruster_twice(
    script: list[tuple[str, object]],
) -> None:
    hands = Hands()
    on: dict[Literal[1, 2], bool] = {1: False, 2: False}
    for move, what in script:
        if isinstance(what, Command) or (move == "up" and what is None):
            if move == "up":
                hands = released(hands, what if isinstance(what, Command) else None)
            elif isinstance(what, Command):
                hands = pressed(hands, what, again=move == "again")
        elif isinstance(what, bool):
            hands, on[2] = synced(hands, 2, what), what
        elif isinstance(what, float):
            hands, actions = acted(hands, what)
            for player, action in actions:
                if isinstance(action, Thrust | ThrustOff):
                    assert on[player] is isinstance(action, ThrustOff)
                    on[player] = isinstance(action, Thrust)
                elif isinstance(action, Turn):
                    assert abs(action.angle) < inf
        else:
            hands = let_go(hands)
