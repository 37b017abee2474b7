"""The row of a table that each attack prints, and its command line."""

import argparse
import collections
import shutil
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

import numpy as np

SHOWN = 5  # failures of a kind


class Failure(Exception):
    """What is wrong with a case: the kind of failure, and what was said."""

    def __init__(self, kind: str, said: str = "") -> None:
        super().__init__(kind, said)
        self.kind, self.said = kind, said


class NotPermitted(Exception):
    """The system does not allow an attack; its message says why."""


Case = Callable[[int, np.random.Generator, Path], None]
"""Attacks once: from a number, random numbers and an empty folder to a `Failure` or nothing."""


def expect(fine: bool, kind: str, said: str = "") -> None:
    if not fine:
        raise Failure(kind, said.strip())


def row(name: str, count: int, kinds: Sequence[str]) -> str:
    """Return a row of the table: the attack, how often, and how many failures of each kind."""
    counted = collections.Counter(kinds).most_common()
    found = ", ".join(f"{number} {kind}" for kind, number in counted)
    return f"| {name} | {count} | {found or '0'} |\n"


def begin(name: str, attack: Callable[[Path], AbstractContextManager[Case]], count: int) -> int:
    """Attack as the command line asks; print a row; return 1 after a failure."""
    parser = argparse.ArgumentParser(prog=f"python -m adversary.{name}")
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    kinds: list[str] = []
    with tempfile.TemporaryDirectory(prefix=f"{name}-") as made:
        folder = Path(made)
        try:
            with attack(folder) as case:
                for index in range(asked.count):
                    own = folder / str(index)
                    own.mkdir()
                    try:
                        case(index, np.random.default_rng([asked.seed, index]), own)
                    except Failure as failure:
                        kinds.append(failure.kind)
                        if kinds.count(failure.kind) <= SHOWN:
                            sys.stderr.write(f"{failure.kind}: {index} {failure.said}\n")
                    shutil.rmtree(own)
        except NotPermitted as reason:
            sys.stdout.write(f"| {name} | skipped | {reason} |\n")
            return 0
    sys.stdout.write(row(name, asked.count, kinds))
    return int(bool(kinds))
