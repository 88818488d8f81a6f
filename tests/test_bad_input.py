import os
import re

import numpy as np
import pytest

from pointchart import InputError, PointchartError, reconstruct, shapes, write_mesh

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
SHEET = shapes.grid(12, 9)
RIM = SHEET.boundary
NO_FACES = np.empty((0, 3), np.int64)
FAR = shapes.grid(6, 5).points + np.array([0, 0, 50])


def with_values(points, *places):
    """Return a copy of the points with some coordinates replaced: (row, axis, value)."""
    changed = points.copy()
    for row, axis, value in places:
        changed[row, axis] = value
    return changed


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Work in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def run(command_line, folder):
    """Run the command line in an empty folder; return its exit code and stderr."""

    def call(*words):
        code, out, err = command_line(*words)
        assert out == ""
        return code, err

    return call


@pytest.fixture
def refused(run, folder):
    """Run a command that has to fail with one sentence and leave all files as they are; return the sentence."""

    def call(command, *words, out="out.ply"):
        sentinel = folder / out
        sentinel.write_bytes(b"old")
        before = sorted(folder.rglob("*"))
        code, err = run(command, *words, "-o", sentinel, "--quiet")
        assert code == 1
        assert err.startswith("pointchart: ")
        assert len(err.splitlines()) == 1
        assert "Traceback" not in err
        assert sentinel.read_bytes() == b"old"
        assert sorted(folder.rglob("*")) == before
        return err.removeprefix("pointchart: ").strip()

    return call


@pytest.fixture
def misused(run, folder):
    """Run a command whose options are wrong usage: exit 2, no file written; return what it says on one line."""

    def call(command, *words, out="out.ply"):
        before = sorted(folder.rglob("*"))
        code, err = run(command, *words, "-o", out)
        assert code == 2
        assert sorted(folder.rglob("*")) == before
        return " ".join(err.replace("\u2502", " ").split())

    return call


@pytest.fixture
def sheet(folder):
    """Write a scan of a grid to sheet.ply."""
    write_mesh(folder / "sheet.ply", SHEET.points, NO_FACES)
    return "sheet.ply"


def places_named(sentence):
    """Return each point that a sentence names together with its place: (row, [x, y, z])."""
    return [
        (int(row), [float(x) for x in place.split(", ")])
        for row, place in re.findall(r"point (\d+) at \(([^)]*)\)", sentence)
    ]


def texts(points):
    return "\n".join(" ".join(map(repr, row)) for row in points.tolist()) + "\n"


# Files


@pytest.mark.parametrize("suffix", ["ply", "obj", "off", "stl", "glb", "xyz", "txt", "csv", "pts", "npy", "npz", "las"])
def test_an_empty_file_is_refused_by_its_name(refused, folder, suffix):
    (folder / f"scan.{suffix}").write_bytes(b"")
    assert refused("mesh", f"scan.{suffix}").startswith(f"scan.{suffix}: ")


@pytest.mark.parametrize("suffix", ["ply", "off", "stl", "glb", "npy", "npz", "las"])
def test_a_file_of_rubbish_is_refused_by_its_name(refused, folder, suffix):
    (folder / f"scan.{suffix}").write_bytes(bytes(range(256)) * 3)
    assert refused("mesh", f"scan.{suffix}").startswith(f"scan.{suffix}: ")


def test_a_missing_file_is_refused(refused):
    assert refused("mesh", "none.ply") == "none.ply: there is no such file; check the name and the folder"


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may read everything")
def test_an_unreadable_file_is_refused(refused, folder, sheet):
    (folder / sheet).chmod(0)
    assert refused("mesh", sheet).startswith("sheet.ply: ")


def test_an_unknown_suffix_is_refused_with_those_known(refused, folder):
    (folder / "scan.docx").write_text("points")
    assert refused("mesh", "scan.docx").startswith(
        "scan.docx: the suffix '.docx' is none of the 15 that can be read: .ply, "
    )


# Points


@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_fewer_than_four_points_are_refused(refused, folder, command, n):
    (folder / "scan.xyz").write_text(texts(SQUARE[:n]))
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = refused(command, "scan.xyz", out=out)
    assert said == f"the scan has {n} points; a surface patch needs at least 4"


@pytest.mark.parametrize("words", [[], ["--component", "largest"]], ids=["whole", "largest"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_broken_coordinates_are_counted_and_the_first_is_named(refused, folder, value, words):
    np.save(folder / "scan.npy", with_values(SHEET.points, (17, 0, value), (40, 2, value), (40, 1, value)))
    said = refused("mesh", "scan.npy", *words)
    assert said == "2 points are NaN or infinite, the first at index 17; remove them from the scan"


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, 2, -3)])
def test_points_on_a_line_are_refused(refused, folder, direction):
    np.save(folder / "scan.npy", np.outer(np.arange(20.0), direction) + 5)
    assert refused("mesh", "scan.npy").startswith("all 20 points lie on one line, which bounds no surface")


def test_points_that_are_all_the_same_are_refused(refused, folder):
    np.save(folder / "scan.npy", np.full((20, 3), 5.4e6))
    assert refused("mesh", "scan.npy").startswith("all 20 points are the same")


def test_three_points_that_repeat_are_too_few(refused, folder):
    np.save(folder / "scan.npy", SQUARE[[0, 1, 2, 0, 1, 2]])
    assert refused("mesh", "scan.npy").startswith("the scan has 3 ")


def test_repeated_points_are_merged_and_said(run, folder):
    np.save(folder / "scan.npy", np.r_[SHEET.points, SHEET.points[[4, 30, 4]]])
    code, err = run("mesh", "scan.npy", "-o", "out.ply")
    assert code == 0
    assert "3 repeated points merged to the first; point_index gives each vertex's row" in err


def test_coordinates_in_millimetres_far_from_the_origin_are_no_trouble(run, folder):
    np.save(folder / "scan.npy", 1000 * SHEET.points + np.array([5e8, 5.4e9, 1e5]))
    assert run("mesh", "scan.npy", "-o", "out.ply", "--quiet") == (0, "")


# Surfaces


def test_two_parts_are_refused_with_their_sizes_and_a_point_of_each(refused, folder):
    np.save(folder / "scan.npy", np.r_[shapes.grid(6, 5).points + np.array([0, 0, 50]), SHEET.points])
    said = refused("mesh", "scan.npy")
    assert said.startswith("the points fall into 2 separate parts, of 108 and 30 points")
    assert said.endswith("in one piece; take the largest (--component largest), or take them one by one")
    in_large, in_small = map(int, re.search(r"\(some of them: (\d+), (\d+)\)", said).groups())
    assert in_small < 30 <= in_large < 138


@pytest.mark.parametrize("closed", [shapes.sphere(500), shapes.torus(48, 20)], ids=["sphere", "torus"])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_a_closed_surface_is_refused(refused, folder, closed, command):
    np.save(folder / "scan.npy", closed.points)
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = refused(command, "scan.npy", out=out)
    assert said.startswith("no boundary was found: ")
    assert said.endswith("lie on a closed surface; give the boundary, or cut the scan open")


@pytest.mark.parametrize("words", [[], ["--component", "largest"]], ids=["alone", "largest of two parts"])
def test_an_annulus_is_refused_with_both_loops_and_four_remedies(refused, folder, words):
    ring = shapes.shuffle(shapes.annulus(), seed=2)
    points = ring.points if not words else np.r_[FAR, ring.points]
    np.save(folder / "scan.npy", points)
    said = refused("mesh", "scan.npy", *words)
    assert said.startswith(
        "the surface has a second boundary, so it is no disc: besides the loop of 96 points, 6.282 long, through point "
    )
    assert said.endswith(
        "; bridge it (--holes bridge), leave it open (--holes open), say which is the outer one (--outer x,y,z), "
        "or give the boundary (--boundary)"
    )
    (here, _), (there, _) = named = places_named(said)
    assert [np.linalg.norm(points[row]) for row in (here, there)] == pytest.approx([1, 0.5])
    for row, place in named:
        assert place == pytest.approx(points[row], abs=1e-5)
    assert float(re.search(r"there is one of 96 points, ([0-9.]+) long", said)[1]) == pytest.approx(np.pi, rel=0.01)


def test_a_moebius_strip_is_refused(refused, folder):
    np.save(folder / "scan.npy", shapes.moebius(64, 7).points)
    assert "no disc" in refused("mesh", "scan.npy")


@pytest.mark.parametrize(
    ("shape", "loop"),
    [
        (shapes.moebius(64, 7), shapes.moebius(64, 7).boundary),
        (shapes.torus(64, 24), 64 * np.arange(24)),
        (shapes.torus(64, 24), np.arange(64)),
    ],
    ids=["Moebius strip", "torus cut across", "torus cut along"],
)
def test_a_surface_that_is_no_disc_is_refused_even_with_a_boundary_given(shape, loop):
    with pytest.raises(PointchartError, match="no disc"):
        reconstruct(shape.points, loop)


# Boundary files


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
def test_a_boundary_file_may_run_either_way_start_anywhere_and_be_closed(run, folder, sheet, order):
    loop = {"as it is": RIM, "reversed": RIM[::-1], "turned": np.roll(RIM, 7), "closed": np.append(RIM, RIM[0])}[order]
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in loop))
    assert run("mesh", sheet, "-o", "out.ply", "--boundary", "loop.txt", "--quiet") == (0, "")


def test_boundary_points_outside_the_largest_part_are_named_by_the_rows_of_the_file(refused, folder):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in [5, *(RIM + len(FAR)), 7]))
    assert refused("mesh", "scan.npy", "--component", "largest", "--boundary", "loop.txt") == (
        "boundary points 5, 7 are not among the 108 points of the largest part; name points of it"
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


# Neighbourhoods


def test_a_radius_that_leaves_points_alone_is_refused_with_one_that_does_not(refused, folder, sheet):
    said = refused("mesh", sheet, "--neighbors", "ball", "--radius", 0.5, "--weights", "uniform")
    assert said.startswith("the radius leaves points ")
    assert said.endswith("the loneliest has its nearest at 1: use a larger radius, or the nearest k")


@pytest.mark.parametrize("radius", [0, -1, "nan", "inf"])
def test_a_radius_that_is_not_positive_is_wrong_usage(misused, sheet, radius):
    said = misused("mesh", sheet, "--neighbors", "ball", "--radius", radius, "--weights", "uniform")
    assert "it has to be positive and finite" in said


def test_too_few_neighbours_leave_points_without_a_path(refused, folder):
    write_mesh(folder / "scan.ply", shapes.relief(300, seed=2).points, NO_FACES)
    said = refused("mesh", "scan.ply", "--neighbors", "nearest", "-k", 2, "--weights", "uniform")
    assert "have no path to the boundary, so their position is undetermined; use a larger neighbourhood" in said


def test_points_without_a_path_are_named_by_the_rows_of_the_file_whatever_is_left_out(refused, folder):
    shape = shapes.relief(300, seed=2)
    np.save(folder / "scan.npy", np.r_[FAR, shape.points])
    options = ["--neighbors", "nearest", "-k", 2, "--weights", "uniform"]
    said = refused("mesh", "scan.npy", "--component", "largest", *options)
    named = np.array([int(row) for row in re.findall(r"\b\d+\b", said.split(" and ")[0])])
    inner = np.setdiff1d(np.arange(300), shape.boundary) + len(FAR)
    assert said.startswith("interior points ")
    assert len(named) == 3
    assert np.isin(named, inner).all()
    np.save(folder / "scan.npy", shape.points)
    assert refused("mesh", "scan.npy", *options).startswith(f"interior points {', '.join(map(str, named - len(FAR)))}")


def test_points_that_hang_on_one_point_are_named(refused, folder):
    shape = shapes.disc(400, seed=1)
    tuft = shape.points[40] + [[0, 0, 0.01], [0.002, 0, 0.02], [0, 0.002, 0.03], [0.002, 0, 0.035]]
    np.save(folder / "scan.npy", np.r_[shape.points, tuft])
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in shape.boundary))
    words = ["--boundary", "loop.txt", "--neighbors", "nearest", "-k", 4, "--weights", "uniform"]
    said = refused("mesh", "scan.npy", *words)
    assert "reach the boundary only through point 40, into which they would collapse" in said or "have no path" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--neighbors", "ball"], "--neighbors ball needs --radius and no -k"),
        (["--neighbors", "ball", "--radius", "3", "-k", "5"], "--neighbors ball needs --radius and no -k"),
        (["--neighbors", "nearest", "--radius", "3"], "takes -k and no --radius; for a ball say --neighbors ball"),
        (["--radius", "3", "-k", "5"], "-k and --radius exclude each other"),
        (["--corners", "0,1,2,3"], "--corners needs --domain square"),
        (["--domain", "square", "--corners", "0,1,2"], "--corners is '0,1,2'; four boundary points are needed"),
        (["--domain", "square", "--corners", "a,b,c,d"], "--corners is 'a,b,c,d'; four boundary points are needed"),
        (["--holes", "closed"], "--holes"),
        (["--component", "2"], "--component"),
    ],
)
def test_options_that_do_not_fit_are_wrong_usage(misused, sheet, words, said):
    assert said in misused("mesh", sheet, *words)


@pytest.mark.parametrize("place", ["", "1,2", "1,2,3,4", "1;2;3", "x,y,z", "1,,3", "0.5,-12,3.25m"])
@pytest.mark.parametrize("command", ["mesh", "param", "boundary"])
def test_a_place_that_is_not_three_numbers_is_wrong_usage(misused, sheet, command, place):
    out = {"mesh": "out.ply", "param": "out.csv", "boundary": "out.txt"}[command]
    said = misused(command, sheet, "--outer", place, out=out)
    assert f"--outer is '{place}'; a place is needed, such as 0.5,-12,3.25" in said


@pytest.mark.parametrize("place", ["nan,0,0", "0,inf,0", "0,0,-inf"])
def test_a_place_that_is_not_finite_is_refused(misused, sheet, place):
    said = misused("mesh", sheet, "--outer", place, out="out.ply")
    assert f"--outer is '{place}'; a place is needed" in said


@pytest.mark.parametrize("command", ["mesh", "param"])
def test_a_boundary_and_a_place_of_it_exclude_each_other(misused, folder, sheet, command):
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in RIM))
    out = {"mesh": "out.ply", "param": "out.csv"}[command]
    said = misused(command, sheet, "--boundary", "loop.txt", "--outer", "0,0,0", out=out)
    assert "--boundary and --outer exclude each other" in said


@pytest.mark.parametrize("command", ["mesh", "param"])
@pytest.mark.parametrize("repeated", [0, 20], ids=["as it is", "with repeated points"])
def test_corners_off_the_boundary_are_refused(refused, folder, command, repeated):
    np.save(folder / "scan.npy", np.r_[np.repeat(SHEET.points[[40]], repeated, axis=0), SHEET.points])
    corners = ",".join(str(i + repeated) for i in (0, 11, 107, 94))
    out = {"mesh": "out.ply", "param": "out.csv"}[command]
    said = refused(command, "scan.npy", "--domain", "square", "--corners", corners, out=out)
    assert said == f"corners {94 + repeated} are not on the boundary; choose boundary points"


def test_corners_off_the_boundary_are_named_by_the_rows_of_the_file_whatever_is_left_out(refused, folder):
    np.save(folder / "scan.npy", np.r_[FAR, SHEET.points])
    words = ["--component", "largest", "--domain", "square", "--corners", "30,41,137,70"]
    assert refused("mesh", "scan.npy", *words) == "corners 70 are not on the boundary; choose boundary points"


@pytest.mark.parametrize("holes", [-1, "one", 0.5])
def test_a_number_of_holes_that_is_none_is_wrong_usage(run, sheet, holes):
    code, err = run("check", sheet, "--holes", holes)
    assert code == 2
    assert "--holes" in err


def test_a_report_never_replaces_what_is_checked(run, folder, sheet):
    run("mesh", sheet, "-o", "mesh.ply", "--quiet")
    for report in ("mesh.ply", sheet):
        before = (folder / report).read_bytes()
        code, err = run("check", "mesh.ply", "--points", sheet, "--report", report)
        assert code == 1
        assert "the suffix '.ply' cannot be written here; choose one of .json" in err
        assert (folder / report).read_bytes() == before


def test_a_demo_in_an_impossible_folder_is_refused(run, sheet):
    code, err = run("demo", "-o", f"{sheet}/inside")
    assert code == 1
    assert "the folder cannot be made" in err


# Outputs


def test_the_output_must_not_be_the_input(run, folder, sheet):
    before = (folder / sheet).read_bytes()
    for out in (sheet, folder / sheet, f"./{sheet}"):
        code, err = run("mesh", sheet, "-o", out)
        assert code == 1
        assert "the output is also sheet.ply, which would be lost; choose another output" in err
    assert (folder / sheet).read_bytes() == before


def test_the_output_must_not_be_the_boundary_nor_the_report_an_input(run, folder, sheet):
    (folder / "loop.txt").write_text("".join(f"{i}\n" for i in RIM))
    before = (folder / "loop.txt").read_bytes()
    code, err = run("param", sheet, "--boundary", "loop.txt", "-o", "loop.txt")
    assert code == 1
    assert "the output is also loop.txt" in err
    assert (folder / "loop.txt").read_bytes() == before


@pytest.mark.parametrize(
    ("out", "said"),
    [
        ("none/out.ply", "the folder .*none does not exist; create it first"),
        ("sheet.ply/out.ply", "is a file and not a folder"),
        ("out.docx", "the suffix '.docx' cannot be written here; choose one of .ply, .obj, .off, .stl, .glb, .npz"),
        ("out", "the suffix '' cannot be written here; choose one of"),
        ("folder.ply", "this is a folder; name a file in it"),
    ],
)
def test_an_output_that_cannot_be_written_is_refused_before_the_run(run, folder, sheet, out, said):
    (folder / "folder.ply").mkdir()
    before = sorted(folder.rglob("*"))
    code, err = run("mesh", sheet, "-o", out)
    assert code == 1
    assert re.search(said, err)
    assert sorted(folder.rglob("*")) == before


def test_a_report_that_cannot_be_written_is_refused_before_the_run(run, folder, sheet):
    code, err = run("mesh", sheet, "-o", "out.ply", "--report", "none/run.json")
    assert code == 1
    assert "does not exist; create it first" in err
    code, err = run("mesh", sheet, "-o", "out.ply", "--report", "run.txt")
    assert code == 1
    assert "the suffix '.txt' cannot be written here; choose one of .json" in err
    assert sorted(path.name for path in folder.iterdir()) == [sheet]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--ply", "none/out.ply"], "the folder .*none does not exist; create it first"),
        (["--picture", "none/out.png"], "the folder .*none does not exist; create it first"),
        (["--ply", "out.obj"], r"the suffix '.obj' cannot be written here; choose one of .ply"),
        (["--picture", "out.jpg"], r"the suffix '.jpg' cannot be written here; choose one of .png"),
        (["--ply", "folder.ply"], "this is a folder; name a file in it"),
        (["--ply", "sheet.ply"], "sheet.ply: the output is also sheet.ply, which would be lost"),
        (["--ply", "link.ply"], "link.ply: the output is also sheet.ply, which would be lost"),
        (["--picture", "link.png"], "link.png: the output is also sheet.ply, which would be lost"),
        (["--ply", "twin.ply"], "twin.ply: the output is .*loop.txt, which would be lost"),
        (["--picture", "twin.png"], "twin.png: the output is .*loop.txt, which would be lost"),
    ],
)
def test_a_boundary_run_whose_outputs_cannot_all_be_written_writes_none(run, folder, sheet, words, said):
    (folder / "loop.txt").write_text("old")
    (folder / "folder.ply").mkdir()
    for suffix in (".ply", ".png"):
        (folder / f"link{suffix}").symlink_to(folder / sheet)
        (folder / f"twin{suffix}").hardlink_to(folder / "loop.txt")
    before = {path: path.is_file() and path.read_bytes() for path in folder.rglob("*")}
    others = {"--ply": ["--picture", "other.png"], "--picture": ["--ply", "other.ply"]}[words[0]]
    code, err = run("boundary", sheet, "-o", "loop.txt", *words, *others)
    assert code == 1
    assert len(err.splitlines()) == 1
    assert re.search(said, err)
    assert {path: path.is_file() and path.read_bytes() for path in folder.rglob("*")} == before


@pytest.mark.parametrize(
    "words",
    [
        ["mesh", "-o", "twin.ply", "--report", "twin.json"],
        ["boundary", "-o", "out.txt", "--ply", "twin.ply", "--picture", "twin.png"],
    ],
)
def test_two_outputs_that_are_one_file_are_refused(run, folder, sheet, words):
    (folder / "old").write_text("old")
    for suffix in ("ply", "png", "json"):
        (folder / f"twin.{suffix}").symlink_to(folder / "old")
    command, *options = words
    code, err = run(command, sheet, *options, "--quiet")
    assert code == 1
    assert re.search(r"twin\.\w+: the output is .*twin\.\w+, which would be lost", err)
    assert (folder / "old").read_text() == "old"
    assert not (folder / "out.txt").exists()


def test_a_boundary_file_must_not_replace_the_scan(run, folder):
    (folder / "scan.txt").write_text(texts(SHEET.points))
    code, err = run("boundary", "scan.txt", "-o", "scan.txt", "--ply", "out.ply")
    assert code == 1
    assert "scan.txt: the output is also scan.txt, which would be lost; choose another output" in err
    assert [path.name for path in folder.iterdir()] == ["scan.txt"]


def test_a_surface_without_a_boundary_leaves_no_picture_and_no_curves(refused, folder):
    np.save(folder / "scan.npy", shapes.sphere(400).points)
    (folder / "out.ply").write_text("old")
    words = ["--picture", "out.png", "--ply", "out.ply"]
    assert refused("boundary", "scan.npy", *words, out="out.txt").startswith("no boundary was found: ")
    assert (folder / "out.ply").read_text() == "old"


def test_a_mesh_that_its_format_cannot_hold_leaves_no_report(run, folder):
    np.save(folder / "scan.npy", 1e-9 * shapes.disc(300, seed=1).points + [1, 0, 0])
    code, err = run("mesh", "scan.npy", "-o", "out.stl", "--report", "run.json", "--quiet")
    assert code == 1
    assert "STL holds single precision, which makes " in err
    assert [path.name for path in folder.iterdir()] == ["scan.npy"]


@pytest.mark.parametrize("out", ["out.stl", "out.GLB"])
def test_a_format_that_cannot_hold_the_scan_is_refused_before_the_run(run, folder, out):
    far = 1e-9 * shapes.disc(300, seed=1).points + [1, 0, 0]
    np.save(
        folder / "scan.npy", np.vstack([far, far + np.array([0, 1, 0])])
    )  # in two parts, which the run would refuse
    code, err = run("mesh", "scan.npy", "-o", out, "--quiet")
    assert code == 1
    assert "holds single precision, which makes " in err


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write everywhere")
def test_a_folder_without_permission_is_refused_before_the_run(run, folder, sheet):
    (folder / "locked").mkdir(mode=0o500)
    code, err = run("mesh", sheet, "-o", "locked/out.ply")
    assert code == 1
    assert "there is no permission to write" in err


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write everywhere")
@pytest.mark.parametrize("words", [["--ply", "old.ply"], ["--picture", "old.png"]])
def test_a_boundary_run_with_a_read_only_output_writes_none(run, folder, sheet, words):
    (folder / words[1]).write_text("old")
    (folder / words[1]).chmod(0o400)
    code, err = run("boundary", sheet, "-o", "loop.txt", *words)
    assert code == 1
    assert f"{words[1]}: the file exists and is read-only; remove it or choose another output" in err
    assert sorted(path.name for path in folder.iterdir()) == [words[1], sheet]


@pytest.mark.parametrize(
    "words",
    [
        ["mesh", "-o", "out.ply", "--report", "run.json"],
        ["check", "--report", "run.json"],
        ["boundary", "-o", "out.txt", "--ply", "out.ply", "--picture", "out.png"],
    ],
)
def test_a_full_disk_or_a_broken_file_ends_in_one_sentence(run, folder, sheet, monkeypatch, words):
    def full(*_):
        raise OSError(28, "No space left on device")

    run("mesh", sheet, "-o", "mesh.ply", "--quiet")
    monkeypatch.setattr("os.replace", full)
    command, *options = words
    code, err = run(command, "mesh.ply", *options, "--quiet")
    assert code == 1
    assert "it cannot be written (No space left on device); free the disk or choose another output" in err
    assert sorted(path.name for path in folder.iterdir()) == ["mesh.ply", sheet]
