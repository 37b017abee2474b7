"""Sweeps that are killed and resumed: `python -m adversary.kills --count 48`, in tests.

Each store ends byte for byte as one that was never disturbed.
"""

import contextlib
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from adversary.processes import STORE, Forked, content, run, sweep, undisturbed
from adversary.table import Case, begin, expect

MOST = 3  # kills of one sweep


@contextlib.contextmanager
def attack(folder: Path) -> Iterator[Case]:
    whole, logs = undisturbed(folder), folder / "logs"

    def case(_: int, random: np.random.Generator, own: Path) -> None:
        moments = random.uniform(0.0, 1.1 * whole.seconds, random.integers(1, MOST + 1))
        for moment in moments:
            process = Forked(sweep(STORE), own, logs)
            process.send(signal.SIGKILL, moment)
            process.wait()
        ended = run(sweep(STORE), own, logs)
        where = f"(killed after {', '.join(f'{one:.3f} s' for one in moments)})"
        expect(not ended.code and not ended.err, "not resumed", f"{where}: {ended.err}")
        expect(content(own / STORE) == whole.files, "another result", where)
        expect(ended.out == whole.out, "another answer", where)
        left = sorted(path.name for path in own.iterdir())
        expect(left == [STORE], "junk left", f"{where}: {left}")

    yield case


if __name__ == "__main__":
    sys.exit(begin("kills", attack, 48))
