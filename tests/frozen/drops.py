"""The bits of random drops, compiled and in plain Python."""

from typing import Any

import numpy as np

import stackbounce as sb
from frozen.values import summary
from fuzz.draw import BALLS, RIGID_EVERY, drops_of
from fuzz.replay import drop_of, options_of

SEED = 2007
BATCHES = len(BALLS) * RIGID_EVERY  # after which every height was drawn, of both kinds
COUNT = 28  # drops of a batch
PLAIN = 80  # drops that are run in plain Python too: one of as many in even steps
_EVENTS = 100  # more are too many for plain Python


def answers() -> dict[str, Any]:
    """Return what came of each drop, and what the drop was.

    Returns
    -------
    dict of str to Any
        For each drop its status, velocities, collisions and end time, and a summary of all that is
        known of its contact intervals; `drawn` sums up the drops of a batch, which tells a change
        of the generator.
    """
    found: dict[str, Any] = {}
    every = BATCHES * COUNT // PLAIN
    for batch in range(BATCHES):
        drawn = drops_of(SEED, batch, COUNT)
        found[f"drawn/{batch}"] = {
            name: summary(np.ravel(values)) for name, values in drawn._asdict().items()
        }
        for row in range(COUNT):
            drop, options = drop_of(drawn, row), options_of(drawn, row)
            name = f"{batch}.{row}"
            result = sb.simulate(drop, **options, compiled=True)
            found[f"compiled/{name}"] = _told(result)
            turn = (batch * COUNT + row) % every == 0
            if turn and len(result.intervals) < _EVENTS and result.status.name != "EVENT_LIMIT":
                plain = sb.simulate(drop, **options, compiled=False)
                found[f"plain/{name}"] = _told(plain)
    return found


def _told(result: sb.Result) -> dict[str, Any]:
    """Return all that a result says, as numbers."""
    rows = result.intervals
    columns = [rows[name].astype(float) for name in rows.dtype.names]
    apexes = result.apexes
    columns += [apexes[name].astype(float) for name in apexes.dtype.names]
    return {
        "status": result.status.name,
        "velocities": result.rebound_speeds,
        "collisions": result.collisions,
        "end": result.end_time,
        "rows": len(rows),
        "intervals": summary(np.concatenate(columns)),
    }
