"""What the programs share: their interface, and how one that cannot solve a problem says so."""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from typing import Any

Problem = dict[str, Any]
"""An entry of `benchmarks/impacts/problems.json`."""

Answer = dict[str, Any]
"""The fields that the problem asks for, as `benchmarks/impacts/README.md` describes them."""

Solve = Callable[[Problem], Answer]


class Unsupported(Exception):
    """A problem that the program is not meant for; the message says why."""


@dataclass(frozen=True)
class Peer:
    """A program: its name, the distribution that it needs, what it is meant for, and its settings.

    `prepare` imports what is needed and returns the function that solves a problem. That function
    raises `Unsupported` for a problem that is none for it.
    """

    name: str
    needs: str
    meant_for: str
    settings: str
    prepare: Callable[[], Solve]

    def version(self) -> str | None:
        """Return the version of what it needs; None if that is not installed."""
        try:
            return metadata.version(self.needs)
        except metadata.PackageNotFoundError:
            return None


def laws(problem: Problem) -> set[str]:
    """Return the names of the laws of a problem."""
    return {law["law"] for law in problem["contacts"] if law}


def require(problem: Problem, *known: str) -> None:
    """Raise `Unsupported` if a contact has another law than these."""
    if others := sorted(laws(problem) - set(known)):
        raise Unsupported(f"no contacts of {' or '.join(others)}")
