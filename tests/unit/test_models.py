"""The accuracy levels, by name."""

from __future__ import annotations

from math import inf, nan, sqrt
from typing import Any

import pytest

from fasteroids import Asteroid, ModelError, World, models, time_to_contact
from fasteroids.models import DEFAULT, MODELS, named, robust, spec
from fasteroids.physics import NEVER, contact_time_exact

Pair = tuple[float, float, float, float, float, float, float, float, float, float]

ORDINARY: Pair = (100.0, 120.0, 30.0, -10.0, 20.0, 400.0, 90.0, -50.0, 5.0, 35.0)
FAR: Pair = (0.0, 0.0, 0.6, 0.8, 3.0, 6e8, 8e8, 0.0, 0.0, 3.0)


def test_there_are_robust_and_spec_and_robust_is_the_default() -> None:
    assert set(MODELS) >= {"robust", "spec"}
    assert DEFAULT == "robust" == World(1, 1).model


@pytest.mark.parametrize("name", ["robust", "spec"])
def test_named_gives_the_model_of_that_name(name: str) -> None:
    model = named(name)
    assert model is MODELS[name]
    assert (model.name, model.thrust) == (name, "literal")
    assert model.promise


def test_the_models_cannot_be_changed() -> None:
    with pytest.raises(TypeError):
        MODELS["mine"] = robust.MODEL  # type: ignore[index]
    with pytest.raises(AttributeError):
        robust.MODEL.name = "mine"  # type: ignore[misc]


def test_an_unknown_model_is_refused_with_the_nearest_name_and_all_there_are() -> None:
    with pytest.raises(ModelError, match=r"no model 'rubust' \(did you mean 'robust'\?\).*'spec'"):
        named("rubust")
    with pytest.raises(ModelError, match="no model 'x'; there are"):
        World(10, 10, model="x")


@pytest.mark.parametrize("bad", [None, 3, nan, ["robust"], b"robust", "", "Robust", {}])
def test_a_name_that_is_none_is_refused(bad: Any) -> None:
    with pytest.raises(ModelError, match="there is no model"):
        named(bad)
    with pytest.raises(ModelError, match="there is no model"):
        World(10, 10, model=bad)
    disc = Asteroid(0, 0, 0, 0, 1)
    with pytest.raises(ModelError, match="there is no model"):
        time_to_contact(disc, disc, model=bad)


def formula(pair: Pair) -> float:
    """The text, 1.5.1, word for word."""
    xi, yi, vxi, vyi, ri, xj, yj, vxj, vyj, rj = pair
    dx, dy, dvx, dvy, sigma = xj - xi, yj - yi, vxj - vxi, vyj - vyi, ri + rj
    rr, vv, vr = dx * dx + dy * dy, dvx * dvx + dvy * dvy, dvx * dx + dvy * dy
    d = vr * vr - vv * (rr - sigma * sigma)
    return inf if vr >= 0 or d <= 0 else -(vr + sqrt(d)) / vv


def test_spec_is_the_formula_of_the_text() -> None:
    assert spec.contact_time(*ORDINARY) == formula(ORDINARY) < inf
    assert named("spec").contact_time(*ORDINARY) == formula(ORDINARY)


def test_robust_and_spec_agree_on_an_ordinary_pair() -> None:
    exact = contact_time_exact(*ORDINARY)
    assert named("robust").contact_time(*ORDINARY) == pytest.approx(exact, rel=8 * 2.0**-53, abs=0)
    assert named("spec").contact_time(*ORDINARY) == pytest.approx(exact, rel=64 * 2.0**-53, abs=0)


def test_robust_sees_what_spec_misses() -> None:
    assert named("spec").contact_time(*FAR) == NEVER
    assert named("robust").contact_time(*FAR) == 999999994.0


def test_robust_falls_back_where_its_filter_is_undecided() -> None:
    tangent: Pair = (0.0, 0.0, 1.0, 0.0, 3.0, 100.0, 5.0, 0.0, 0.0, 2.0)
    filtered = robust.MODEL.filtered(*tangent)
    assert filtered != filtered
    assert robust.MODEL.contact_time(*tangent) == NEVER == robust.MODEL.exact(*tangent)


@pytest.mark.parametrize("name", ["robust", "spec"])
def test_every_level_keeps_the_stable_rule(name: str) -> None:
    time = named(name).contact_time
    overlapping_and_approaching: Pair = (0.0, 0.0, 1.0, 0.0, 3.0, 5.0, 0.0, 0.0, 0.0, 3.0)
    overlapping_and_receding: Pair = (0.0, 0.0, -1.0, 0.0, 3.0, 5.0, 0.0, 0.0, 0.0, 3.0)
    assert time(*overlapping_and_approaching) == 0.0
    assert time(*overlapping_and_receding) == NEVER


@pytest.mark.parametrize("name", ["robust", "spec"])
@pytest.mark.parametrize("wrong", [nan, inf, -inf, 1e308, -1e308, 5e-324])
@pytest.mark.parametrize("place", range(10))
def test_every_level_answers_whatever_it_is_given(name: str, wrong: float, place: int) -> None:
    pair = list(ORDINARY)
    pair[place] = wrong
    assert named(name).contact_time(*pair) >= 0.0


def test_spec_zero_denominator_is_never() -> None:
    # vv underflows to zero while vr does not.
    assert spec.contact_time(0, 0, 1e-200, 0, 1, 1e200, 0, 0, 0, 1) == NEVER


def test_a_world_obeys_its_model() -> None:
    assert time_to_contact(Asteroid(*FAR[:5]), Asteroid(*FAR[5:])) == 999999994.0
    assert time_to_contact(Asteroid(*FAR[:5]), Asteroid(*FAR[5:]), model="spec") == NEVER
    assert models.named(World(1, 1, model="spec").model).exact is spec.contact_time
