"""Draw the rooms of the package from its imports, and write their tables: ``python docs/rooms.py``.

What it writes, the picture and what stands between the two marks in developers.md, is never edited by hand.
"""

import ast
import tomllib
from collections.abc import Iterable
from functools import cache
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "pointchart"
PAGE, PICTURE = ROOT / "docs" / "developers.md", ROOT / "docs" / "figures" / "rooms.svg"
BEGIN, END = "<!-- written by docs/rooms.py: make rooms -->\n", "<!-- end of what docs/rooms.py writes -->\n"
PAPER, MUTED, INK, ACCENT = "#fbfaf7", "#7b8790", "#22303c", "#a8402b"
WIDTH, STEP = 720, 68  # of the picture, and from one level of it to the next
BOX, HEIGHT, LANE, GAP = 136, 34, 20, 16  # a room, and the lane of a line that passes a level without ending there
ROUNDS = 8

Stop = tuple[int, str, str]  # a level with a room twice, or with importer and imported of a line that passes it
Row = tuple[str, str]
Graph = dict[str, set[str]]


def modules(folder: Path = PACKAGE) -> list[Path]:
    """Return the modules of a folder and of those in it."""
    return sorted(path for path in folder.rglob("*.py") if path.name not in ("__init__.py", "__main__.py"))


def name_of(path: Path) -> str:
    """Return the room that a module is in; modules that lie flat are called as their files are."""
    inside = path.relative_to(PACKAGE)
    return inside.parts[0] if len(inside.parts) > 1 or inside.stem.startswith("__") else inside.name


def purpose(path: Path) -> str:
    """Return the first line of a module's docstring."""
    text = ast.get_docstring(ast.parse(path.read_text())) or ""
    return text.partition("\n")[0].replace("|", "\\|")


def imports_of(path: Path) -> set[str]:
    """Return what a module imports of the package, as dotted paths below it."""
    folders = list(path.relative_to(PACKAGE).parts[:-1])
    found = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and (node.level or (node.module or "").partition(".")[0] == "pointchart"):
            start = folders[: len(folders) - node.level + 1] if node.level else []
            named = (node.module or "").split(".")[0 if node.level else 1 :]
            found |= {".".join(filter(None, [*start, *named, alias.name])) for alias in node.names}
    return found


def rooms_imported(path: Path) -> set[str]:
    """Return the rooms and flat modules that a module imports, its own left out."""
    tops = {dotted.partition(".")[0] for dotted in imports_of(path)}
    named = {top if (PACKAGE / top).is_dir() else f"{top}.py" for top in tops}
    return {name for name in named if (PACKAGE / name).exists()} - {name_of(path)}


@cache
def layers() -> list[str]:
    """Return rooms and flat modules in pipeline order: the layers that import-linter holds, the lowest first."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
    listed = next(contract["layers"] for contract in settings if contract["type"] == "layers")
    names = [name.strip(" ()") for layer in reversed(listed) for name in layer.replace(":", "|").split("|")]
    return [name if (PACKAGE / name).is_dir() else f"{name}.py" for name in names if not name.startswith("__")]


@cache
def graph() -> Graph:
    """Return the rooms, and the flat modules that import one, each with those that it imports; kernels left out."""
    every: Graph = {name: set() for name in layers()}
    for path in [*modules(), *PACKAGE.rglob("*/__init__.py")]:
        every[name_of(path)] |= rooms_imported(path)
    every.pop("_kernels")
    drawn = [name for name, found in every.items() if (PACKAGE / name).is_dir() or found & _folders()]
    return {name: every[name] & set(drawn) for name in drawn}


def _folders() -> set[str]:
    return {path.parent.name for path in PACKAGE.glob("*/__init__.py")} - {"_kernels"}


def reduced(whole: Graph) -> Graph:
    """Leave out what a room imports through another one anyway."""

    @cache
    def reach(name: str) -> frozenset[str]:
        return frozenset(whole[name]).union(*(reach(other) for other in whole[name]))

    return {
        name: {one for one in found if not any(one in reach(other) for other in found if other != one)}
        for name, found in whole.items()
    }


def levels(lines: Graph) -> dict[str, int]:
    """Return how deep each room stands: below all that it imports, and what imports nothing just above its users."""

    @cache
    def depth(name: str) -> int:
        return 1 + max(map(depth, lines[name]), default=-1)

    users = {name: [depth(other) for other, found in lines.items() if name in found] for name in lines}
    return {name: depth(name) if lines[name] else min(users[name], default=1) - 1 for name in lines}


def stops(lines: Graph, at: dict[str, int]) -> tuple[list[list[Stop]], list[tuple[Stop, Stop]]]:
    """Return what stands on each level, and what is joined: rooms, and lanes for lines that pass a level."""
    rows = [[(level, name, name) for name in lines if at[name] == level] for level in range(1 + max(at.values()))]
    links = []
    for name, found in lines.items():
        for other in sorted(found):
            lane = [(level, name, other) for level in range(at[other] + 1, at[name])]
            chain = [(at[other], other, other), *lane, (at[name], name, name)]
            links += pairwise(chain)
            for stop in lane:
                rows[stop[0]].append(stop)
    return rows, links


def placed(rows: list[list[Stop]], links: list[tuple[Stop, Stop]]) -> dict[Stop, float]:
    """Return how far right each stop is: each is brought near those that it is joined to, so that few lines cross."""
    joined: dict[Stop, list[Stop]] = {stop: [] for row in rows for stop in row}
    for above, below in links:
        joined[above].append(below)
        joined[below].append(above)
    x: dict[Stop, float] = {}
    for _ in range(ROUNDS):
        for row in rows:
            row.sort(key=lambda stop: sum(x.get(other, 0.5 * WIDTH) for other in joined[stop]) / len(joined[stop]))
            widths = [BOX if stop[1] == stop[2] else LANE for stop in row]
            left = 0.5 * (WIDTH - sum(widths) - GAP * (len(row) - 1))
            for stop, width in zip(row, widths, strict=True):
                x[stop] = left + 0.5 * width
                left += width + GAP
    return x


def drawing() -> str:
    """Return the picture: a line leads from each room up to those that it imports."""
    lines = reduced(graph())
    rows, links = stops(lines, levels(lines))
    x = placed(rows, links)
    body = [_line(x[above], above, x[below], below) for above, below in links]
    body += [_box(x[stop], stop) for row in rows for stop in row if stop[1] == stop[2]]
    height = STEP * len(rows)
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif">',
            f'<rect width="{WIDTH}" height="{height}" fill="{PAPER}"/>',
            *body,
            "</svg>\n",
        ]
    )


def _line(x: float, above: Stop, to_x: float, below: Stop) -> str:
    y, to_y = _middle(above) + 0.5 * HEIGHT, _middle(below) - 0.5 * HEIGHT
    bend = 0.5 * (y + to_y)
    path = f"M{x:.0f} {y:.0f}C{x:.0f} {bend:.0f} {to_x:.0f} {bend:.0f} {to_x:.0f} {to_y:.0f}"
    path += f"v{HEIGHT}" if below[1] != below[2] else ""  # down its lane, straight
    return f'<path d="{path}" fill="none" stroke="{ACCENT}" stroke-width="1.5"/>'


def _box(x: float, stop: Stop) -> str:
    y, name = _middle(stop), stop[1]
    path = PACKAGE / name
    is_room = path.is_dir()
    count = f'<tspan font-size="11" fill="{MUTED}"> {len(modules(path))}</tspan>' if is_room else ""
    frame = f'x="{x - 0.5 * BOX:.0f}" y="{y - 0.5 * HEIGHT:.0f}" width="{BOX}" height="{HEIGHT}" rx="4"'
    return (
        f'<rect {frame} fill="{"#ffffff" if is_room else PAPER}" stroke="{INK}"/>'
        f'<text x="{x:.0f}" y="{y + 5:.0f}" font-size="14" text-anchor="middle" fill="{INK}">{name}{count}</text>'
    )


def _middle(stop: Stop) -> float:
    return STEP * (stop[0] + 0.5)


def tables() -> str:
    """Return the tables of the page."""
    drawn = graph()
    rooms = [f"| `{name}` | {_purpose_of(name)} | {_contents(name)} |" for name in drawn]
    imports = [f"| `{name}` | {_listed(sorted(found, key=layers().index))} |" for name, found in drawn.items() if found]
    flat = [f"| `{name}` | {_purpose_of(name)} |" for name in layers() if name not in drawn and name != "_kernels"]
    return "\n".join(
        [
            *("| room | what it does | its modules |", "|---|---|---|", *rooms, ""),
            *("What all rooms may use lies flat beside them, and imports none:", ""),
            *("| module | what it does |", "|---|---|", *flat, ""),
            *("What each room imports of the others, in full:", ""),
            *("| room | imports |", "|---|---|", *imports, ""),
        ]
    )


def every_module() -> list[Row]:
    """Return each module's path below the package and its purpose: by rooms, kernels after them, then the rest."""
    paths: list[Path] = []
    for name in [*graph(), *layers()]:
        room, kernels = PACKAGE / name, PACKAGE / "_kernels" / name
        paths += [room] if room.is_file() else [*modules(room), *modules(kernels)]
    return [(str(path.relative_to(PACKAGE)), purpose(path)) for path in dict.fromkeys(paths)]


def _purpose_of(name: str) -> str:
    path = PACKAGE / name
    return purpose(path / "__init__.py" if path.is_dir() else path)


def _contents(name: str) -> str:
    """Name the modules of a room, and its kernels."""
    folder, kernels = PACKAGE / name, PACKAGE / "_kernels" / name
    if not folder.is_dir():
        return "itself"
    held = _listed(str(path.relative_to(folder).with_suffix("")) for path in modules(folder))
    return held + (f"; kernels: {_listed(path.stem for path in modules(kernels))}" if kernels.is_dir() else "")


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def page(text: str) -> str:
    """Return the text of the page with the tables as they should be."""
    before, _, rest = text.partition(BEGIN)
    return f"{before}{BEGIN}\n{tables()}\n{END}{rest.partition(END)[2]}"


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text()))
    PICTURE.write_text(drawing())
    print(PAGE.relative_to(ROOT), PICTURE.relative_to(ROOT), sep="\n")
