"""The row of a table that each attack prints, and its command line."""

import argparse
import collections
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

SHOWN = 5  # failures of a kind


class Failure(NamedTuple):
    """What was wrong with one case: the kind of failure, and all that is needed to find it."""

    kind: str
    case: str


class NotPermitted(Exception):
    """The system does not allow an attack; its message says why."""


Attack = Callable[[int, int, Path], list[Failure]]
"""From a count, a seed and an empty folder to all failures."""


def row(name: str, count: int, failures: list[Failure]) -> str:
    """Return a row of the table: the attack, how often, and how many failures of each kind."""
    kinds = collections.Counter(failure.kind for failure in failures)
    found = ", ".join(f"{number} {kind}" for kind, number in kinds.most_common())
    return f"| {name} | {count} | {found or '0'} |\n"


def begin(name: str, attack: Attack, count: int) -> int:
    """Attack as the command line asks; print a row; return 1 after a failure."""
    parser = argparse.ArgumentParser(prog=f"python -m adversary.{name}")
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory(prefix=f"{name}-") as folder:
            failures = attack(asked.count, asked.seed, Path(folder))
    except NotPermitted as reason:
        sys.stdout.write(f"| {name} | skipped | {reason} |\n")
        return 0
    sys.stdout.write(row(name, asked.count, failures))
    for kind in dict.fromkeys(failure.kind for failure in failures):
        cases = [failure.case for failure in failures if failure.kind == kind]
        sys.stderr.writelines(f"{kind}: {case}\n" for case in cases[:SHOWN])
    return int(bool(failures))
