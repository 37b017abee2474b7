"""Our own entry, by the public interface."""

import math
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Solve

RTOL = 1e-14  # the smallest that is allowed; springs, dashpots and rigid balls do not use it
WORDS = {"FINISHED": "parted", "COLLAPSED": "collapsed", "SETTLED": "settled"}


def prepare() -> Solve:
    """Return the function that solves a problem."""
    import stackbounce as sb

    def contact(law: dict[str, Any] | None) -> Any:
        return law and getattr(sb, law["law"])(**{k: v for k, v in law.items() if k != "law"})

    def solve(problem: Problem) -> Answer:
        drop = sb.Drop(
            [sb.Ball(mass) for mass in problem["masses"]],
            [contact(law) for law in problem["contacts"]],
            gaps=problem["gaps"],
            velocities=problem["velocities"],
            gravity=problem["gravity"],
        )
        result = sb.simulate(drop, until=problem["until"], rtol=RTOL)
        intervals = result.intervals
        strongest = [
            max(intervals["peak_force"][intervals["contact"] == i], default=None)
            for i in range(len(drop.balls))
        ]
        return {
            "velocities": result.rebound_speeds.tolist(),
            "counts": result.collisions.tolist(),
            "first_touch": _times(result.first_touch),
            "last_release": _times(result.last_release),
            "peak_force": [None if f is None else float(f) for f in strongest],
            "end": result.end_time,
            "status": WORDS.get(result.status.name, "stopped"),
        }

    return solve


def _times(values: Any) -> list[float | None]:
    return [t if math.isfinite(t) else None for t in values.tolist()]


PEER = Peer(
    "stackbounce",
    "stackbounce",
    "stacks of balls on any of these contacts",
    f"simulate, rtol {RTOL:g}",
    prepare,
)
