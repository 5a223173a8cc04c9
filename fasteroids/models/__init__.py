"""The accuracy ladder: levels of decision and rules of thrust, known by name.

A `Model` joins a decision level (when do two discs touch?) with a thrust rule (how does a thrusting ship move?).
Each level offers ``filtered``, plain float arithmetic that may answer UNDECIDED, and ``exact``, asked only then.
Choose one by name: ``World(width, height, model="spec")``.
"""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import Final

from fasteroids.models import robust, smooth, spec
from fasteroids.models._model import ContactTime as ContactTime
from fasteroids.models._model import Model as Model
from fasteroids.models._model import ThrustRule as ThrustRule
from fasteroids.units import ModelError, shown

__all__ = ["DEFAULT", "MODELS", "ContactTime", "Model", "ThrustRule", "named"]

MODELS: Final[Mapping[str, Model]] = MappingProxyType(
    {model.name: model for model in (spec.MODEL, robust.MODEL, smooth.MODEL)}
)
"""Every model by name."""

DEFAULT: Final = robust.MODEL.name


def named(name: str) -> Model:
    """The model of that name; an unknown one raises `ModelError` with the names there are."""
    if isinstance(name, str) and name in MODELS:
        return MODELS[name]
    near = get_close_matches(name, MODELS, n=1) if isinstance(name, str) else []
    hint = f" (did you mean {near[0]!r}?)" if near else ""
    raise ModelError(
        f"there is no model {shown(name)}{hint}; there are {', '.join(map(repr, MODELS))}"
    )
