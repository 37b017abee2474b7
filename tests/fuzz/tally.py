"""What came of many batches, counted."""

import collections
import dataclasses
import itertools

import numpy as np

import stackbounce as sb
from fuzz import compare, drive
from fuzz.batch import Batch, run_batch
from fuzz.draw import BALLS, BATCH, RIGID_EVERY, TOLERANCE_ODDS, TOLERANCES, is_rigid
from fuzz.replay import expression

PLAIN, OTHER = "compiled and plain", "another method"
_STEPS = "STEP LIMIT"  # between two events, of as many


@dataclasses.dataclass
class Tally:
    """Counts, and the drops in which something is wrong."""

    drops: int = 0
    seconds: float = 0.0
    statuses: collections.Counter[tuple[str, int, str]] = dataclasses.field(
        default_factory=collections.Counter
    )
    times: collections.Counter[tuple[str, int]] = dataclasses.field(
        default_factory=collections.Counter
    )
    compared: collections.Counter[tuple[str, str]] = dataclasses.field(
        default_factory=collections.Counter
    )
    violations: list[tuple[str, str]] = dataclasses.field(default_factory=list)
    slowest: tuple[float, int] = (0.0, -1)

    def add(self, other: "Tally") -> None:
        """Add another tally's counts."""
        self.drops += other.drops
        self.seconds += other.seconds
        self.statuses += other.statuses
        self.times += other.times
        self.compared += other.compared
        self.violations += other.violations
        self.slowest = max(self.slowest, other.slowest)

    def report(self) -> str:
        """Return all counts as a text for people."""
        counts = collections.Counter(name for name, _ in self.violations)
        lines = [f"{self.drops} drops, {self.seconds / max(self.drops, 1) * 1e3:.3f} ms each"]
        lines += ["", mix(), "", *self._families(), ""]
        for name in (PLAIN, OTHER):
            parts = [f"{n} {kind}" for (which, kind), n in self.compared.items() if which == name]
            lines.append(f"{name}: {', '.join(sorted(parts)) or 'none compared'}")
        lines += ["", "violations:"]
        for name in (*drive.FAULTS.values(), PLAIN, OTHER):
            lines.append(f"  {counts[name]:7d}  {name}")
        lines.append(f"slowest batch: {self.slowest[1]}, {self.slowest[0]:.1f} s")
        return "\n".join(lines)

    def _families(self) -> list[str]:
        names = [status.name for status in sb.Status] + [_STEPS]
        lines = ["        balls   drops  ms each" + "".join(f"{name:>13}" for name in names)]
        for kind, balls in itertools.product(("finite", "rigid"), sorted(set(BALLS))):
            row = [self.statuses[kind, balls, name] for name in names]
            if sum(row) > 0:
                each = self.times[kind, balls] / sum(row) * 1e3
                counts = "".join(f"{count:13d}" for count in row)
                lines.append(f"{kind:9}{balls:4d}{sum(row):8d}{each:9.3f}{counts}")
        return lines


def mix() -> str:
    """Return in words how often what is drawn."""
    balls = ", ".join(f"{BALLS.count(n) / len(BALLS):.0%} of {n}" for n in sorted(set(BALLS)))
    tolerances = zip(TOLERANCES, TOLERANCE_ODDS, strict=True)
    odds = ", ".join(f"{share:.0%} {rtol:g}" for rtol, share in tolerances)
    return f"balls: {balls}\none in {RIGID_EVERY} rigid\nrtol of the others: {odds}"


def tally_of(
    seed: int,
    index: int,
    count: int = BATCH,
    plain: int = 0,
    other: int = 0,
    *,
    compiled: bool = True,
) -> Tally:
    """Run a batch, and compare some of its drops with plain Python and with another method."""
    batch = run_batch(seed, index, count, compiled=compiled)
    tally = Tally(drops=count, seconds=batch.seconds, slowest=(batch.seconds, index))
    family = "rigid" if is_rigid(index) else "finite", batch.drops.mass.shape[1]
    tally.times[family] += batch.seconds
    for row, found in enumerate(batch.found):
        status = sb.Status(int(found[drive.STATUS])).name
        if status == "EVENT_LIMIT" and found[drive.EVENT_COUNT] < batch.drops.limit[row]:
            status = _STEPS
        tally.statuses[(*family, status)] += 1
        for fault, name in drive.FAULTS.items():
            if int(found[drive.FAULT]) & fault:
                _note(tally, name, batch, row)
    rows = [row for row in range(count) if compare.can_be_compared_plainly(batch, row)]
    for row in rows[:plain]:
        same = compare.plainly(batch, row)
        tally.compared[PLAIN, same] += 1
        if same == compare.DIFFERENT:
            _note(tally, PLAIN, batch, row)
    if not is_rigid(index):
        rows = [row for row in range(count) if compare.can_be_integrated(batch, row)]
        for row in rows[:other]:
            same = compare.otherwise(batch, row)
            tally.compared[OTHER, same] += 1
            if same == compare.DIFFERENT:
                _note(tally, OTHER, batch, row)
    return tally


def _note(tally: Tally, name: str, batch: Batch, row: int) -> None:
    numbers = np.array2string(batch.found[row, : drive.COLUMNS], max_line_width=200)
    text = f"# {name}: batch {batch.index}, row {row}, {numbers}\n{expression(batch.drops, row)}\n"
    tally.violations.append((name, text))
