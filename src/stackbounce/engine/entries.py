"""The kernels that the package's compiled code offers, with the types of their arguments.

The types are those of the annotations: a record of arrays is passed as the address of its `Table`,
any other argument as a float or an integer of 64 bits.
"""

from collections.abc import Callable
from typing import Any, get_type_hints

from stackbounce.engine.batch import run_batch, run_drop, run_rigid_batch, run_rigid_drop
from stackbounce.engine.pairs import run_linear, run_pairs
from stackbounce.engine.sideways import carry_sideways, place_pushes
from stackbounce.engine.two_rigid import run_two_rigid
from stackbounce.engine.two_springs import run_two_springs

ENTRIES: dict[str, Callable[..., Any]] = {
    entry.__name__: entry
    for entry in (
        *(run_drop, run_rigid_drop, run_batch, run_rigid_batch),
        *(run_two_rigid, run_two_springs, run_linear, run_pairs),
        *(place_pushes, carry_sideways),
    )
}
"""The entries by their names."""


def arguments(entry: Callable[..., Any]) -> tuple[type, ...]:
    """Return what an entry takes: records of arrays, `float` or `int`.

    Examples
    --------
    >>> [argument.__name__ for argument in arguments(run_two_springs)]
    ['Drops', 'int', 'Outcomes', 'Workspace']
    """
    hints = get_type_hints(entry)
    return tuple(kind for name, kind in hints.items() if name != "return")
