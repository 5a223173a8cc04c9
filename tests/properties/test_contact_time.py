"""The contract of `robust`: right for all doubles, and as near as the inputs allow."""

from __future__ import annotations

from math import inf, isinf

from hypothesis import given

from fasteroids.models import robust
from fasteroids.physics import contact_time_exact, contact_time_filtered
from fasteroids.testing import pairs


@given(pairs())
def test_contact_time_filter_agrees_with_the_exact_formula(pair: tuple[float, ...]) -> None:
    filtered, exact = contact_time_filtered(*pair), contact_time_exact(*pair)
    if filtered == filtered:
        assert isinf(filtered) == isinf(exact)
        assert (filtered <= 0.0) == (filtered == 0.0)
    assert (exact if filtered != filtered else filtered) == robust.MODEL.contact_time(*pair)
    assert 0.0 <= exact <= inf
