"""Laws of the checker, and a second one, written straight from the rules, that must agree with it."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from fasteroids.lang.checker import complaints, declared
from fasteroids.lang.front import mended
from fasteroids.lang.parser import parse_program
from fasteroids.lang.printer import printed
from fasteroids.lang.syntax import (
    Act,
    Assignment,
    Binary,
    Block,
    Declaration,
    Direction,
    Expression,
    ForEach,
    If,
    Name,
    Null,
    Number,
    Print,
    Program,
    Self,
    Statement,
    Truth,
    Turn,
    Unary,
    While,
)
from fasteroids.testing.programs import programs
from fasteroids.testing.trees import trees

third = settings(max_examples=max(30, settings().max_examples // 3))
"""These draw whole programs, and each example has much in it."""


class Wrong(Exception):  # noqa: N818
    """The program is not type-correct."""


def demand(rule: bool) -> None:
    if not rule:
        raise Wrong


def typed(e: Expression, types: dict[str, str]) -> str:
    """The type of an expression whose parts are all right (1.8.2, 1.8.3)."""
    match e:
        case Number() | Direction():
            return "double"
        case Truth():
            return "bool"
        case Null() | Self():
            return "entity"
        case Name(name):
            demand(name in types)
            return types[name]
        case Unary("!", operand):
            demand(typed(operand, types) == "bool")
            return "bool"
        case Unary("-" | "sqrt" | "sin" | "cos", operand):
            demand(typed(operand, types) == "double")
            return "double"
        case Unary(_, operand):
            demand(typed(operand, types) == "entity")
            return "double"
        case Binary(sign, left, right):
            one, other = typed(left, types), typed(right, types)
            demand(one == other)
            if sign in ("==", "!="):
                return "bool"
            demand(one == ("bool" if sign in ("&&", "||") else "double"))
            return "double" if sign in ("+", "-", "*", "/", "%") else "bool"
    raise Wrong


def right(s: Statement | Block | None, types: dict[str, str], *, looping: bool = False) -> None:
    """Is a statement right? `Wrong` if not."""
    match s:
        case Block(statements):
            for each in statements:
                right(each, types, looping=looping)
        case Assignment(name, value):
            demand(typed(value, types) == typed(name, types))
        case Declaration(type, name, value):
            demand(types[name.name] == type)
            demand(value is None or typed(value, types) == type)
        case If(condition, then, orelse):
            demand(typed(condition, types) == "bool")
            right(then, types, looping=looping)
            right(orelse, types, looping=looping)
        case While(condition, body):
            demand(typed(condition, types) == "bool")
            right(body, types, looping=looping)
        case ForEach(_, name, body):
            demand(typed(name, types) == "entity")
            right(body, types, looping=True)
        case Print(value):
            typed(value, types)
        case Turn(angle):
            demand(not looping)
            demand(typed(angle, types) == "double")
        case Act():
            demand(not looping)


def is_right(tree: Program) -> bool:
    try:
        right(tree.body, dict(declared(tree)))
    except Wrong:
        return False
    return True


def without_declarations(block: Block) -> Block:
    """The same statements; a declaration with a value is an assignment, one without is not there."""
    found: list[Statement] = []
    for each in block.statements:
        match each:
            case Declaration(_, name, value):
                found += [Assignment(name, value)] if value is not None else []
            case If(condition, then, orelse):
                after = without_declarations(orelse) if orelse is not None else None
                found.append(If(condition, without_declarations(then), after))
            case While(condition, body):
                found.append(While(condition, without_declarations(body)))
            case ForEach(kind, name, body):
                found.append(ForEach(kind, name, without_declarations(body)))
            case _:
                found.append(each)
    return Block(tuple(found))


@st.composite
def damaged(draw: st.DrawFn) -> Program:
    """A program with the declarations of another, or with two programs' statements under one's declarations."""
    one, other = draw(programs()), draw(programs())
    renamed = draw(st.permutations(["double", "bool", "entity"]))
    heads = [
        Declaration(dict(zip(("bool", "double", "entity"), renamed, strict=True))[type], Name(name))  # type: ignore[arg-type]
        for name, type in declared(other).items()
    ]
    return Program(Block((*heads, *without_declarations(one.body).statements)))


@third
@given(trees() | damaged())
def test_both_checkers_agree(tree: Program) -> None:
    assert (complaints(tree) == ()) == is_right(tree)


@third
@given(programs())
def test_without_its_declarations_each_variable_is_missed_once_and_nothing_else(
    tree: Program,
) -> None:
    """With them, it is right. And what the fixes declare has the type it had, where the uses tell it."""
    assert complaints(tree) == ()
    text = printed(Program(without_declarations(tree.body)))
    found = complaints(parse_program(text).tree)
    assert {each.code for each in found} <= {"FA101"}
    types = declared(tree)
    missed = [each.message.split("`")[1] for each in found]
    assert len(set(missed)) == len(missed)
    assert set(missed) <= types.keys()
    after = parse_program(mended(text, found)).tree
    untold = {name for name, each in zip(missed, found, strict=True) if not each.fix}
    assert {name: types[name] for name in missed if name not in untold} == dict(declared(after))
    assert len(complaints(after)) == len(untold)
