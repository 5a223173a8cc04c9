"""Hypothesis profiles, chosen by FASTEROIDS_PROFILE: dev (default), ci, long."""

from __future__ import annotations

import os

from hypothesis import HealthCheck, settings

_COMMON = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow], print_blob=True)

settings.register_profile("dev", _COMMON, max_examples=30)
settings.register_profile("ci", _COMMON, max_examples=300, derandomize=True)
settings.register_profile("long", _COMMON, max_examples=20_000)
settings.load_profile(os.environ.get("FASTEROIDS_PROFILE", "dev"))
