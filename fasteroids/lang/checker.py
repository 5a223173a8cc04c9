"""Is a program type-correct (assignment 1.8.3), and if not, where and why.

Three passes, each over all the text: what the variables are (`variables`), what each construct asks of the
expressions in it, and where actions stand. A variable whose type is in doubt, and what could not be read (`Missing`),
have no type, and nothing is complained of where they stand: one fault, one diagnostic.

Type-correct means: each variable that is mentioned is declared (anywhere in the text, since all are global);
operations are applied to the right types; what is assigned has the type of the variable; conditions are bools, `turn`
takes a double, a for-each an entity variable; no action stands anywhere inside a for-each. `null` and `self` are
entities. `print` shows any type.
"""

from __future__ import annotations

from collections.abc import Iterator

from fasteroids.lang import syntax
from fasteroids.lang.diagnostics import Diagnostic, Edit, Note
from fasteroids.lang.names import shortened
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Expression, Program, Type
from fasteroids.lang.types import EQUALITIES, type_of, wants, with_article
from fasteroids.lang.uses import Node, nodes
from fasteroids.lang.variables import Variables, declared, type_span, understood

__all__ = ["complaints", "declared"]

_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")


def complaints(tree: Program) -> tuple[Diagnostic, ...]:
    """Everything that keeps a program from being type-correct, by place; empty if nothing does. Never raises."""
    variables = understood(tree)
    found = [*variables.complaints]
    for node, loop in nodes(tree):
        found += _misfits(node, variables)
        if loop is not None and isinstance(node, syntax.Act | syntax.Turn):
            found.append(_action_in_loop(node, loop))
    return tuple(sorted(found, key=lambda each: each.span))


def _misfits(node: Node, known: Variables) -> Iterator[Diagnostic]:
    """What does not fit into this construct, one complaint for all of it."""
    match node:
        case syntax.Assignment(target, value) | syntax.Declaration(_, target, value) if (
            value is not None
        ):
            found, wanted = type_of(value, known.types), type_of(target, known.types)
            if found is not None and wanted is not None and found != wanted:
                yield _wrong_value(node, value, found, wanted, known)
        case syntax.Binary(operator, left, right) if operator in EQUALITIES:
            one, other = type_of(left, known.types), type_of(right, known.types)
            if one is not None and other is not None and one != other:
                yield _unlike(node, one, other, known)
        case _:
            wrong = [
                (expression, found, wanted)
                for expression, wanted in wants(node, known.types)
                if wanted is not None
                and (found := type_of(expression, known.types)) is not None
                and found != wanted
            ]
            if wrong:
                yield _wrong_operand(node, wrong, known)


# The complaints.


def _wrong_value(
    node: syntax.Assignment | syntax.Declaration,
    value: Expression,
    found: Type,
    wanted: Type,
    known: Variables,
) -> Diagnostic:
    name = shortened(node.target.name)
    hint, fix = _remedy(value, found, wanted)
    at = known.declared_at.get(node.target.name)
    notes: list[Note] = []
    if isinstance(node, syntax.Declaration):
        notes = [Note(f"declared {wanted} here", type_span(node))]
    elif at is not None:
        notes = [Note(f"declared {wanted} here", at.target.span)]
    return Diagnostic(
        "FA103",
        f"`{name}` is {with_article(wanted)}, but this value is {with_article(found)}",
        value.span,
        hint=hint or f"Give it {with_article(wanted)}, or declare it `{found} {name};`",
        label=with_article(found),
        notes=(*notes, *_origin(value, found, known)),
        fix=fix,
    )


def _unlike(node: syntax.Binary, one: Type, other: Type, known: Variables) -> Diagnostic:
    """`==` or `!=` between two types."""
    left, right = node.left, node.right
    hint = "Compare two doubles, two bools or two entities"
    fix: tuple[Edit, ...] = ()
    if _is_comparison(left) and one == "bool":
        hint = _chain(left, node)
    elif {one, other} == {"double", "entity"}:
        entity = left if one == "entity" else right
        hint = f"Compare a number of the entity, as in `getx {_text(entity)}`"
    elif isinstance(right, syntax.Number):
        better, fix = _remedy(right, other, one)
        hint = better or hint
    return Diagnostic(
        "FA106",
        f"`{node.operator}` compares two values of one type, not {with_article(one)} and {with_article(other)}",
        right.span,
        hint=hint,
        label=with_article(other),
        notes=(
            Note(with_article(one), left.span),
            *_origin(left, one, known),
            *_origin(right, other, known),
        ),
        fix=fix,
    )


def _wrong_operand(
    node: Node, wrong: list[tuple[Expression, Type, Type]], known: Variables
) -> Diagnostic:
    """The operands of one operator, a condition, the angle of a turn, the variable of a for-each."""
    expression, found, wanted = wrong[0]
    hint, fix = _remedy(expression, found, wanted)
    code, taker = _taker(node)
    if isinstance(node, syntax.ForEach):
        hint = "Declare another variable for the loop, such as `entity e;`"
    elif (
        isinstance(node, syntax.Binary)
        and node.operator in _COMPARISONS
        and _is_comparison(expression)
    ):
        hint = _chain(expression, node)
    elif isinstance(node, syntax.Binary) and node.operator in _COMPARISONS and found == "entity":
        hint = f"Compare a number of the entity, as in `getx {_text(expression)}`"
    elif isinstance(node, syntax.Unary) and node.operator == "-" and found == "bool":
        start = node.span.start
        hint, fix = "Not is `!`", (Edit(Span(*start, start[0], start[1] + 1), "!"),)
    notes = [*_origin(expression, found, known)]
    for also, its, _ in wrong[1:]:
        notes += [
            Note(f"{with_article(its)} too" if its == found else with_article(its), also.span)
        ]
        notes += _origin(also, its, known)
    return Diagnostic(
        code,
        f"{taker} {with_article(wanted)}, but this is {with_article(found)}",
        expression.span,
        hint=hint,
        label=with_article(found),
        notes=tuple(dict.fromkeys(notes)),
        fix=fix if len(wrong) == 1 else (),
    )


def _taker(node: Node) -> tuple[str, str]:
    """The code for what does not fit into a construct, and how its sentence begins."""
    match node:
        case syntax.If():
            return "FA104", "The condition of `if` must be"
        case syntax.While():
            return "FA104", "The condition of `while` must be"
        case syntax.Turn():
            return "FA107", "`turn` takes an angle in radians,"
        case syntax.ForEach():
            return "FA109", "The variable of a for-each must be"
        case syntax.Unary(operator):
            return "FA105", f"`{operator}` takes"
        case syntax.Binary(operator):
            return "FA105", f"`{operator}` takes two operands, each"
    raise AssertionError(node)


def _action_in_loop(node: syntax.Act | syntax.Turn, loop: syntax.ForEach) -> Diagnostic:
    word = node.action if isinstance(node, syntax.Act) else "turn"
    line, column = loop.span.start
    return Diagnostic(
        "FA108",
        f"`{word}` is an action, and no action may stand inside a for-each",
        node.span,
        hint="Keep what you find in a variable, and act behind the loop",
        label="inside the for-each",
        notes=(
            Note("the for-each starts here", Span(line, column, line, column + len("foreach"))),
        ),
    )


# What helps.


def _origin(expression: Expression, kind: Type, known: Variables) -> list[Note]:
    """Where a variable that does not fit was declared."""
    if isinstance(expression, syntax.Name) and expression.name in known.declared_at:
        at = known.declared_at[expression.name].target
        return [Note(f"`{shortened(at.name)}` is declared {kind} here", at.span)]
    return []


def _remedy(
    expression: Expression, found: Type, wanted: Type
) -> tuple[str | None, tuple[Edit, ...]]:
    """The likely way from a value of one type to one of another, as a hint and, if it is safe, an edit."""
    match expression, found, wanted:
        case syntax.Number(0.0 | 1.0 as value, span), _, "bool":
            word = "true" if value else "false"
            return f"Write `{word}`", (Edit(span, word),)
        case syntax.Number(0.0, span), _, "entity":
            return "No entity is `null`", (Edit(span, "null"),)
        case _, "double", "bool":
            return f"Compare it with a number, as in `{_text(expression)} != 0`", ()
        case syntax.Null(), "entity", "bool":
            return "Write `false`", (Edit(expression.span, "false"),)
        case _, "entity", "bool":
            return f"Ask whether there is one: `{_text(expression)} != null`", ()
        case syntax.Null(), "entity", "double":
            return "`null` is for entities; a double has no such value", ()
        case _, "entity", "double":
            text = _text(expression)
            return f"Take a number of the entity, as in `getx {text}` or `getradius {text}`", ()
        case syntax.Unary(operator), "double", "entity" if operator.startswith("get"):
            return f"`{operator}` has made it a double: leave it out if the entity is meant", ()
        case _:
            return None, ()


def _text(expression: Expression) -> str:
    """A simple expression as it is written; `...` for others."""
    match expression:
        case syntax.Name(name):
            return shortened(name)
        case syntax.Self():
            return "self"
        case syntax.Null():
            return "null"
        case syntax.Direction():
            return "getdir"
        case _:
            return "..."


def _is_comparison(expression: Expression) -> bool:
    return isinstance(expression, syntax.Binary) and expression.operator in _COMPARISONS


def _chain(left: Expression, node: syntax.Binary) -> str:
    """`a < b < c` is no chain."""
    assert isinstance(left, syntax.Binary)
    middle = _text(left.right)
    return (
        f"Comparisons do not chain: write `{_text(left.left)} {left.operator} {middle} && "
        f"{middle} {node.operator} {_text(node.right)}`"
    )
