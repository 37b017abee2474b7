"""Our own entry: one sweep over all drops."""

from typing import Any

import stackbounce as sb
from benchmarks.peers.common import Answer, Peer
from benchmarks.random_drops import Drops


def prepare() -> Any:
    """Return the function that solves drops."""
    import xarray as xr

    base = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)

    def solve(drops: Drops) -> Answer:
        values = {
            "balls.1.mass": xr.DataArray(drops.masses[:, 1], dims="drop"),
            "contacts.1.stiffness": xr.DataArray(drops.stiffnesses[:, 1], dims="drop"),
            "gaps.0": xr.DataArray(drops.gaps, dims="drop"),
        }
        ds = sb.sweep(base, values)
        return ds.rebound_ratio.values, ds.collisions.values

    return solve


PEER = Peer("stackbounce", "stackbounce", "one sweep", prepare)
