"""Write `tests/data/gentle.json` from `precise`: contacts that begin and end gently.

Run it in `tests` as `python -m reference.make_gentle`; it takes some minutes. Rows are those of
`make_laws`.

As a gap grows, a contact comes or goes at some width of it: two balls just touch, or just part
before they are pressed together again. Close to that width they do so at hardly any speed.
"""

from collections.abc import Iterator
from itertools import islice, pairwise
from random import Random

import numpy as np

from reference.make_data import Case, write
from reference.make_laws import NAMES, STEPS, confirmed_rows, solve_quickly, stack

PAIRS = 14  # of stacks, on either side of a width
WIDTHS = np.geomspace(0.3, 3.0, 13)  # of the gap, in units of the first one
BISECTIONS = 40
MOST = 6  # intervals of a contact


def widened(case: Case, width: float) -> Case:
    """Return a case with its lowest gap multiplied."""
    return {**case, "gaps": [case["gaps"][0] * width, *case["gaps"][1:]]}


def counts(case: Case) -> list[int]:
    """Return the counts of intervals; nothing if the story is long or does not end."""
    found = solve_quickly(case, STEPS)
    short = found.status == "finished" and max(found.counts) < MOST
    return found.counts if short else []


def change(case: Case) -> float | None:
    """Return a width of the gap at which a count changes, if there is one."""
    found = [(width, counts(widened(case, width))) for width in WIDTHS]
    for (low, below), (high, above) in pairwise(found):
        if below and above and below != above:
            for _ in range(BISECTIONS):
                middle = 0.5 * (low + high)
                low, high = (
                    (middle, high) if counts(widened(case, middle)) == below else (low, middle)
                )
            return low
    return None


def pairs() -> Iterator[Case]:
    """Yield stacks on both sides of a width at which a count changes, without end."""
    random = Random(1882)
    names = [name for name in NAMES if name != "Spring"]
    while True:
        case = stack(random, random.choices(names, k=random.choice([2, 2, 3])), widest=10.0)
        width = change(case) if case["gaps"][0] else None
        away = 10.0 ** random.uniform(-8.0, -3.0)
        if width is not None:
            yield widened(case, width * (1.0 - away))
            yield widened(case, width * (1.0 + away))


if __name__ == "__main__":
    write("gentle", confirmed_rows(islice(pairs(), 2 * PAIRS)))
