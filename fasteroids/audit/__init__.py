"""How well a run kept the laws: for each law the worst margin seen, as a fold over `happenings`.

Nothing the engine says is taken on trust. Which flights an event changed is found by comparing the worlds
before and after it; positions come from the flights, and overlaps from every pair of flights over the time
they had in common. A collision that was missed, late or wrong shows as an overlap deeper than rounding allows.

Containment (law L7) between events: two flights are two straight lines, so the square of the distance of their
centres is a convex parabola in time. It is least at its vertex, clamped to the time both flights lasted: one
evaluation a pair is complete. A pair is looked at when the first of its flights ends (O(N) for each flight that
ends), and once more when the run does. A coordinate is linear, so a flight leaves the world farthest at its ends.

Where a thruster bends a flight (thrust rule `smooth`) the distance need not be convex. With B the largest relative
acceleration its second derivative is at least -B, so from the distance and its change at two moments follows a lower
bound for all between. The worst depth is found by branch and bound on it: an interval is split until no overlap in it
can be deeper than the deepest seen, nor than a quarter of what is allowed or the worst share of the run so far. (At
most 4096 distances a pair, the most suspicious first.) A coordinate is farthest out at the ends or where its
velocity changes sign, which it does at most once. How the engine finds contacts and walls is not used.

What is allowed: `overlap.slack`, the largest an entity has had in the run so far. An overlap that rounding left
stays until the pair has parted, so a flight inherits what the faster or longer ones before it were allowed, and
what is born inherits it from those in the event of its birth. Where the world overlapped before the run, or stuck
out, that much is allowed on top: it is not the run's doing. Own bullets are exempt.
"""

from __future__ import annotations

from fasteroids.audit._auditor import Auditor as Auditor
from fasteroids.audit._balance import imbalance as imbalance
from fasteroids.audit._margins import Audit as Audit
from fasteroids.audit._margins import Margin as Margin
from fasteroids.events import happenings
from fasteroids.state import World

__all__ = ["Audit", "Auditor", "Margin", "audit", "imbalance"]


def audit(world: World, until: float, *, max_events: int | None = None) -> Audit:
    """Audit the run of a world up to `until` (absolute, s), or for `max_events` events."""
    auditor = Auditor(world)
    unfold = happenings(world, until, max_events=max_events)
    while True:
        try:
            auditor.see(*next(unfold))
        except StopIteration as stop:
            return auditor.finish(stop.value)
