"""Options of a run as controls of the page."""

from collections.abc import Callable, Sequence
from typing import Any

from viser import GuiApi

from ..errors import InputError
from ..runs.options import Option, options_of

CHOSEN = "(default)"  # for options that need no word; brackets, so that it is no word of any
KINDS = {int: "a whole number", float: "a number"}  # what a word has to be, by the kind of its option


class Controls:
    """Controls for some options of a run, in the folder that is open.

    Parameters
    ----------
    gui : GuiApi
    record : type
        Of the run.
    labels : sequence of (name, label)
        The options that are shown, in order.
    """

    def __init__(self, gui: GuiApi, record: type, labels: Sequence[tuple[str, str]]) -> None:
        options = {option.name: option for option in options_of(record)}
        self._options = [options[name] for name, _ in labels]
        self._handles = {name: _control(gui, options[name], label) for name, label in labels}

    @property
    def values(self) -> dict[str, Any]:
        """What is chosen, by the names of the options; those left to their defaults are not there.

        Raises
        ------
        InputError
            If a word is no value of its option.
        """
        words = {option: self._handles[option.name].value for option in self._options}
        return {option.name: read_value(option, word) for option, word in words.items() if _is_given(option, word)}

    def set(self, name: str, word: str) -> None:
        """Give an option a word."""
        self._handles[name].value = word

    def on_change(self, tell: Callable[[], object]) -> None:
        """Call a function whenever a control changes."""
        for handle in self._handles.values():
            handle.on_update(lambda _: tell())


def read_value(option: Option, word: str | bool) -> Any:
    """Return the value of an option that a word stands for.

    Raises
    ------
    InputError
        If it stands for none.

    Examples
    --------
    >>> from pointchart.runs.param_run import ParamRun
    >>> k, domain = (next(o for o in options_of(ParamRun) if o.name == name) for name in ("k", "domain"))
    >>> read_value(k, " 12 "), read_value(domain, "square").name
    (12, 'square')
    """
    if isinstance(word, bool):
        return word
    try:
        value = option.kind(word.strip())
    except ValueError:
        raise InputError(f"{option.flags[0]} is '{word}'; {KINDS[option.kind]} is needed") from None
    least, most = option.least, option.most
    if (least is not None and value < least) or (most is not None and value > most):
        ends = f"at least {least:g}" if most is None else f"from {least or 0:g} to {most:g}"
        raise InputError(f"{option.flags[0]} is {value}; it has to be {ends}")
    return value


def _is_given(option: Option, word: str | bool) -> bool:
    if isinstance(word, bool):
        return bool(word != option.default)
    return word.strip() not in ("", CHOSEN, _word(option.default))


def _word(default: Any) -> str:
    return "" if default is None else str(default)


def _control(gui: GuiApi, option: Option, label: str) -> Any:
    if option.is_switch:
        return gui.add_checkbox(label, bool(option.default), hint=option.help)
    word = _word(option.default)
    if option.choices:
        words = option.choices if word else (CHOSEN, *option.choices)
        return gui.add_dropdown(label, words, initial_value=word or CHOSEN, hint=option.help)
    return gui.add_text(label, word, hint=option.help)
