"""The kernels that the package's compiled code offers, with the types of their arguments.

The types are those of the annotations: a record of arrays is passed as the address of its `Table`,
any other argument as a float or an integer of 64 bits.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, get_type_hints

from stackbounce.engine.batch import run_batch, run_drop, run_rigid_batch, run_rigid_drop
from stackbounce.engine.ratios import find_ratios
from stackbounce.engine.two_springs import run_two_springs

ENTRIES: dict[str, Callable[..., Any]] = {
    entry.__name__: entry
    for entry in (
        run_drop,
        run_rigid_drop,
        run_batch,
        run_rigid_batch,
        run_two_springs,
        find_ratios,
    )
}
"""The entries by their names."""


class Signature(NamedTuple):
    """What an entry takes: records of arrays, `float` or `int`; and whether it returns an int."""

    arguments: tuple[type, ...]
    returns: bool


def signature(entry: Callable[..., Any]) -> Signature:
    """Return the signature of an entry.

    Examples
    --------
    >>> [argument.__name__ for argument in signature(find_ratios).arguments]
    ['Drops', 'Outcomes']
    """
    hints = get_type_hints(entry)
    returned = hints.pop("return")
    return Signature(tuple(hints.values()), returned is int)
