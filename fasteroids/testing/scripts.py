"""A program that is a list of actions: the least that flies a ship."""

from __future__ import annotations

from attrs import frozen

from fasteroids.actions import Action, Ticked, View

__all__ = ["Script"]


@frozen
class Script:
    """Takes one action a tick, then ends. None in the list is a tick that runs out of fuel.

    A program in the sense of `fasteroids.actions.Program`: immutable, hashable, the same every time.
    """

    actions: tuple[Action | None, ...]

    @property
    def running(self) -> bool:
        """Is there an action left?"""
        return bool(self.actions)

    def tick(self, view: View) -> Ticked:
        """The next action; prints the id of its ship and how many entities it sees."""
        first, *rest = self.actions
        prints = (f"{view.self_id} of {len(view.ids('any'))}",)
        return Ticked(Script(tuple(rest)), first, None if first else "fuel", prints)
