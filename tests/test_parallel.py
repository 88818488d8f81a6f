import math
import os
from threading import Barrier

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from threadpoolctl import threadpool_info

from pointchart import _parallel, nearest, shapes
from pointchart._parallel import FEWEST, Team, core_quota, n_threads, on_threads, over_ranges


@pytest.fixture
def groups(tmp_path):
    """Return a function that puts this process into the control group a/b with the limits given."""

    def put(**limits):
        (tmp_path / "groups/a/b").mkdir(parents=True)
        (tmp_path / "membership").write_text("2:cpu:/\n0::/a/b\n")
        for name, limit in limits.items():
            (tmp_path / "groups" / name.replace("_", "/") / "cpu.max").write_text(f"{limit} 100000\n")
        return core_quota(tmp_path / "groups", tmp_path / "membership")

    return put


@pytest.mark.parametrize(
    ("limits", "cores"),
    [
        ({}, math.inf),
        ({"a_b": "max"}, math.inf),
        ({"a_b": 150_000}, 1.5),
        ({"a": 50_000, "a_b": 300_000}, 0.5),
        ({"": 200_000, "a_b": "max"}, 2.0),
    ],
)
def test_the_quota_is_the_least_of_the_groups_around_a_process(groups, limits, cores):
    assert groups(**limits) == cores


def test_there_is_no_quota_without_control_groups(tmp_path):
    assert core_quota(tmp_path, tmp_path / "membership") == math.inf


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="this system has no affinities")
@pytest.mark.parametrize(("quota", "cores"), [(0.2, 1), (1.5, 2), (64.0, 3), (math.inf, 3)])
def test_a_process_uses_the_cores_of_its_affinity_and_quota(monkeypatch, quota, cores):
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {0, 2, 5})
    monkeypatch.setattr(_parallel, "core_quota", lambda: quota)
    assert _parallel.usable_cores.__wrapped__() == cores


def test_threads_are_as_many_as_asked_for_those_of_the_linear_algebra_included():
    before = n_threads()
    with on_threads(before + 1):
        assert n_threads() == before + 1
        with on_threads(1):
            assert n_threads() == 1
            assert {pool["num_threads"] for pool in threadpool_info()} == {1}
        with on_threads(None):
            assert n_threads() == before
    assert n_threads() == before


def test_ranges_cover_all_on_any_number_of_threads():
    n = 2 * _parallel.CHUNK + 5
    for threads in (1, 3):
        seen = np.zeros(n, int)

        def count(first, last, seen=seen):
            seen[first:last] += 1

        with on_threads(threads):
            over_ranges(count, n)
        assert (seen == 1).all()


def test_results_do_not_depend_on_the_number_of_threads():
    points = shapes.disc(_parallel.CHUNK + 300).points
    with on_threads(1):
        alone = nearest(points, 8)
    with on_threads(4):
        together = nearest(points, 8)
    assert np.array_equal(alone.indices, together.indices)


# Teams


@settings(max_examples=40)
@given(st.lists(st.integers(0, 500), min_size=1, max_size=4), st.integers(1, 60), st.integers(1, 6))
def test_a_team_covers_all_once_in_whole_blocks_of_which_no_thread_but_the_last_has_few(lengths, block, threads):
    with on_threads(threads), Team() as team:
        for n in lengths:
            seen = []
            team(n, block, lambda first, last, seen=seen: seen.append((first, last)))
            seen.sort()
            assert [i for first, last in seen for i in range(first, last)] == list(range(n))
            assert len(seen) <= threads
            assert all(first % block == 0 for first, _ in seen)
            assert all(last - first >= FEWEST * block for first, last in seen[:-1])


def test_a_team_works_on_as_many_threads_as_are_given():
    together = Barrier(3, timeout=60)
    with on_threads(3), Team() as team:
        team(3 * FEWEST, 1, lambda first, last: together.wait())
    assert not together.broken


def test_a_team_passes_arguments_on_before_the_range():
    total = np.zeros(100, int)

    def add(numbers, factor, into, first, last):
        into[first:last] += factor * numbers[first:last]

    with on_threads(3), Team() as team:
        for _ in range(5):
            team(100, 7, add, np.arange(100), 3, total)
    assert np.array_equal(total, 15 * np.arange(100))


@pytest.mark.parametrize("broken", [0, 1, 2])
def test_a_team_raises_what_a_kernel_raises_on_any_thread(broken):
    def work(first, last):
        if first == broken * FEWEST:
            raise ZeroDivisionError(f"rows {first} to {last}")

    with on_threads(3), pytest.raises(ZeroDivisionError, match=f"rows {broken * FEWEST} to"), Team() as team:
        team(3 * FEWEST, 1, work)
