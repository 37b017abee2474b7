"""Sweeps that are killed and resumed: `python -m adversary.kills --count 96`, in tests.

Each store ends byte for byte as one that was never disturbed.
"""

import signal
import sys
from pathlib import Path

from adversary.processes import KINDS, Forked, content, random_of, run, sweep, undisturbed
from adversary.table import Failure, begin

MOST = 3  # kills of one sweep


def attack(count: int, seed: int, folder: Path) -> list[Failure]:
    """Kill sweeps so many times in all, and resume them."""
    whole = {suffix: undisturbed(folder, suffix) for suffix in KINDS}
    failures, kills, index = [], 0, 0
    while kills < count:
        random, suffix = random_of(seed, index), KINDS[index % len(KINDS)]
        own = folder / str(index)
        own.mkdir()
        moments = random.uniform(0.0, 1.1 * whole[suffix].seconds, random.integers(1, MOST + 1))
        for moment in moments[: count - kills]:
            process = Forked(sweep(f"map{suffix}"), own, folder / "logs")
            process.send(signal.SIGKILL, moment)
            process.wait()
            kills += 1
        ended = run(sweep(f"map{suffix}"), own, folder / "logs")
        where = f"{index} ({suffix}, killed after {', '.join(f'{one:.3f} s' for one in moments)})"
        if ended.code or ended.err:
            failures.append(Failure("not resumed", f"{where}: {ended.err.strip()}"))
        elif content(own / f"map{suffix}") != whole[suffix].files:
            failures.append(Failure("another result", where))
        elif ended.out != whole[suffix].out:
            failures.append(Failure("another answer", where))
        elif [path.name for path in own.iterdir()] != [f"map{suffix}"]:
            left = sorted(path.name for path in own.iterdir())
            failures.append(Failure("junk left", f"{where}: {left}"))
        index += 1
    return failures


if __name__ == "__main__":
    sys.exit(begin("kills", attack, 96))
