"""Run random drops and report: `python -m fuzz --drops 1000000 --seed 1 --workers 2`, in tests."""

import argparse
import multiprocessing
import os
import signal
import sys
import time
from pathlib import Path

from fuzz.draw import BATCH, RIGID_EVERY
from fuzz.tally import Tally, tally_of

VIOLATIONS = Path(__file__).parents[2] / "build" / "fuzz" / "violations.txt"
_SHOWN = 10
_Task = tuple[int, int, int, int]


def tasks(seed: int, batches: int, plain: int, other: int) -> list[_Task]:
    """Return seed and number of each batch, and how many of its drops to compare in two ways."""
    finite = [index for index in range(batches) if index % RIGID_EVERY != RIGID_EVERY - 1]
    of_others = dict(zip(finite, _shares(other, len(finite)), strict=True))
    return [
        (seed, index, share, of_others.get(index, 0))
        for index, share in enumerate(_shares(plain, batches))
    ]


def _shares(total: int, parts: int) -> list[int]:
    return [total * (k + 1) // parts - total * k // parts for k in range(parts)]


def _work(task: _Task) -> Tally:
    seed, index, plain, other = task
    return tally_of(seed, index, BATCH, plain, other)


def _ignore_interrupts() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def run(todo: list[_Task], workers: int) -> Tally:
    """Run batches, or those before an interrupt; return what came of them."""
    total, begun = Tally(), time.monotonic()
    with multiprocessing.Pool(workers, _ignore_interrupts) as pool:
        try:
            for tally in pool.imap(_work, todo):
                total.add(tally)
                passed = time.monotonic() - begun
                line = f"{total.drops} drops, {len(total.violations)} violations, {passed:.0f} s"
                sys.stderr.write(f"\r{line} ")
                sys.stderr.flush()
        except KeyboardInterrupt:
            pool.terminate()
        finally:
            sys.stderr.write("\n")
    return total


def main() -> int:
    """Run what the command line asks for; return 1 if a drop violates anything, 130 if stopped."""
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__)
    parser.add_argument("--drops", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--plain", type=int, default=3000, help="drops to run as plain Python too")
    parser.add_argument("--other", type=int, default=1000, help="drops to run another way too")
    asked = parser.parse_args()
    begun = time.monotonic()
    todo = tasks(asked.seed, -(-asked.drops // BATCH), asked.plain, asked.other)
    total = run(todo, asked.workers)
    passed = time.monotonic() - begun
    VIOLATIONS.parent.mkdir(parents=True, exist_ok=True)
    VIOLATIONS.write_text("\n".join(text for _, text in total.violations), encoding="utf-8")
    sys.stdout.write(total.report())
    sys.stdout.write(f"\nseed {asked.seed}, {asked.workers} workers, {passed:.0f} s\n\n")
    for _, text in total.violations[:_SHOWN]:
        sys.stdout.write(f"{text}\n")
    if len(total.violations) > _SHOWN:
        sys.stdout.write(f"All {len(total.violations)}: {VIOLATIONS}\n")
    if total.drops < BATCH * len(todo):
        sys.stdout.write(f"Stopped before the end, after {total.drops} drops.\n")
        return 1 if total.violations else 130
    return int(bool(total.violations))


if __name__ == "__main__":
    sys.exit(main())
