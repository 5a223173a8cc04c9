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

from attrs import evolve

from fasteroids.lang import syntax
from fasteroids.lang.checker import remedies
from fasteroids.lang.checker.types import EQUALITIES, type_of, wants, with_article
from fasteroids.lang.checker.uses import Node, constructs
from fasteroids.lang.checker.variables import Variables, declared, type_span, understood
from fasteroids.lang.diagnostics import Diagnostic, Note
from fasteroids.lang.names import shortened
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Expression, Program, Type

__all__ = ["complaints", "declared"]


def complaints(tree: Program) -> tuple[Diagnostic, ...]:
    """Everything that keeps a program from being type-correct, by place; empty if nothing does. Never raises."""
    program = constructs(tree)
    variables = understood(tree, program)
    found = [*variables.complaints]
    told: Node | None = None
    for node, loop in program:
        side = remedies.negated_side(node, variables.types)
        if side is not None:
            found.append(_negated_side(node, side, variables))
            told = side
        elif node is not told:
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
    hint, fix = remedies.for_value(value, found, wanted)
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
    hint, fix = remedies.for_equality(node, one, other)
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
    hint, fix = remedies.for_operand(node, expression, found, wanted)
    code, rule = _taker(node, wanted)
    notes = [*_origin(expression, found, known)]
    for also, its, _ in wrong[1:]:
        notes += [
            Note(f"{with_article(its)} too" if its == found else with_article(its), also.span)
        ]
        notes += _origin(also, its, known)
    return Diagnostic(
        code,
        f"{rule}, but this is {with_article(found)}",
        expression.span,
        hint=hint,
        label=with_article(found),
        notes=tuple(dict.fromkeys(notes)),
        fix=fix if len(wrong) == 1 else (),
    )


def _negated_side(node: Node, side: syntax.Unary, known: Variables) -> Diagnostic:
    """`!a < b` for `!(a < b)`: one fault, though neither `!` nor `<` has what it takes."""
    found = type_of(side.operand, known.types)
    assert found is not None
    wrong = _wrong_operand(side, [(side.operand, found, "bool")], known)
    hint, fix = remedies.for_negated_side(node, side)
    return evolve(wrong, hint=hint, fix=fix)


def _taker(node: Node, wanted: Type) -> tuple[str, str]:
    """The code for what does not fit into a construct, and what the construct takes."""
    one = with_article(wanted)
    match node:
        case syntax.If():
            return "FA104", f"The condition of `if` must be {one}"
        case syntax.While():
            return "FA104", f"The condition of `while` must be {one}"
        case syntax.Turn():
            return "FA107", f"The angle of `turn` must be {one}"
        case syntax.ForEach():
            return "FA109", f"The variable of a for-each must be {one}"
        case syntax.Unary(operator):
            return "FA105", f"`{operator}` takes {one}"
        case syntax.Binary(operator):
            return "FA105", f"`{operator}` works on {wanted}s"
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


def _origin(expression: Expression, kind: Type, known: Variables) -> list[Note]:
    """Where a variable that does not fit was declared."""
    if isinstance(expression, syntax.Name) and expression.name in known.declared_at:
        at = known.declared_at[expression.name].target
        return [Note(f"`{shortened(at.name)}` is declared {kind} here", at.span)]
    return []
