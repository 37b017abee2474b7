"""What random drops do, compiled and in plain Python."""

from collections.abc import Iterator

import numpy as np

import stackbounce as sb
from frozen.lines import digest
from fuzz.draw import BALLS, RIGID_EVERY, drops_of
from fuzz.replay import drop_of, options_of

SEED = 2007
BATCHES = len(BALLS) * RIGID_EVERY  # after which every height was drawn, of both kinds
COUNT = 28  # drops of a batch
PLAIN = 80  # drops that are run in plain Python too: one of as many in even steps
_EVENTS = 100  # more are too many for plain Python


def answers() -> Iterator[str]:
    """Yield a line for each drop; ``drawn`` has the numbers of a batch, from the generator."""
    every = BATCHES * COUNT // PLAIN
    for batch in range(BATCHES):
        drawn = drops_of(SEED, batch, COUNT)
        for name, values in drawn._asdict().items():
            yield f"drawn/{batch}/{name} = {digest(np.asarray(values))}"
        for row in range(COUNT):
            drop, options = drop_of(drawn, row), options_of(drawn, row)
            result = sb.simulate(drop, **options, compiled=True)
            yield f"compiled/{batch}.{row} = {_outcome(result)}"
            turn = (batch * COUNT + row) % every == 0
            if turn and len(result.intervals) < _EVENTS and result.status.name != "EVENT_LIMIT":
                plain = sb.simulate(drop, **options, compiled=False)
                yield f"plain/{batch}.{row} = {_outcome(plain)}"


def _outcome(result: sb.Result) -> str:
    """Return all that is known of a run, its contact intervals and apexes as a digest."""
    tables = (result.intervals, result.apexes)
    columns = [rows[name].astype(float) for rows in tables for name in rows.dtype.names]
    known = (
        result.status.name,
        result.rebound_speeds.tolist(),
        result.collisions.tolist(),
        result.end_time,
        len(result.intervals),
        digest(np.concatenate(columns)),
    )
    return " ".join(map(str, known))
