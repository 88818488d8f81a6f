"""Directives that list what the package has, so that no page holds a copy: commands, public names, modules."""

import inspect
import runpy
from importlib import import_module
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from typer.main import get_command
from typer.testing import CliRunner

import pointchart
from pointchart.cli import app as command_line

WIDTH = 84
FENCE = 8 * "`"


def help_of(name: str) -> str:
    """Return what a command prints for ``--help``."""
    return CliRunner().invoke(command_line, [name, "--help"], prog_name="pointchart", terminal_width=WIDTH).stdout


class Commands(Directive):
    """A section for each command with its help."""

    def run(self) -> list[nodes.Node]:
        """Ask the program itself, each time."""
        self.state.document.settings.env.note_reread()
        sections = []
        for name in get_command(command_line).commands:
            section = nodes.section(ids=[f"pointchart-{name}"], names=[f"pointchart {name}"])
            section += nodes.title("", "", nodes.literal("", f"pointchart {name}"))
            text = help_of(name)
            section += nodes.literal_block(text, text, language="text")
            sections.append(section)
        return sections


class Summary(Directive):
    """A table of names with the first line of their docstrings, each a link."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        """Write the directive of autosummary and have it parsed."""
        return parsed(self, table(" ".join(self.content).split()))


class Names(Directive):
    """The public names of a module, or those given: a table of all, then each with its docstring."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Write the directives of autodoc and have them parsed."""
        module = self.arguments[0]
        names = " ".join(self.content).split() or import_module(module).__all__
        paths = [path_of(module, name) for name in names]
        lines = table(paths)
        for name, path in zip(names, paths, strict=True):
            thing = getattr(import_module(module), name)
            lines += [f".. auto{_kind(thing)}:: {path}", "   :members:" if inspect.isclass(thing) else "", ""]
        return parsed(self, lines)


class Modules(Directive):
    """A table of the modules of each room, with the first line of their docstrings."""

    def run(self) -> list[nodes.Node]:
        """Read the files, each time."""
        self.state.document.settings.env.note_reread()
        listed = runpy.run_path(str(Path(__file__).parents[1] / "rooms.py"))["every_module"]()
        lines = [".. list-table::", "   :widths: 40 60", ""]
        for path, purpose in listed:
            words = purpose.replace("``", "`").replace("`", "``")
            lines += [f"   * - ``{path}``", f"     - {words}"]
        return parsed(self, [*lines, ""])


def table(paths: list[str]) -> list[str]:
    """Return the lines of a table of names."""
    return [".. autosummary::", "   :nosignatures:", "", *(f"   ~{path}" for path in paths), ""]


def path_of(module: str, name: str) -> str:
    """Return the shortest path of a name: that of the package, if it is public there."""
    is_public = getattr(pointchart, name, None) is getattr(import_module(module), name)
    return f"pointchart.{name}" if is_public else f"{module}.{name}"


def parsed(directive: Directive, lines: list[str]) -> list[nodes.Node]:
    """Have lines of reStructuredText parsed on a page of MyST."""
    section = nodes.section()
    section.document = directive.state.document
    fenced = StringList([f"{FENCE}{{eval-rst}}", *lines, FENCE], source="listings")
    directive.state.nested_parse(fenced, directive.content_offset, section)
    return section.children


def _kind(thing: object) -> str:
    if inspect.isclass(thing):
        return "exception" if issubclass(thing, Exception) else "class"
    return "function" if callable(thing) else "data"


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the directives."""
    app.add_directive("commands", Commands)
    app.add_directive("modules", Modules)
    app.add_directive("names", Names)
    app.add_directive("summary", Summary)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
