"""Sweeps that are killed and resumed: `python -m adversary.kills --count 96`, in tests.

Each store ends byte for byte as one that was never disturbed.
"""

import signal
import sys
from pathlib import Path

from adversary.processes import STORE, Forked, content, random_of, run, sweep, undisturbed
from adversary.table import Failure, begin

MOST = 3  # kills of one sweep


def attack(count: int, seed: int, folder: Path) -> list[Failure]:
    """Kill sweeps so many times in all, and resume them."""
    whole = undisturbed(folder)
    failures, kills, index = [], 0, 0
    while kills < count:
        random = random_of(seed, index)
        own = folder / str(index)
        own.mkdir()
        moments = random.uniform(0.0, 1.1 * whole.seconds, random.integers(1, MOST + 1))
        for moment in moments[: count - kills]:
            process = Forked(sweep(STORE), own, folder / "logs")
            process.send(signal.SIGKILL, moment)
            process.wait()
            kills += 1
        ended = run(sweep(STORE), own, folder / "logs")
        where = f"{index} (killed after {', '.join(f'{one:.3f} s' for one in moments)})"
        if ended.code or ended.err:
            failures.append(Failure("not resumed", f"{where}: {ended.err.strip()}"))
        elif content(own / STORE) != whole.files:
            failures.append(Failure("another result", where))
        elif ended.out != whole.out:
            failures.append(Failure("another answer", where))
        elif [path.name for path in own.iterdir()] != [STORE]:
            left = sorted(path.name for path in own.iterdir())
            failures.append(Failure("junk left", f"{where}: {left}"))
        index += 1
    return failures


if __name__ == "__main__":
    sys.exit(begin("kills", attack, 96))
