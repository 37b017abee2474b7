"""Changed files of measurements: `python -m adversary.measurements --count 20000`, in tests.

Each ends in results or in one line, within 10 s and 1 GB. `fuzz.files` changes and measures them;
what goes wrong is kept in build/fuzz.
"""

import sys
from pathlib import Path

from adversary.table import Failure, begin
from fuzz.files import keep, run
from fuzz.mutate import minimal_cases


def attack(count: int, seed: int, _: Path) -> list[Failure]:
    """Measure so many files."""
    sources = minimal_cases()
    cases = [case for case in run(sources, seed, count) if case.wrong]
    return [
        Failure(
            case.wrong.partition(":")[0],
            f"{keep(case, sources, seed)} {' '.join(case.options)}: {case.wrong}",
        )
        for case in cases
    ]


if __name__ == "__main__":
    sys.exit(begin("measurements", attack, 20_000))
