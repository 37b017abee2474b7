"""Two writers of one store, started together: `python -m adversary.pairs --count 600`, in tests.

A writer that succeeds leaves a whole store; one that is refused is told who writes since when.
"""

import re
import sys
import time
from pathlib import Path

from adversary.processes import (
    STORE,
    Ended,
    Forked,
    Undisturbed,
    content,
    random_of,
    sweep,
    undisturbed,
)
from adversary.table import Failure, begin

MASSES = (30, 29)  # of a sweep, and of another one for the same store
_TOLD = re.compile(
    r"map\.\w+ is being written by process \d+ on \S+ since \d{4}-\d\d-\d\d \S+: wait until"
)
_ANOTHER = re.compile(r"map\.\w+ exists, and is not this sweep")


def attack(count: int, seed: int, folder: Path) -> list[Failure]:
    """Start so many pairs; in every fourth the second writer has another sweep."""
    whole = {masses: undisturbed(folder, masses) for masses in MASSES}
    failures = []
    for index in range(count):
        random, both = random_of(seed, index), [MASSES[0], MASSES[index % 4 == 0]]
        own = folder / str(index)
        own.mkdir()
        delay = random.uniform(0.0, 1.2 * whole[MASSES[0]].seconds)
        writers = []
        for masses, wait in zip(both, (0.0, delay * random.integers(2)), strict=True):
            time.sleep(wait)
            writers.append(Forked(sweep(STORE, masses), own, folder / "logs"))
        ends = [writer.wait() for writer in writers]
        wrong = _wrong(own, ends, [whole[masses] for masses in both])
        if wrong:
            said = " / ".join(f"{end.code} {end.err.strip()}" for end in ends)
            failures.append(Failure(wrong, f"{index}: {said}"))
    return failures


def _wrong(own: Path, ends: list[Ended], wholes: list[Undisturbed]) -> str:
    """Return what is wrong with the ends of both writers, and with what they left."""
    if any(end.inner for end in ends):
        return "inner error"
    done = [whole for end, whole in zip(ends, wholes, strict=True) if end.code == 0]
    if not done:
        return "no success"
    store = content(own / STORE)
    if any(store != whole.files for whole in done):
        return "success with a damaged store"
    same = wholes[0] is wholes[1]
    for end in ends:
        told = _TOLD.search(end.err) or (_ANOTHER.search(end.err) and not same)
        if end.code and not (end.refused and told):
            return "not told who writes"
    return "junk left" if [path.name for path in own.iterdir()] != [STORE] else ""


if __name__ == "__main__":
    sys.exit(begin("pairs", attack, 600))
