"""Every benchmark runs, and the yardsticks do what the engine does."""

from __future__ import annotations

import gc
from itertools import islice

import pytest

from benchmarks.__main__ import BENCHMARKS, plain, printed
from benchmarks.measure import TINY, figure
from benchmarks.persistent import PersistentFold
from benchmarks.workload import DENSE, FOREVER, THIN, workload
from benchmarks.yardstick import Entry, Yardstick
from fasteroids import happenings
from fasteroids.overlap import depth


@pytest.mark.parametrize("fold", [Yardstick, PersistentFold])
@pytest.mark.parametrize(("n", "phi", "model"), [
    (3, THIN, "robust"), (40, DENSE, "spec"), (150, DENSE, "robust"), (150, THIN, "robust"),
])  # fmt: skip
def test_the_log_of_a_fold_without_worlds_equals_the_engines(fold, n, phi, model):
    world = workload(n, phi, model=model)
    log: list[Entry] = []
    fold(world).run(600, log)
    expected = islice(happenings(world, FOREVER), 600)
    assert log == [(happened.time, happened.kind, happened.entities) for happened, _ in expected]


def test_the_workload_is_what_it_says():
    discs = workload(50).asteroids
    assert sum(d.vx * d.vx for d in discs) / 50 == pytest.approx(1.0)
    assert sum(d.vy * d.vy for d in discs) / 50 == pytest.approx(1.0)
    assert all(depth(a, b) < 0.0 for a in discs for b in discs if a is not b)
    assert workload(50) == workload(50)


@pytest.mark.parametrize("name", BENCHMARKS)
def test_a_benchmark_runs_at_a_tiny_size(name):
    if name == "peer":
        pytest.importorskip("billiards")
    table = BENCHMARKS[name](TINY)
    assert table.figures
    assert all(plain(f)["what"] for f in table.figures)
    assert printed(table).row_count == len(table.figures)


def test_benchmarks_leave_the_collector_alone_when_imported():
    assert gc.get_threshold()[0] < 200_000


def test_a_bound_is_kept_by_the_median():
    assert figure("x", [1.0, 2.0, 9.0], at_least=2.0).met
    assert figure("x", [1.0, 2.0, 9.0], below=2.0).met is False
    assert figure("x", [1.0]).met is None
