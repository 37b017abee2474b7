"""The groups of answers: what computes each, how it is compared, and whether it is quick."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from frozen import store
from frozen.compare import Difference, differences
from frozen.values import flat


class Group(NamedTuple):
    """Where answers come from and how they are compared."""

    source: str  # module and function
    bits: bool = False  # `python -m frozen` compares all bits; another processor may differ there
    quick: bool = True  # a test computes it; the others take ``python -m frozen``


GROUPS = {
    "audit": Group("audit.answers", quick=False),
    "commands": Group("commands.numbers"),
    "comparisons": Group("commands.comparisons", quick=False),
    "tables": Group("commands.texts", quick=False),
    "messages": Group("messages.answers"),
    "fuzz": Group("drops.answers", bits=True),
    "laws": Group("laws.answers", bits=True),
    "web": Group("explorer.answers"),
    "coverage": Group("coverage.answers", quick=False),
}
"""By the names that ``python -m frozen`` takes."""


def computed(name: str) -> dict[str, Any]:
    """Return the answers of a group, as a flat table."""
    module, _, function = GROUPS[name].source.partition(".")
    answers: Callable[[], Any] = getattr(import_module(f"frozen.{module}"), function)
    return store.as_stored(flat(answers()))


def changed(name: str, now: dict[str, Any], exact: bool = False) -> list[Difference]:
    """Return where a group's answers are not what was kept."""
    return differences(store.kept(name), now, exact)
