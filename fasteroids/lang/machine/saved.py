"""Machines as plain records for JSON, and back, between any two steps.

    {"source": text, "store": {name: value}, "todo": [frame, ...]}            one that runs, innermost frame first
    {"source": text, "store": {name: value}, "reason": ..., "span": ...}      one that halted

A value is a number, `"inf"`, `"-inf"`, `"nan"`, a truth, null, or an entity as an object of its last state. A frame is
`{"block", "index", "done", "operands"}`, or `{"block", "index", "rest"}` for a for-each between two turns. Python's
`json` writes and reads doubles exactly; a whole number is taken for a double too, since other writers drop the `.0`.

What comes back is trusted with nothing: the text is parsed and checked again by the caller's `compile`, each value
must have the type its variable or operation asks for, and the frames must lie in each other as the blocks of the text
do. So a record that is accepted is a state of its program, and runs like one that the machine made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf, nan
from typing import Any

from pyrsistent import plist, pmap

from fasteroids.lang.machine._machine import Each, Frame, Halted, Machine, Running, Todo
from fasteroids.lang.machine.code import Code, Form
from fasteroids.lang.machine.steps import Node, Test
from fasteroids.lang.machine.values import BINARY, GETTERS, UNARY, Seen, Value, type_of
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Binary, Direction, Name, Number, Truth, Type, Unary
from fasteroids.units import ModelError, shown

__all__ = ["restored", "saved"]

_KINDS = ("ship", "asteroid", "bullet")
_STATE = ("x", "y", "vx", "vy", "radius")
_NOT_FINITE = {"inf": inf, "-inf": -inf, "nan": nan}


def saved(machine: Machine) -> dict[str, Any]:
    """The machine as dictionaries, lists, texts and numbers that `json` can write."""
    record: dict[str, Any] = {
        "source": machine.code.source,
        "store": {name: _written(machine.store[name]) for name in sorted(machine.store)},
    }
    if isinstance(machine, Halted):
        return record | {"reason": machine.reason, "span": machine.span and list(machine.span)}
    return record | {"todo": [_frame_written(f) for f in machine.todo]}


def _written(value: Value) -> Any:
    if isinstance(value, Seen):
        state = {name: _written(getattr(value, name)) for name in _STATE}
        return {"id": value.id, "kind": value.kind, **state}
    if type(value) is float and not -inf < value < inf:
        return repr(value)
    return value


def _frame_written(f: Frame | Each) -> dict[str, Any]:
    where = {"block": f.block, "index": f.index}
    if isinstance(f, Each):
        return {**where, "rest": [_written(seen) for seen in f.rest]}
    return {**where, "done": f.done, "operands": [_written(v) for v in f.operands]}


def restored(record: object, compile: Callable[[str], Code]) -> Machine:
    """The machine that `saved` gave this record for, equal to it.

    `compile` makes the text ready, or raises `ModelError`. A record that is no state of its program raises it too.
    """
    if not isinstance(record, Mapping):
        raise _wrong("a saved program", "an object", record)
    halted = "todo" not in record
    wanted = {"source", "store"} | ({"reason", "span"} if halted else {"todo"})
    _fields(record, "a saved program", wanted)
    if not isinstance(record["source"], str):
        raise _wrong("source", "a text", record["source"])
    code = compile(record["source"])
    store = _store(record["store"], code)
    if halted:
        return Halted(code, store, *_stop(record["reason"], record["span"]))
    return Running(code, store, _todo(record["todo"], code))


def _wrong(what: str, wanted: str, got: object) -> ModelError:
    return ModelError(f"{what} must be {wanted}; got {shown(got)}")


def _fields(record: object, what: str, names: set[str]) -> Mapping[str, Any]:
    if not isinstance(record, Mapping) or set(record) != names:
        raise _wrong(what, f"an object with the fields {', '.join(sorted(names))}", record)
    return record


def _whole(value: object, what: str, least: int, most: float = inf) -> int:
    if type(value) is not int or not least <= value <= most:
        limit = f"{least} or more" if most == inf else f"between {least} and {most}"
        raise _wrong(what, f"a whole number, {limit}", value)
    return value


def _list(value: object, what: str) -> list[Any]:
    if not isinstance(value, list | tuple):
        raise _wrong(what, "a list", value)
    return list(value)


# Values.


def _double(value: object, what: str) -> float:
    if isinstance(value, str) and value in _NOT_FINITE:
        return _NOT_FINITE[value]
    if type(value) is float and -inf < value < inf:
        return value
    if type(value) is int:
        try:
            return float(value)
        except OverflowError:
            pass
    raise _wrong(what, 'a number, "inf", "-inf" or "nan"', value)


def _entity(value: object, what: str) -> Seen:
    fields = _fields(value, what, {"id", "kind", *_STATE})
    if fields["kind"] not in _KINDS:
        raise _wrong(f"kind of {what}", "ship, asteroid or bullet", fields["kind"])
    state = (_double(fields[name], f"{name} of {what}") for name in _STATE)
    return Seen(_whole(fields["id"], f"id of {what}", 1), fields["kind"], *state)


def _value(value: object, type_: Type | None, what: str) -> Value:
    """A value of a type; of any, where the type is None."""
    if type_ == "double" or (
        type_ is None and isinstance(value, int | float | str) and type(value) is not bool
    ):
        return _double(value, what)
    if type_ == "bool" or (type_ is None and type(value) is bool):
        if type(value) is not bool:
            raise _wrong(what, "true or false", value)
        return value
    return None if value is None else _entity(value, what)


def _store(record: object, code: Code) -> Any:
    if not isinstance(record, Mapping) or set(record) != set(code.defaults):
        names = ", ".join(sorted(code.defaults)) or "none"
        raise _wrong("store", f"an object with the program's variables ({names})", record)
    return pmap({n: _value(v, type_of(code.defaults[n]), n) for n, v in record.items()})


def _stop(reason: object, span: object) -> tuple[str | None, Span | None]:
    if reason is None and span is None:
        return None, None
    if not isinstance(reason, str):
        raise _wrong("reason", "a text, or null without a span", reason)
    numbers = [_whole(n, "a line or column of span", 1) for n in _list(span, "span")]
    if len(numbers) != 4:
        raise _wrong("span", "two lines and two columns", span)
    return reason, Span(*numbers)


# Frames.


def _todo(record: object, code: Code) -> Todo:
    frames = [_frame(f, code) for f in _list(record, "todo")]
    if not frames:
        raise ModelError("todo must have a frame; a program without one has halted")
    given = [(type(f), f.block, f.index) for f in frames[1:]]
    if given != _below(code, frames[0].block):
        raise ModelError(
            f"todo must have its frames as the blocks of the text lie; got {shown(record)}"
        )
    for f in frames[1:]:
        if isinstance(f, Frame) and f.done:
            raise ModelError(f"only the innermost frame of todo may be half done; got {shown(f)}")
    return plist(frames)


def _below(code: Code, block: int) -> list[tuple[type, int, int]]:
    """What frames lie below one in a block: the text alone decides, since a body has one place to go back to."""
    around = {
        inner: (outer, index)
        for outer, row in enumerate(code.blocks)
        for index, instruction in enumerate(row)
        for inner in instruction.blocks
    }
    below: list[tuple[type, int, int]] = []
    while block in around:
        block, index = around[block]
        form = code.blocks[block][index].form
        if form is Form.IF:
            index += 1
        if index < len(code.blocks[block]):
            below.append((Each if form is Form.EACH else Frame, block, index))
    return below


def _frame(record: object, code: Code) -> Frame | Each:
    each = isinstance(record, Mapping) and "rest" in record
    names = {"block", "index"} | ({"rest"} if each else {"done", "operands"})
    fields = _fields(record, "a frame", names)
    block = _whole(fields["block"], "block of a frame", 0, len(code.blocks) - 1)
    index = _whole(fields["index"], "index of a frame", 0, len(code.blocks[block]) - 1)
    instruction = code.blocks[block][index]
    if each:
        if instruction.form is not Form.EACH:
            raise ModelError(f"rest belongs to a frame at a for-each; got {shown(record)}")
        rest = [_entity(e, "an entity to visit") for e in _list(fields["rest"], "rest")]
        return Each(block, index, plist(rest))
    done = _whole(fields["done"], "done of a frame", 0, len(instruction.nodes))
    types = _waiting(instruction.nodes[:done], code)
    operands = _list(fields["operands"], "operands")
    if len(operands) != len(types):
        raise ModelError(f"{len(types)} operands must wait after {done} nodes; got {len(operands)}")
    values = [_value(v, t, "an operand") for v, t in zip(operands, types, strict=True)]
    return Frame(block, index, done, tuple(values))


def _waiting(nodes: tuple[Node, ...], code: Code) -> list[Type | None]:
    """The types of the operands that wait after some nodes; None where an operation has no rule."""
    types: list[Type | None] = []
    for node in nodes:
        match node:
            case Number() | Direction():
                types.append("double")
            case Truth():
                types.append("bool")
            case Name(name):
                types.append(type_of(code.defaults[name]) if name in code.defaults else None)
            case Test():
                types.pop()
            case Unary(operator):
                types[-1] = "double" if operator in GETTERS else _result(UNARY.get(operator))
            case Binary("&&" | "||"):
                types[-1] = "bool"
            case Binary(operator):
                types[-2:] = [_result(BINARY.get(operator))]
            case _:  # null, self
                types.append("entity")
    return types


def _result(rule: tuple[Any, Type, Any] | None) -> Type | None:
    return None if rule is None else rule[1]
