"""Objects that decorate functions: told of, pickled and wrapped as functions are."""

import sys
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

Rule = TypeVar("Rule")


def present_as(rule: object, function: Callable[..., Any]) -> None:
    """Give a rule the name, the module and the words of the function that it decorates."""
    name = getattr(function, "__name__", type(rule).__name__)
    module = getattr(function, "__module__", type(rule).__module__)
    vars(rule).update(__doc__=function.__doc__, __name__=name, __module__=module, __wrapped__=function)


def name_in_module(rule: object) -> str | None:
    """Return the name by which the module of a rule has it; None if it has it by none."""
    name = str(vars(rule)["__name__"])
    return name if getattr(sys.modules.get(rule.__module__), name, None) is rule else None


def rule_within(given: object, kind: type[Rule]) -> Rule | None:
    """Return the rule of a kind that something is, or that it wraps by `functools`; None if there is none.

    >>> rule_within(partial(partial(len)), type(len)) is len
    True
    """
    while given is not None and not isinstance(given, kind):
        given = given.func if isinstance(given, partial) else getattr(given, "__wrapped__", None)
    return given
