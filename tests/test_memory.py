import numpy as np
import pytest

from pointchart import InputError, _memory, shapes
from pointchart._memory import check_room, free_bytes, peak_memory_mb
from pointchart.boundary.bounded import survey_scan


def test_a_scan_that_will_not_fit_is_refused_with_both_numbers_and_a_remedy(monkeypatch):
    monkeypatch.setattr(_memory, "free_bytes", lambda: 1_800_000_000)
    with pytest.raises(InputError, match=r"3000000 points need about 2\.7 GB of memory, and 1\.8 GB are free; .*thin"):
        check_room(3_000_000)
    check_room(2_000_000)


def test_where_the_system_does_not_tell_nothing_is_refused(monkeypatch):
    monkeypatch.setattr(_memory, "free_bytes", lambda: None)
    check_room(10**12)


def test_a_run_asks_before_it_starts(monkeypatch):
    monkeypatch.setattr(_memory, "FEW", 100)
    monkeypatch.setattr(_memory, "free_bytes", lambda: 0)
    with pytest.raises(InputError, match="memory"):
        survey_scan(shapes.grid(12, 9).points)


@pytest.mark.parametrize(("most", "used", "left"), [("1000", "300", 700), ("1000", "1300", 0), ("max", "300", None)])
def test_the_limit_of_a_container_counts(tmp_path, most, used, left):
    group = tmp_path / "outer" / "inner"
    group.mkdir(parents=True)
    (group.parent / "memory.max").write_text(f"{most}\n")
    (group.parent / "memory.current").write_text(f"{used}\n")
    (tmp_path / "membership").write_text("0::/outer/inner\n")
    assert _memory._free_of_group(tmp_path, tmp_path / "membership") == left


def test_the_machine_has_memory_left():
    free = free_bytes()
    assert free is None or free > 0


def test_the_peak_memory_never_falls_and_holds_the_largest_array():
    before = peak_memory_mb()
    size_mb = np.ones(2**24).nbytes // 2**20
    assert peak_memory_mb() >= max(before, size_mb)
    assert before < 10**6
