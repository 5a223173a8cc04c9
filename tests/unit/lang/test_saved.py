"""Machines as JSON, and what is refused on the way back."""

from __future__ import annotations

import json
from typing import Any

import pytest

from fasteroids.lang.machine import Machine, run, run_by_steps
from fasteroids.lang.saved import restored, saved
from fasteroids.units import ModelError
from tests.unit.lang.running import loaded, ready, stepped, to_the_end, view

LOOP = """
double x := 0 / 0;
double y := -1 / 0;
bool p;
entity e;
foreach (any, e) {
  if (getx e > 20) { x := getx e; } else { if (p) { skip; } else { x := 1 + x; } }
}
while (true) { print e; fire; }
"""


EVERY_NODE = """
double x; bool p; entity e;
while (true) {
  p := !p && (getdir < 3 || true) || e == null && false;
  x := -(x + sqrt(4)) % cos(0);
  if (1 < 2 && (false || p != true)) { e := self; }
  p := false || (true && x >= 1);
}
"""


def through_text(machine: Machine) -> Machine:
    """Saved as strict JSON and back."""
    return restored(json.loads(json.dumps(saved(machine), allow_nan=False)), ready)


@pytest.mark.parametrize("text", [LOOP, EVERY_NODE])
def test_a_machine_in_the_middle_comes_back(text: str) -> None:
    for steps in range(120):
        machine = stepped(loaded(text), steps)
        again = through_text(machine)
        assert again == machine
        assert run(again, view(), 500) == run_by_steps(machine, view(), 500)


def test_a_record_is_plain_and_readable() -> None:
    machine = stepped(loaded("double x := 1 / 0; entity e; foreach (ship, e) { print 1 + x; }"), 6)
    assert saved(machine) == {
        "source": "double x := 1 / 0; entity e; foreach (ship, e) { print 1 + x; }",
        "store": {
            "e": {"id": 1, "kind": "ship", "x": 10.0, "y": 20.0, "vx": 1.0, "vy": -1.0, "radius": 5.0},
            "x": "inf",
        },
        "todo": [
            {"block": 1, "index": 0, "done": 1, "operands": [1.0]},
            {
                "block": 0,
                "index": 1,
                "rest": [{"id": 4, "kind": "ship", "x": 90.0, "y": 90.0, "vx": 0.0, "vy": 0.0, "radius": 6.0}],
            },
        ],
    }  # fmt: skip


@pytest.mark.parametrize("text", ["print 1;", "entity a;\nprint getx a;", "print true + true;"])
def test_a_halted_machine_comes_back_with_its_reason(text: str) -> None:
    machine, _ = to_the_end(text)
    assert through_text(machine) == machine


def test_a_whole_number_is_a_double_too() -> None:
    record = saved(stepped(loaded("double x; print x + 1;"), 2))
    record["store"]["x"] = 3
    assert restored(record, ready).store["x"] == 3.0
    assert type(restored(record, ready).store["x"]) is float


def test_what_the_text_is_refused_for_is_passed_on() -> None:
    def refusing(_: str) -> Any:
        raise ModelError("the program has errors")

    with pytest.raises(ModelError, match="the program has errors"):
        restored(saved(loaded("skip;")), refusing)


TEXT = "double x; bool p; entity e; while (x < 2) { if (p) { x := x + 1; } foreach (any, e) { print 1; } }"


def record(steps: int = 11) -> dict[str, Any]:
    """Half way through `print 1` in the for-each in the loop."""
    return saved(stepped(loaded(TEXT), steps))


def test_the_record_that_is_forged_below_is_right_as_it_is() -> None:
    good = record()
    assert [f["block"] for f in good["todo"]] == [3, 1, 0]
    assert "rest" in good["todo"][1]
    assert restored(good, ready) == stepped(loaded(TEXT), 11)


@pytest.mark.parametrize(
    ("forge", "complaint"),
    [
        (lambda r: r.pop("store"), "a saved program must be an object with the fields"),
        (lambda r: r.update(more=1), "a saved program must be an object with the fields"),
        (lambda r: r.update(source=1), "source must be a text"),
        (lambda r: r.update(store=[]), "store must be an object with the program's variables"),
        (lambda r: r["store"].update(z=1.0), "store must be an object with the program's variables"),
        (lambda r: r["store"].update(x=True), "x must be a number"),
        (lambda r: r["store"].update(x="infinite"), "x must be a number"),
        (lambda r: r["store"].update(x=10**400), "x must be a number"),
        (lambda r: r["store"].update(x=float("nan")), "x must be a number"),
        (lambda r: r["store"].update(p=1), "p must be true or false"),
        (lambda r: r["store"].update(e=3), "e must be an object with the fields"),
        (lambda r: r["store"]["e"].update(kind="planet"), "kind of e must be ship, asteroid or bullet"),
        (lambda r: r["store"]["e"].update(id=0), "id of e must be a whole number, 1 or more"),
        (lambda r: r["store"]["e"].update(x=None), "x of e must be a number"),
        (lambda r: r.update(todo=[]), "todo must have a frame"),
        (lambda r: r.update(todo={}), "todo must be a list"),
        (lambda r: r["todo"].pop(), "todo must have its frames as the blocks of the text lie"),
        (lambda r: r["todo"].pop(0), None),  # the for-each itself: a state it may be in
        (lambda r: r["todo"].pop(1), "todo must have its frames as the blocks of the text lie"),
        (lambda r: r["todo"].reverse(), "todo must have its frames as the blocks of the text lie"),
        (lambda r: r["todo"][0].update(block=4), "block of a frame must be a whole number, between 0 and 3"),
        (lambda r: r["todo"][0].update(block=True), "block of a frame must be a whole number"),
        (lambda r: r["todo"][0].update(index=1), "index of a frame must be a whole number, between 0 and 0"),
        (lambda r: r["todo"][0].update(done=2), "done of a frame must be a whole number, between 0 and 1"),
        (lambda r: r["todo"][0].update(done=0), "0 operands must wait after 0 nodes; got 1"),
        (lambda r: r["todo"][0].update(operands=[True]), "an operand must be a number"),
        (lambda r: r["todo"][0].update(operands=[1.0, 2.0]), "1 operands must wait after 1 nodes; got 2"),
        (lambda r: r["todo"][1].update(index=0), "rest belongs to a frame at a for-each"),
        (lambda r: r["todo"][1].update(rest=[None]), "an entity to visit must be an object"),
        (
            lambda r: r["todo"][2].update(done=1, operands=[0.0]),
            "only the innermost frame of todo may be half done",
        ),
    ],
)  # fmt: skip
def test_a_forged_record_is_refused_with_a_sentence(forge: Any, complaint: str | None) -> None:
    forged = record()
    forge(forged)
    if complaint is None:
        run(restored(forged, ready), view(), 100)
    else:
        with pytest.raises(ModelError, match=complaint):
            restored(forged, ready)


@pytest.mark.parametrize("span", [[1, 1, 1], [0, 1, 1, 1], "1111", [1, 1, 1, 1.0], None])
def test_a_reason_needs_a_place(span: Any) -> None:
    halted = saved(to_the_end("print getx null;")[0]) | {"span": span}
    with pytest.raises(ModelError, match="span"):
        restored(halted, ready)


@pytest.mark.parametrize("wrong", [None, [], "skip;", 3, {}, {"todo": [[[[]]]]}])
def test_what_is_no_record_is_refused(wrong: object) -> None:
    with pytest.raises(ModelError, match="a saved program must be"):
        restored(wrong, ready)


def test_a_record_nested_without_end_is_refused_with_a_sentence() -> None:
    nested: list[Any] = []
    for _ in range(100_000):
        nested = [nested]
    with pytest.raises(ModelError, match="a saved program must be an object"):
        restored(nested, ready)
