"""A sweep that is stopped on the way."""

import stackbounce as sb
from stackbounce.sweeps import grid, write

DROP = sb.Drop(
    [sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53
)
OVER = ["balls.0.mass=50g:500g:30:log", "gaps.0=0mm:4mm:20"]
VALUES = grid(DROP, OVER)


class Stopped(Exception):
    pass


def write_some(out, values=VALUES, block=64):
    """Write one block, and stop; return how many drops were done before and after."""
    seen = []

    def progress(done, _):
        seen.append(done)
        if len(seen) == 2:
            raise Stopped

    try:
        write(out, DROP, values, block=block, progress=progress)
    except Stopped:
        return seen
    raise AssertionError(f"not stopped: {seen}")


def content(store):
    """Return the bytes of every file of a store, by its name."""
    files = [path for path in store.rglob("*") if path.is_file()]
    return {str(path.relative_to(store)): path.read_bytes() for path in files}
