"""What came of many batches, counted."""

import collections
import dataclasses

import numpy as np

import stackbounce as sb
from fuzz import compare, drive
from fuzz.batch import Batch, run_batch
from fuzz.draw import BATCH, is_rigid
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
    compared: collections.Counter[tuple[str, str]] = dataclasses.field(
        default_factory=collections.Counter
    )
    violations: list[tuple[str, str]] = dataclasses.field(default_factory=list)

    def add(self, other: "Tally") -> None:
        """Add another tally's counts."""
        self.drops += other.drops
        self.seconds += other.seconds
        self.statuses += other.statuses
        self.compared += other.compared
        self.violations += other.violations

    def report(self) -> str:
        """Return all counts as a text for people."""
        counts = collections.Counter(name for name, _ in self.violations)
        lines = [f"{self.drops} drops, {self.seconds / max(self.drops, 1) * 1e3:.3f} ms each", ""]
        for (kind, balls, status), count in sorted(self.statuses.items()):
            lines.append(f"{kind:9}{balls:4d}{count:9d}  {status}")
        for (way, same), count in sorted(self.compared.items()):
            lines.append(f"{way}: {count} {same}")
        lines += ["", "violations:"]
        for name in (*drive.FAULTS.values(), PLAIN, OTHER):
            lines.append(f"  {counts[name]:7d}  {name}")
        return "\n".join(lines)


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
    tally = Tally(drops=count, seconds=batch.seconds)
    family = "rigid" if is_rigid(index) else "finite", batch.drops.mass.shape[1]
    for row, found in enumerate(batch.found):
        status = sb.Status(int(found[drive.STATUS])).name
        if status == "EVENT_LIMIT" and found[drive.EVENT_COUNT] < batch.drops.limit[row]:
            status = _STEPS
        tally.statuses[(*family, status)] += 1
        for fault, name in drive.FAULTS.items():
            if int(found[drive.FAULT]) & fault:
                _note(tally, name, batch, row)
    ways = [(PLAIN, plain, compare.can_be_compared_plainly, compare.plainly)]
    if not is_rigid(index):
        ways.append((OTHER, other, compare.can_be_integrated, compare.otherwise))
    for way, most, possible, compared in ways:
        rows = [row for row in range(count) if possible(batch, row)]
        for row in rows[:most]:
            same = compared(batch, row)
            tally.compared[way, same] += 1
            if same == compare.DIFFERENT:
                _note(tally, way, batch, row)
    return tally


def _note(tally: Tally, name: str, batch: Batch, row: int) -> None:
    numbers = np.array2string(batch.found[row, : drive.COLUMNS], max_line_width=200)
    text = f"# {name}: batch {batch.index}, row {row}, {numbers}\n{expression(batch.drops, row)}\n"
    tally.violations.append((name, text))
