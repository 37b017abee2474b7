"""Two writers of one store, started together: `python -m adversary.pairs --count 600`, in tests.

A writer that succeeds leaves a whole store; one that is refused is told who writes since when.
"""

import contextlib
import re
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from adversary.processes import STORE, Forked, content, sweep, undisturbed
from adversary.table import Case, begin, expect

MASSES = (30, 29)  # of a sweep, and of another one for the same store
_TOLD = re.compile(
    r"map\.\w+ is being written by process \d+ on \S+ since \d{4}-\d\d-\d\d \S+: wait until"
)
_ANOTHER = re.compile(r"map\.\w+ exists, and is not this sweep")


@contextlib.contextmanager
def attack(folder: Path) -> Iterator[Case]:
    """Start a pair; in every fourth the second writer has another sweep."""
    whole = {masses: undisturbed(folder, masses) for masses in MASSES}

    def case(index: int, random: np.random.Generator, own: Path) -> None:
        both = [MASSES[0], MASSES[index % 4 == 0]]
        delay = random.uniform(0.0, 1.2 * whole[MASSES[0]].seconds)
        writers = []
        for masses, wait in zip(both, (0.0, delay * random.integers(2)), strict=True):
            time.sleep(wait)
            writers.append(Forked(sweep(STORE, masses), own, folder / "logs"))
        ends = [writer.wait() for writer in writers]
        said = " / ".join(f"{end.code} {end.err.strip()}" for end in ends)
        expect(not any(end.inner for end in ends), "inner error", said)
        done = [whole[masses] for end, masses in zip(ends, both, strict=True) if end.code == 0]
        expect(bool(done), "no success", said)
        store = content(own / STORE)
        expect(all(store == one.files for one in done), "success with a damaged store", said)
        for end in ends:
            told = _TOLD.search(end.err) or (_ANOTHER.search(end.err) and both[0] != both[1])
            expect(not end.code or bool(end.refused and told), "not told who writes", said)
        expect([path.name for path in own.iterdir()] == [STORE], "junk left", said)

    yield case


if __name__ == "__main__":
    sys.exit(begin("pairs", attack, 600))
