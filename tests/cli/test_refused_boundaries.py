import re

import numpy as np
import pytest
from scans import FAR, RIM, SHEET

from pointchart import InputError, reconstruct, shapes


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ([*RIM, RIM[0], RIM[0]], rf"boundary points {RIM[0]} are named more than once"),
        ([*RIM[:9], RIM[2], *RIM[9:]], rf"boundary points {RIM[2]} are named more than once"),
        ([*RIM[:5], 108, *RIM[6:]], r"1 boundary entries name no point, the first is 108 at position 5; .* 0 to 107"),
        (RIM[:2], r"the boundary has 2 points; a loop needs at least 3"),
        ([RIM[0], RIM[5], RIM[0]], r"the boundary has 2 points; a loop needs at least 3"),
        ([], r"loop.txt: the file is empty"),
        (["# none"], r"loop.txt: the file holds 0 point indices"),
        ([*RIM[:4], "corner", *RIM[4:]], r"loop.txt: line 5 'corner' is not a 0-based point index"),
        ([*RIM[:4], "-3", *RIM[4:]], r"loop.txt: line 5 '-3' is not a 0-based point index"),
        ([*RIM[:4], "7.5", *RIM[4:]], r"loop.txt: line 5 '7.5' is not a 0-based point index"),
        ([*RIM[:4], "99999999999999999999", *RIM[4:]], r"loop.txt: line 5|name no point"),
    ],
    ids=[
        "closed twice",
        "repeated",
        "out of range",
        "two",
        "two and closed",
        "empty",
        "comment",
        "word",
        "minus",
        "half",
        "huge",
    ],
)
@pytest.mark.parametrize("command", ["mesh", "param"])
def test_a_wrong_boundary_file_is_refused(refused, folder, sheet, command, lines, said):
    (folder / "loop.txt").write_text("".join(f"{line}\n" for line in lines))
    out = {"mesh": "out.ply", "param": "out.csv"}[command]
    message = refused(command, sheet, "--boundary", "loop.txt", out=out)
    assert re.search(said, message)


@pytest.mark.parametrize("order", ["as it is", "reversed", "turned", "closed"])
def test_a_boundary_file_may_run_either_way_start_anywhere_and_be_closed(attempt, folder, sheet, order):
    loop = {"as it is": RIM, "reversed": RIM[::-1], "turned": np.roll(RIM, 7), "closed": np.append(RIM, RIM[0])}[order]
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in loop))
    assert attempt("mesh", sheet, "-o", "out.ply", "--boundary", "loop.txt", "--quiet") == (0, "")


def test_boundary_points_outside_the_largest_part_are_named_by_the_rows_of_the_file(refused, folder):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in [5, *(RIM + len(FAR)), 7]))
    assert refused("mesh", "scan.npy", "--component", "largest", "--boundary", "loop.txt") == (
        "boundary points 5, 7 are not among the 108 points that are taken; name points of them"
    )


@pytest.mark.parametrize("entries", [[138], [5, 138], [99999]])
def test_boundary_entries_that_name_no_point_are_named_whatever_is_left_out(refused, folder, entries):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in [*(RIM + len(FAR)), *entries]))
    said = refused("mesh", "scan.npy", "--component", "largest", "--boundary", "loop.txt")
    assert re.search(rf"\b{entries[-1]}\b", said)


def test_a_boundary_file_is_read_in_the_numbering_of_the_file_whatever_is_left_out(refused, folder):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    loop = RIM + len(FAR)
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in [*loop[:9], loop[2], *loop[9:]]))
    said = refused("mesh", "scan.npy", "--component", "largest", "--boundary", "loop.txt")
    assert said.startswith(f"boundary points {loop[2]} are named more than once")


def disorders(loop):
    """Return a loop with its points in a wrong order, in several ways."""
    far = loop.copy()
    far[[3, len(loop) // 2]] = far[[len(loop) // 2, 3]]
    run_back = loop.copy()
    run_back[10:20] = run_back[10:20][::-1]
    return {
        "scrambled": np.random.default_rng(0).permutation(loop),
        "two far points exchanged": far,
        "a run of ten points reversed": run_back,
    }


@pytest.mark.parametrize("disorder", disorders(RIM))
@pytest.mark.parametrize("shape", [SHEET, shapes.hemisphere(500), shapes.sculpture(1000)], ids=["grid", "cap", "face"])
def test_a_boundary_that_crosses_itself_is_refused(shape, disorder):
    with pytest.raises(InputError, match=r"boundary.*(cross|order)"):
        reconstruct(shape.points, disorders(shape.boundary)[disorder])


def test_a_boundary_file_in_scrambled_order_is_refused(refused, folder, sheet):
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in disorders(RIM)["scrambled"]))
    assert "boundary" in refused("mesh", sheet, "--boundary", "loop.txt")


@pytest.mark.parametrize("shape", [SHEET, shapes.hemisphere(500), shapes.sculpture(1000)], ids=["grid", "cap", "face"])
def test_a_boundary_given_by_every_third_point_or_with_two_neighbours_exchanged_is_taken(shape):
    loop = shape.boundary.copy()
    assert reconstruct(shape.points, loop[::3]).certificate.is_one_to_one
    loop[[3, 4]] = loop[[4, 3]]
    assert reconstruct(shape.points, loop).certificate.is_one_to_one
