"""Options of a command as controls of the page."""

from collections.abc import Callable, Sequence
from typing import Any

from viser import GuiApi

from .command import Option, given_words
from .session import Page

CHOSEN = "(default)"


class Controls:
    """Controls for some options of a command, in the folder that is open.

    Parameters
    ----------
    page : Page
    command : str
    labels : sequence of (flag, label)
        The options that are shown, in order.
    """

    def __init__(self, page: Page, command: str, labels: Sequence[tuple[str, str]]) -> None:
        found = [(page.commands.option(command, flag), label) for flag, label in labels]
        self._handles = {option: _control(page.server.gui, option, label) for option, label in found if option}

    @property
    def words(self) -> list[str]:
        """What stands on the command line for them."""
        return given_words({option: self._value(option) for option in self._handles})

    def value(self, flag: str) -> str:
        """Return the word of an option, empty if none is given."""
        option = next(option for option in self._handles if option.flag == flag)
        return str(self._value(option)).strip()

    def set(self, flag: str, word: str) -> None:
        """Give an option a word."""
        for option, handle in self._handles.items():
            if option.flag == flag:
                handle.value = word

    def on_change(self, tell: Callable[[], object]) -> None:
        """Call a function whenever a control changes."""
        for handle in self._handles.values():
            handle.on_update(lambda _: tell())

    def _value(self, option: Option) -> str | bool:
        value = self._handles[option].value
        return "" if value == CHOSEN else value


def _control(gui: GuiApi, option: Option, label: str) -> Any:
    if option.is_switch:
        return gui.add_checkbox(label, False, hint=option.help)
    if option.choices:
        words = option.choices if option.default else (CHOSEN, *option.choices)
        return gui.add_dropdown(label, words, initial_value=option.default or CHOSEN, hint=option.help)
    return gui.add_text(label, option.default, hint=option.help)
