"""L12: the machine of ship programs. Its small steps are the definition; everything else agrees with them."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from attrs import evolve
from hypothesis import given, settings
from hypothesis import strategies as st

from fasteroids.actions import Program as WorldProgram
from fasteroids.actions import View
from fasteroids.lang.code import Code, compiled
from fasteroids.lang.machine import (
    Each,
    Frame,
    Halted,
    Machine,
    Running,
    place,
    refreshed,
    run,
    run_by_steps,
    started,
    step,
    tick,
)
from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.saved import restored, saved
from fasteroids.lang.syntax import (
    Block,
    Declaration,
    ForEach,
    Name,
    Print,
    Program,
)
from fasteroids.lang.values import Seen, type_of
from fasteroids.testing import DictView, histories, programs, trees, views
from fasteroids.units import ModelError
from tests.properties.laws import EXAMPLES

STEPS = 100
"""Small steps looked at one by one."""

step_law = settings(max_examples=min(2_000, max(30, EXAMPLES // 3)))
"""Laws that look at every step."""

fuels = st.one_of(st.integers(0, 60), st.integers(0, 2_000))


def ready(program: Program) -> Code:
    """A generated tree with its text."""
    return compiled(evolve(program, source=printed(program)))


codes = st.one_of(programs(), programs(actions=False)).map(ready)
"""Well-typed programs."""

wild_codes = st.one_of(codes, trees().map(ready))
"""Any programs, ill-typed ones too."""


def states(code: Code, view: View, most: int = STEPS) -> Iterator[Machine]:
    """The machines of a program, step by step."""
    machine = started(code)
    yield machine
    for _ in range(most):
        if isinstance(machine, Halted):
            return
        machine = step(machine, view).machine
        yield machine


def everything(machine: Machine) -> Any:
    """All that is in a machine, as text of JSON."""
    return json.dumps(saved(machine))


def ticked(code: Code, history: tuple[DictView, ...], fuel: int) -> list[Any]:
    """What the ticks of a program give."""
    machine: WorldProgram = started(code)
    log: list[Any] = []
    for view in history:
        gave = machine.tick(evolve(view, fuel=fuel))
        machine = gave.program
        log.append(gave)
    return log


@given(wild_codes, views(), fuels)
def test_L12_a_run_by_closures_is_a_run_by_steps(code: Code, view: DictView, fuel: int) -> None:
    fast, plain = started(code), started(code)
    for _ in range(4):
        a, b = run(fast, view, fuel), run_by_steps(plain, view, fuel)
        assert a == b
        assert everything(a.machine) == everything(b.machine)
        fast, plain = a.machine, b.machine


@step_law
@given(wild_codes, views(), st.lists(st.integers(0, 40), max_size=30))
def test_L12_closures_and_steps_agree_from_wherever_fuel_ran_out(
    code: Code, view: DictView, fuels: list[int]
) -> None:
    machine = started(code)
    for fuel in fuels:
        a = run(machine, view, fuel)
        assert a == run_by_steps(machine, view, fuel)
        machine = a.machine


@step_law
@given(wild_codes, views(), fuels, fuels)
def test_L12_fuel_adds_up(code: Code, view: DictView, n: int, m: int) -> None:
    whole = run(started(code), view, n + m)
    first = run(started(code), view, n)
    if first.action is not None or isinstance(first.machine, Halted):
        assert whole == first._replace(left=first.left + m)
    else:
        assert first.left == 0
        rest = run(first.machine, view, m)
        assert whole == rest._replace(prints=first.prints + rest.prints)


@step_law
@given(wild_codes, histories(), fuels)
def test_L12_determinism(code: Code, history: tuple[DictView, ...], fuel: int) -> None:
    again = pickle.loads(pickle.dumps(code))
    assert ticked(code, history, fuel) == ticked(again, history, fuel)


@step_law
@given(wild_codes, views(), st.integers(0, STEPS), fuels)
def test_L12_save_and_resume_between_any_two_steps(
    code: Code, view: DictView, at: int, fuel: int
) -> None:
    for machine in states(code, view, at):
        text = json.dumps(saved(machine), allow_nan=False)
        again = restored(json.loads(text), {code.source: code}.__getitem__)
        assert again == machine
        assert hash(again) == hash(machine)
        assert everything(again) == text
    assert run(again, view, fuel) == run(machine, view, fuel)


@step_law
@given(wild_codes, views())
def test_L12_a_step_changes_nothing_of_what_was_before(code: Code, view: DictView) -> None:
    path = list(states(code, view))
    pictures = [everything(machine) for machine in path]
    copies = [copy.deepcopy(machine) for machine in path]
    for machine, following in pairwise(path):
        assert isinstance(machine, Running)
        assert step(machine, view).machine == following
        run(machine, view, 50)
        tick(machine, view, 50)
    assert [everything(machine) for machine in path] == pictures
    assert path == copies


@step_law
@given(wild_codes, views())
def test_L12_progress_no_step_raises_and_no_frame_stands_at_an_end(
    code: Code, view: DictView
) -> None:
    for machine in states(code, view):
        place(machine)
        if isinstance(machine, Halted):
            assert machine.reason is None or machine.span is not None
            break
        assert machine.todo
        for frame in machine.todo:
            assert 0 <= frame.index < len(code.blocks[frame.block])
        for frame in machine.todo.rest:
            assert isinstance(frame, Each) or (frame.done, frame.operands) == (0, ())


@step_law
@given(codes, views())
def test_L12_progress_a_checked_program_is_stuck_only_on_null_and_wild_turns(
    code: Code, view: DictView
) -> None:
    *_, last = states(code, view)
    if isinstance(last, Halted) and last.reason is not None:
        null = last.reason.startswith("get") and "null" in last.reason
        assert null or last.reason.startswith(("turn nan", "turn inf", "turn -inf"))


@step_law
@given(wild_codes, views())
def test_L12_preservation_a_variable_keeps_its_type(code: Code, view: DictView) -> None:
    types = {name: type_of(value) for name, value in code.defaults.items()}
    for machine in states(code, view):
        assert {name: type_of(value) for name, value in machine.store.items()} == types


@step_law
@given(codes, histories(), st.integers(1, 200))
def test_L12_the_living_are_seen_anew_and_the_dead_as_they_were(
    code: Code, history: tuple[DictView, ...], fuel: int
) -> None:
    machine = started(code)
    for view in history:
        again = refreshed(machine, view)
        if isinstance(machine, Halted):
            assert again is machine  # nobody reads its variables any more
            break
        assert held(again) == [view.entity(seen.id) or seen for seen in held(machine)]
        assert refreshed(again, view) == again
        machine = run(again, view, fuel).machine


def held(machine: Machine) -> list[Seen]:
    """The entities a machine holds, in its variables and in what it has to do."""
    found: list[Any] = [machine.store[name] for name in sorted(machine.store)]
    if isinstance(machine, Running):
        for frame in machine.todo:
            found += frame.operands if isinstance(frame, Frame) else frame.rest
    return [value for value in found if isinstance(value, Seen)]


_VISITS = Program(
    Block(
        (
            Declaration("entity", Name("e")),
            ForEach("any", Name("e"), Block((Print(Name("e")),))),
        )
    ),
    "visits",
)


@step_law
@given(histories(ticks=6), st.integers(1, 4), st.booleans())
def test_L12_a_for_each_visits_in_order_who_lived_when_it_began(
    history: tuple[DictView, ...], fuel: int, by_steps: bool
) -> None:
    machine = started(compiled(_VISITS))
    prints: list[str] = []
    for view in (*history, *[history[-1]] * 40):
        machine = refreshed(machine, view)
        ran = (run_by_steps if by_steps else run)(machine, view, fuel)
        machine, prints = ran.machine, [*prints, *ran.prints]
    first = history[0]
    assert isinstance(machine, Halted)
    assert prints == [f"{first.entities[i].kind} {i}" for i in first.ids("any")]


# What a forged record can do: nothing.

json_values = st.recursive(
    st.one_of(
        st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=4),
        st.sampled_from(["inf", "ship", "todo", "reason"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(
            st.one_of(
                st.text(max_size=3),
                st.sampled_from(["source", "store", "todo", "block", "index", "done", "operands"]),
            ),
            inner,
            max_size=5,
        ),
    ),
    max_leaves=20,
)  # fmt: skip


def paths(value: Any) -> list[tuple[Any, ...]]:
    """Every place in a JSON value."""
    found: list[tuple[Any, ...]] = [()]
    if isinstance(value, dict | list):
        inner = value.items() if isinstance(value, dict) else enumerate(value)
        found += [(key, *path) for key, part in inner for path in paths(part)]
    return found


def put(value: Any, path: tuple[Any, ...], new: Any) -> Any:
    """A JSON value with another one at a place."""
    if not path:
        return new
    value = copy.copy(value)
    value[path[0]] = put(value[path[0]], path[1:], new)
    return value


some_codes = st.sampled_from(["", "double x;", "bool p; while (p) { }"]).map(
    lambda text: compiled(parse_program(text).tree)
)


@given(some_codes, json_values)
def test_any_json_value_is_a_machine_or_a_model_error(code: Code, record: Any) -> None:
    try:
        machine = restored(record, lambda _: code)
    except ModelError:
        return
    assert restored(saved(machine), lambda _: code) == machine


@step_law
@given(wild_codes, views(), st.integers(0, STEPS), st.data())
def test_a_forged_record_is_refused_or_runs_like_any_other(
    code: Code, view: DictView, at: int, data: st.DataObject
) -> None:
    record = saved(list(states(code, view, at))[-1])
    for _ in range(data.draw(st.integers(1, 3))):
        path = data.draw(st.sampled_from(paths(record)))
        new = data.draw(st.one_of(st.integers(-1, 6), json_values))
        record = put(record, path, new)
    try:
        machine = restored(record, lambda _: code)
    except ModelError:
        return
    types = {name: type_of(value) for name, value in code.defaults.items()}
    assert {name: type_of(value) for name, value in machine.store.items()} == types
    assert run(machine, view, 200) == run_by_steps(machine, view, 200)
    assert restored(saved(machine), lambda _: code) == machine
