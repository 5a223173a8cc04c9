"""The machine that runs a program: a small-step semantics whose states are values.

A program is run as textbooks of semantics define running. A state says everything: the *store*, what each variable
holds, and the *todo*, what is left to do. One rule a construct says which state follows:

    step(machine, view) = (machine', action?, printed?)

The todo is a stack of frames, innermost first: in which block, at which instruction, how many nodes of its
expression are evaluated, and their values, which wait as operands. No frame stands at the end of its block; a todo
without frames is a program that came to its end. The host's stack holds nothing of the program.

Why a machine, and not a function that walks the tree? Because states are values, a program can

-   pause anywhere: a ship's program stops at each action and goes on "right after this action statement" 0.2 s later
    (1.8), or in the middle of a sum, because its fuel is used up;
-   be stepped, forwards by `step` and backwards by keeping what was before: a debugger needs nothing else;
-   be saved between any two steps, and resumed with the same future (`fasteroids.lang.machine.saved`);
-   be kept in every past world for little: a step shares what it does not change;
-   run with thousands of others, a step each in turn, without threads.

How 1.8 maps to it. "It executes until either there are no statements left or until it encounters an action
statement": `run`. "The next time the program runs, it continues": the todo. "The values of the global variables must
be remembered across invocations": the store. "If a program performs an illegal operation, execution stops. Subsequent
runs immediately return": a state without a rule is *stuck*, and the step from there gives `Halted` with the reason.
No step raises, whatever the program, checked or not.

What counts as one step, of which a tick may take `View.fuel`:

-   each node of an expression: a constant, a variable, `self`, an operation;
-   for `&&` and `||` one to test the left side and, unless that decides, those of the right side and one to combine;
-   each statement once its expression has a value: an assignment, a print, an action, an `if` that picks a branch, a
    `while` that enters its body or is over, each turn of a `foreach` and its end.

The end of a body costs nothing, nor does a declaration without a value.

Entities. A variable holds what was seen of an entity. At the start of a tick the living ones are seen anew
(`refreshed`); a dead one keeps its last state, can still be read, and is not equal to null. A `foreach` visits, in
ascending order of ids, who lived when the loop began, the own ship included, even if it takes several ticks.

`run` takes many steps at once by closures where it can; `run_by_steps` is its definition.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from math import inf
from typing import Any, Literal, NamedTuple, TypeAlias

from attrs import field, frozen
from pyrsistent import PList, PMap, plist

from fasteroids._raw import raw
from fasteroids.actions import Action, Ticked, Turn, View
from fasteroids.lang.machine.closures import Reading
from fasteroids.lang.machine.code import Code, Form, Instruction
from fasteroids.lang.machine.fast import Entry, leap
from fasteroids.lang.machine.steps import Operands, evaluated, named
from fasteroids.lang.machine.values import Seen, Stuck, Value, exact, shown, type_of, visited
from fasteroids.lang.source import Span
from fasteroids.lang.syntax import Expression, ForEach, Type

__all__ = [
    "Each",
    "Frame",
    "Halted",
    "Machine",
    "Ran",
    "Running",
    "Stepped",
    "Todo",
    "place",
    "refreshed",
    "run",
    "run_by_steps",
    "started",
    "step",
    "tick",
]


def _exactly(values: PList[Value] | Operands) -> Hashable:
    return tuple(map(exact, values))


def _store(store: PMap[str, Value]) -> Hashable:
    return frozenset((name, exact(value)) for name, value in store.items())


@frozen(weakref_slot=False)
class Frame:
    """In block `block`, at instruction `index`: `done` nodes of its expression are done, their values in `operands`."""

    block: int
    index: int
    done: int = 0
    operands: Operands = field(default=(), eq=_exactly)


@frozen(weakref_slot=False)
class Each:
    """In block `block`, at the for-each `index`, between two turns: the entities still to visit, in order."""

    block: int
    index: int
    rest: PList[Seen] = field(eq=_exactly)


Todo: TypeAlias = PList[Frame | Each]


@frozen(weakref_slot=False)
class Running:
    """A program that has something left to do. Equal to the bit: 0.0 is not -0.0, and nan is itself."""

    code: Code
    store: PMap[str, Value] = field(eq=_store)
    todo: Todo = field(eq=tuple)
    """Frames, innermost first; never empty, and none at the end of its block."""

    @property
    def checked(self) -> bool:
        """Was its program found type-correct? A ship takes no other."""
        return self.code.checked

    @property
    def running(self) -> bool:
        """True: it has more ticks."""
        return True

    def tick(self, view: View) -> Ticked:
        """Run until the next action, the end, an illegal operation, or no fuel."""
        return tick(self, view, view.fuel)


@frozen(weakref_slot=False)
class Halted:
    """A program that has nothing left to do: it came to its end, or got stuck for a `reason` at `span`."""

    code: Code
    store: PMap[str, Value] = field(eq=_store)
    reason: str | None = None
    span: Span | None = None

    @property
    def checked(self) -> bool:
        """Was its program found type-correct? A ship takes no other."""
        return self.code.checked

    @property
    def running(self) -> bool:
        """False: it has no more ticks."""
        return False

    def tick(self, view: View) -> Ticked:
        """Nothing happens any more."""
        return tick(self, view, view.fuel)


Machine: TypeAlias = Running | Halted

_frame, _each, _running = raw(Frame), raw(Each), raw(Running)
_NOTHING: Todo = plist()


def started(code: Code) -> Machine:
    """The machine before its first step: every variable holds its default."""
    return _going(code, code.defaults, _at(code, 0, 0, _NOTHING))


def _going(code: Code, store: PMap[str, Value], todo: Todo) -> Machine:
    return _running(code, store, todo) if todo else Halted(code, store)


def _at(code: Code, block: int, index: int, below: Todo) -> Todo:
    """The todo at the start of an instruction, or what is below if there is none at that place."""
    return below.cons(_frame(block, index, 0, ())) if index < len(code.blocks[block]) else below


# One step.


class Stepped(NamedTuple):
    """What one step gave."""

    machine: Machine
    action: Action | None = None
    printed: str | None = None


def step(machine: Running, view: View) -> Stepped:
    """The next state: one node of an expression evaluated, or one statement done. Never raises."""
    code, store, todo = machine.code, machine.store, machine.todo
    frame, below = todo.first, todo.rest
    instruction = code.blocks[frame.block][frame.index]
    try:
        if type(frame) is Frame and frame.done < len(instruction.nodes):
            operands, done = evaluated(instruction.nodes[frame.done], frame.operands, store, view)
            moved = _frame(frame.block, frame.index, frame.done + done, operands)
            return Stepped(_running(code, store, below.cons(moved)))
        return _RULES[instruction.form](machine, instruction, frame, below, view)
    except Stuck as stuck:
        return Stepped(Halted(code, store, str(stuck), place(machine)))


def _value(frame: Frame, instruction: Instruction, wanted: str, word: str) -> Any:
    """The value of an instruction's expression; `Stuck`, naming the `word` of the statement, if of another type."""
    value = frame.operands[-1]
    if type_of(value) != wanted:
        raise Stuck(_reason(instruction, word, value))
    return value


def _reason(instruction: Instruction, word: str, value: Value) -> str:
    last: Any = instruction.nodes[-1]
    side: Expression = last
    return named(f"{word} {shown(value)}", (side, value))


def _declared(m: Running, i: Instruction) -> Type:
    """The type of the variable that an instruction assigns to."""
    try:
        return type_of(m.code.defaults[i.target])
    except KeyError:
        raise Stuck(f"{i.target} is not declared") from None


def _assign(m: Running, i: Instruction, frame: Frame, below: Todo, _: View) -> Stepped:
    value, wanted = frame.operands[-1], _declared(m, i)
    if type_of(value) != wanted:
        raise Stuck(f"{i.target} := {shown(value)}: {i.target} is declared {wanted}")
    todo = _at(m.code, frame.block, frame.index + 1, below)
    return Stepped(_going(m.code, m.store.set(i.target, value), todo))


def _if(m: Running, i: Instruction, frame: Frame, below: Todo, _: View) -> Stepped:
    branch = 0 if _value(frame, i, "bool", "if") else 1
    todo = _at(m.code, frame.block, frame.index + 1, below)
    if branch < len(i.blocks):
        todo = _at(m.code, i.blocks[branch], 0, todo)
    return Stepped(_going(m.code, m.store, todo))


def _while(m: Running, i: Instruction, frame: Frame, below: Todo, _: View) -> Stepped:
    if _value(frame, i, "bool", "while"):
        again = _at(m.code, frame.block, frame.index, below)
        todo = _at(m.code, i.blocks[0], 0, again)
    else:
        todo = _at(m.code, frame.block, frame.index + 1, below)
    return Stepped(_going(m.code, m.store, todo))


def _for_each(m: Running, i: Instruction, frame: Frame | Each, below: Todo, view: View) -> Stepped:
    if isinstance(frame, Each):
        rest = frame.rest
    else:
        if _declared(m, i) != "entity":
            raise Stuck(f"foreach {i.target}: {i.target} is declared {_declared(m, i)}")
        assert isinstance(i.statement, ForEach)
        rest = visited(view, i.statement.kind)
    if not rest:
        todo = _at(m.code, frame.block, frame.index + 1, below)
        return Stepped(_going(m.code, m.store, todo))
    again: Todo = below.cons(_each(frame.block, frame.index, rest.rest))
    todo = _at(m.code, i.blocks[0], 0, again)
    return Stepped(_running(m.code, m.store.set(i.target, rest.first), todo))


def _print(m: Running, _: Instruction, frame: Frame, below: Todo, __: View) -> Stepped:
    todo = _at(m.code, frame.block, frame.index + 1, below)
    return Stepped(_going(m.code, m.store, todo), None, shown(frame.operands[-1]))


def _turn(m: Running, i: Instruction, frame: Frame, below: Todo, _: View) -> Stepped:
    angle = _value(frame, i, "double", "turn")
    if not -inf < angle < inf:
        raise Stuck(_reason(i, "turn", angle))
    todo = _at(m.code, frame.block, frame.index + 1, below)
    return Stepped(_going(m.code, m.store, todo), Turn(angle))


def _act(m: Running, i: Instruction, frame: Frame, below: Todo, _: View) -> Stepped:
    todo = _at(m.code, frame.block, frame.index + 1, below)
    return Stepped(_going(m.code, m.store, todo), i.action)


_RULES: dict[Form, Callable[..., Stepped]] = {
    Form.ASSIGN: _assign,
    Form.IF: _if,
    Form.WHILE: _while,
    Form.EACH: _for_each,
    Form.PRINT: _print,
    Form.TURN: _turn,
    Form.ACT: _act,
}


def place(machine: Machine) -> Span:
    """The piece of text that comes next: a node of an expression, or a statement whose expression has its value.

    Of a program that got stuck, where; of one that came to its end, the empty piece behind its text.
    """
    if isinstance(machine, Halted):
        return machine.span or machine.code.program.body.span.after()
    frame = machine.todo.first
    instruction = machine.code.blocks[frame.block][frame.index]
    if isinstance(frame, Frame) and frame.done < len(instruction.nodes):
        return instruction.nodes[frame.done].span
    return instruction.span


# Many steps.


class Ran(NamedTuple):
    """What a run gave: it stopped at an action, because the machine halted, or with no fuel left."""

    machine: Machine
    action: Action | None
    prints: tuple[str, ...]
    left: int
    """Fuel."""
    span: Span | None = None
    """The text of the action."""


def run_by_steps(machine: Machine, view: View, fuel: int) -> Ran:
    """At most `fuel` steps, one after another, up to the first action. What `run` means."""
    prints: list[str] = []
    while fuel > 0 and isinstance(machine, Running):
        here = machine
        machine, action, printed = step(here, view)
        fuel -= 1
        if printed is not None:
            prints.append(printed)
        if action is not None:
            return Ran(machine, action, tuple(prints), fuel, place(here))
    return Ran(machine, None, tuple(prints), fuel)


def run(machine: Machine, view: View, fuel: int) -> Ran:
    """At most `fuel` steps, up to the first action: the same as `run_by_steps`, several times as fast.

    A run of n + m steps is one of n and, unless that reached an action, one of m (law L12).
    """
    world = view if isinstance(view, Reading) else Reading(view)
    prints: list[str] = []
    while fuel > 0 and isinstance(machine, Running):
        if _between(machine):
            machine, action, fuel, span = _leapt(machine, world, fuel, prints)
            if action is not None:
                return Ran(machine, action, tuple(prints), fuel, span)
        # What comes is costly, stuck, or half done: to the end of that instruction by small steps.
        while fuel > 0 and isinstance(machine, Running):
            machine, action, some, _, span = run_by_steps(machine, world, 1)
            prints += some
            fuel -= 1
            if action is not None:
                return Ran(machine, action, tuple(prints), fuel, span)
            if isinstance(machine, Running) and _between(machine):
                break
    return Ran(machine, None, tuple(prints), fuel)


def _between(machine: Running) -> bool:
    """Does it stand between two instructions?"""
    frame = machine.todo.first
    return isinstance(frame, Each) or frame.done == 0


def _leapt(
    machine: Running, world: Reading, fuel: int, prints: list[str]
) -> tuple[Machine, Action | None, int, Span | None]:
    """Whole instructions, see `fasteroids.lang.machine.fast`."""
    code, store = machine.code, machine.store
    first = machine.todo.first
    instruction = code.blocks[first.block][first.index]
    if instruction.worst > fuel or not instruction.sound:
        return machine, None, fuel, None
    stack: list[Entry] = [
        (f.block, f.index, f.rest if isinstance(f, Each) else None) for f in machine.todo
    ]
    stack.reverse()
    before = dict(store.items())
    env = dict(before)
    left, action, span = leap(code, stack, env, world, fuel, prints)
    changed = store.evolver()
    for name, value in env.items():
        if value is not before[name]:
            changed[name] = value
    todo = _NOTHING
    for block, index, rest in stack:
        todo = todo.cons(_frame(block, index, 0, ()) if rest is None else _each(block, index, rest))
    return _going(code, changed.persistent(), todo), action, left, span


def refreshed(machine: Machine, view: View) -> Machine:
    """The machine with every living entity it holds seen anew, each by one look; a dead one keeps its last state.

    Done once, at the start of a tick. A machine that holds no entity is returned as it is.
    """
    if isinstance(machine, Halted):
        return machine
    world = view if isinstance(view, Reading) else Reading(view)

    def again(value: Value) -> Value:
        return (world.entity(value.id) or value) if type(value) is Seen else value

    def frame(f: Frame | Each) -> Frame | Each:
        if isinstance(f, Each):
            return _each(f.block, f.index, plist(map(again, f.rest)))
        if any(type(o) is Seen for o in f.operands):
            return _frame(f.block, f.index, f.done, tuple(map(again, f.operands)))
        return f

    held = [(name, value) for name, value in machine.store.items() if type(value) is Seen]
    frames = [frame(f) for f in machine.todo]
    moved = any(new is not old for new, old in zip(frames, machine.todo, strict=True))
    if not held and not moved:
        return machine
    store = machine.store.evolver()
    for name, value in held:
        store[name] = again(value)
    todo = plist(frames) if moved else machine.todo
    return _running(machine.code, store.persistent(), todo)


def tick(machine: Machine, view: View, fuel: int) -> Ticked:
    """One run at a tick (1.8): entities are seen anew, then at most `fuel` steps up to the first action."""
    world = Reading(view)
    machine, action, prints, _, span = run(refreshed(machine, world), world, fuel)
    if action is not None:
        return Ticked(machine, action, None, prints, span)
    if isinstance(machine, Running):
        return Ticked(machine, None, "fuel", prints, place(machine))
    end: Literal["end", "halt"] = "end" if machine.reason is None else "halt"
    return Ticked(machine, None, end, prints, machine.span, machine.reason)
