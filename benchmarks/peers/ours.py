"""Our own entry: one `simulate` per drop, compiled."""

from typing import Any

import numpy as np

from benchmarks.peers.common import Answer, Peer
from benchmarks.random_drops import Drops, simulated


def prepare() -> Any:
    """Return the function that solves drops."""

    def solve(drops: Drops) -> Answer:
        results = [simulated(row) for row in drops.ratios.tolist()]
        return (
            np.array([result.rebound_speeds for result in results]),
            np.array([result.collisions for result in results]),
        )

    return solve


PEER = Peer("stackbounce", "stackbounce", "simulate, compiled, a Python call per drop", prepare)
