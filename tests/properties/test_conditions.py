"""Laws of conditions: any text is one or is refused, and one holds where an `if` of a program takes its branch."""

from __future__ import annotations

from hypothesis import example, given
from hypothesis import strategies as st

from fasteroids import ModelError, Ship, World, check_program, parse_program
from fasteroids.entities import id_of
from fasteroids.history import Condition, condition
from fasteroids.lang.machine import run_by_steps
from fasteroids.rules import ShipView
from fasteroids.testing import worlds

PIECES = (
    "getx", "getvy", "getradius", "getdir", "self", "null", "true", "false", "sqrt", "sin", "-", "+", "*", "/", "%",
    "&&", "||", "!", "==", "!=", "<", ">=", "(", ")", "0", "1.5", "100", "x", "\n", "// so\n", "}", "{", ";", ":=",
)  # fmt: skip

FLEETS = worlds(flavours=("ordinary", "thin"), min_size=1, max_size=4, kinds=(Ship,))


def texts() -> st.SearchStrategy[str]:
    """Expressions that are well-typed, and rows of pieces, which seldom are."""
    double = st.deferred(
        lambda: (
            st.sampled_from(["0", "1.5", "64", "getdir", "getx self", "getvy self", "getx null"])
            | st.builds("({} {} {})".format, double, st.sampled_from("+-*/%"), double)
            | st.builds("({} {})".format, st.sampled_from(["-", "sqrt", "sin"]), double)
        )
    )
    truth = st.deferred(
        lambda: (
            st.sampled_from(["true", "false", "self == null", "self != self"])
            | st.builds(
                "({} {} {})".format, double, st.sampled_from(["<", ">=", "==", "!="]), double
            )
            | st.builds("({} {} {})".format, truth, st.sampled_from(["&&", "||", "=="]), truth)
            | st.builds("!{}".format, truth)
        )
    )
    rows = st.lists(st.sampled_from(PIECES), max_size=12).map(" ".join)
    return truth | rows | st.text(max_size=20)


def made(text: str, ship: Ship) -> Condition | None:
    """The condition, if the text is one; any other error than that of the caller is one of ours."""
    try:
        return condition(text, ship)
    except ModelError:
        return None


@given(texts(), FLEETS)
@example("true) {} if (true", World(100, 100).add(Ship(50, 50, 0, 0, 1, 1, 0)))
@example("true // ) {", World(100, 100).add(Ship(50, 50, 0, 0, 1, 1, 0)))
def test_a_condition_holds_where_an_if_takes_its_branch(text: str, world: World) -> None:
    program = check_program(parse_program(f"if (\n{text}\n) {{ print 1; }}")).program
    for ship in world.ships:
        asks = made(text, ship)
        if asks is None:
            continue
        assert program is not None
        ran = run_by_steps(program, ShipView(world, ship), world.fuel)
        assert asks(world) == (ran.prints == ("1.0",))
        assert not asks(world.remove(id_of(ship)))


@given(texts(), FLEETS)
def test_what_is_refused_is_no_condition_of_an_if(text: str, world: World) -> None:
    ship = world.ships[0]
    alone = parse_program(f"if (\n{text}\n) {{ }}")
    if made(text, ship) is None and ")" not in text:
        assert check_program(alone).program is None
