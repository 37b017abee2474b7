"""What came of many batches, counted."""

import collections
import dataclasses

import stackbounce as sb
from fuzz import compare
from fuzz.check import FAULTS, faults_of
from fuzz.draw import BATCH, drops_of, is_rigid
from fuzz.replay import drop_of, expression, options_of

PLAIN, OTHER = "compiled and plain", "another method"
_STEPS = "STEP LIMIT"  # between two events, of as many


@dataclasses.dataclass
class Tally:
    """Counts, and the drops in which something is wrong."""

    drops: int = 0
    statuses: collections.Counter[tuple[str, int, str]] = dataclasses.field(
        default_factory=collections.Counter
    )
    compared: collections.Counter[tuple[str, str]] = dataclasses.field(
        default_factory=collections.Counter
    )
    violations: list[tuple[str, str]] = dataclasses.field(default_factory=list)

    def add(self, other: "Tally") -> None:
        self.drops += other.drops
        self.statuses += other.statuses
        self.compared += other.compared
        self.violations += other.violations

    def report(self) -> str:
        counts = collections.Counter(name for name, _ in self.violations)
        lines = [f"{self.drops} drops", ""]
        for (kind, balls, status), count in sorted(self.statuses.items()):
            lines.append(f"{kind:9}{balls:4d}{count:9d}  {status}")
        for (way, same), count in sorted(self.compared.items()):
            lines.append(f"{way}: {count} {same}")
        lines += ["", "violations:"]
        for name in (*FAULTS, PLAIN, OTHER):
            lines.append(f"  {counts[name]:7d}  {name}")
        return "\n".join(lines)


def tally_of(seed: int, index: int, count: int = BATCH, plain: int = 0, other: int = 0) -> Tally:
    """Run a batch, and compare some of its drops with plain Python and with another method."""
    drops, tally = drops_of(seed, index, count), Tally(drops=count)
    family = "rigid" if is_rigid(index) else "finite", drops.mass.shape[1]
    left = {PLAIN: plain, OTHER: 0 if is_rigid(index) else other}
    ways = {
        PLAIN: (compare.can_be_compared_plainly, compare.plainly),
        OTHER: (compare.can_be_integrated, compare.otherwise),
    }
    for row in range(count):
        options = options_of(drops, row)
        result = sb.simulate(drop_of(drops, row), **options)
        status = result.status.name
        if status == "EVENT_LIMIT" and len(result.events) < options["event_limit"]:
            status = _STEPS
        tally.statuses[(*family, status)] += 1
        wrong = faults_of(result, drops.stops[row])
        for way, (possible, compared) in ways.items():
            if left[way] and possible(result):
                left[way] -= 1
                same = compared(result, options)
                tally.compared[way, same] += 1
                wrong += [way] if same == compare.DIFFERENT else []
        for name in wrong:
            text = f"# {name}: batch {index}, row {row}\n{expression(drops, row)}\n"
            tally.violations.append((name, text))
    return tally
