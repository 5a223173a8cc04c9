"""Hypothesis strategies and helpers for those who test against Fasteroids (extra ``testing``).

from hypothesis import given
from fasteroids.testing import worlds, unfold

@given(worlds())
def test_nothing_is_born_twice(world):
    ...
"""

from fasteroids.testing.failures import keeping as keeping
from fasteroids.testing.programs import expressions as expressions
from fasteroids.testing.programs import program_texts as program_texts
from fasteroids.testing.programs import programs as programs
from fasteroids.testing.runs import Run as Run
from fasteroids.testing.runs import unfold as unfold
from fasteroids.testing.scripts import Script as Script
from fasteroids.testing.strategies import actions as actions
from fasteroids.testing.strategies import discs as discs
from fasteroids.testing.strategies import formations as formations
from fasteroids.testing.strategies import machines as machines
from fasteroids.testing.strategies import pairs as pairs
from fasteroids.testing.strategies import scripts as scripts
from fasteroids.testing.strategies import worlds as worlds
from fasteroids.testing.trees import trees as trees
from fasteroids.testing.views import DictView as DictView
from fasteroids.testing.views import histories as histories
from fasteroids.testing.views import views as views

__all__ = [
    "DictView",
    "Run",
    "Script",
    "actions",
    "discs",
    "expressions",
    "formations",
    "histories",
    "keeping",
    "machines",
    "pairs",
    "program_texts",
    "programs",
    "scripts",
    "trees",
    "unfold",
    "views",
    "worlds",
]
