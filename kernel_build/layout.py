"""What a caller in another language must know of the kernels: `layout.json`.

It lists the entries with the types of their arguments, the arrays of each record, and the codes. A
caller writes the arrays of a record to memory, and a table of their addresses, rows and columns
(`stackbounce.engine.tables`); a kernel takes the address of the table.

The rows and columns of an array are sums of products of sizes: ``{"": 3, "balls times": 2}`` means
3 + 2 balls times. The sizes are

- ``balls``: the height of a stack,
- ``drops``: the rows of `Drops` and `Outcomes`,
- ``times``: the times of samples, or pushes,
- ``scratch``: the numbers that an engine in lanes needs in ``Workspace.floats``. For other entries
  ``floats`` and ``integers`` of the workspace are all floats and all integers of the stack, which
  lie one array after the other in the order of the record.
"""

from collections.abc import Callable, Sequence
from typing import Any, get_type_hints

from stackbounce.engine import codes, records, sideways, slots
from stackbounce.engine.codes import LOG_COLUMNS
from stackbounce.engine.entries import ENTRIES, arguments
from stackbounce.engine.kernels import FloatTable, IntegerColumn, Integers, IntegerTable
from stackbounce.engine.records import Drops, Outcomes, Workspace
from stackbounce.engine.sideways import Pushes, new_pushes
from stackbounce.engine.stack import (
    RigidStack,
    Samples,
    Stack,
    new_rigid_stack,
    new_samples,
    new_stack,
)
from stackbounce.engine.work import ASKED_RTOL, EVENT_LIMIT, LANE_EVENTS, WORK_LIMIT

FILE = "layout.json"
_LOG_ROWS = 512  # besides one for each ball
_STATUSES = "RUNNING FINISHED SETTLED COLLAPSED TIME_REACHED EVENT_LIMIT INVALID ASK"
_EVENTS = "TOUCH RELEASE COLLISION PEAK DIP LINEARISED CURVED RETURNED CLIPPED RESUMED JOINED"
_COLUMNS = "TIME CONTACT KIND LOWER_VELOCITY UPPER_VELOCITY START PEAK_FORCE PEAK_COMPRESSION"

_TRIALS = ((1, 1), (2, 1), (1, 2), (2, 2), (5, 7))  # balls and times, or pushes

Terms = dict[str, int]


def layout() -> dict[str, Any]:
    """Return the contents of `layout.json`."""
    return {
        "entries": {
            name: [kind.__name__ for kind in arguments(entry)] for name, entry in ENTRIES.items()
        },
        "records": {
            "Stack": _fields(Stack, lambda balls, _: new_stack(balls)),
            "RigidStack": _fields(RigidStack, lambda balls, _: new_rigid_stack(balls)),
            "Samples": _fields(Samples, lambda balls, times: new_samples([0.0] * times, balls)),
            "Pushes": _fields(Pushes, new_pushes),
            "Workspace": _workspace(),
            "Drops": _rows_of_drops(Drops),
            "Outcomes": _rows_of_drops(Outcomes),
        },
        "sizes": {"scratch": records.SCRATCH, "log_columns": LOG_COLUMNS},
        "pushes": {
            name: getattr(sideways, name) for name in ("LEVELS", "FEW", "MANY", "ENOUGH", "WRONG")
        },
        "stages": {
            name: getattr(records, name) for name in ("CONTINUE", "BEGIN", "BEGIN_WITH_PEAKS")
        },
        "after": {name: getattr(records, name) for name in ("UNIT", "END", "AFTER")},
        "counter": {"LOG_ROWS": slots.LOG_ROWS, "CAUSE": slots.CAUSE},
        "limits": {
            "events": EVENT_LIMIT,
            "work": WORK_LIMIT,
            "lanes": LANE_EVENTS,
            "asked": ASKED_RTOL,
        },
        "log": _numbered(f"{_COLUMNS} IMPULSE PEAK_TIME"),
        "statuses": _numbered(_STATUSES),
        "causes": _numbered("ENDLESS STIFF EXTREME"),
        "events": _numbered(_EVENTS),
        "forms": _numbered("ABSENT POWER"),
        "linear_forms": list(codes.LINEAR_FORMS),
        "pair_forms": list(codes.PAIR_FORMS),
    }


def _numbered(names: str) -> dict[str, int]:
    """Return the codes of some names."""
    return {name: getattr(codes, name) for name in names.split()}


def _field(name: str, kind: Any, rows: Terms, columns: Terms) -> dict[str, Any]:
    number = "int" if kind in (Integers, IntegerColumn, IntegerTable) else "float"
    return {"name": name, "kind": number, "rows": rows, "columns": columns}


def _fields(record: type, make: Callable[[int, int], Any]) -> list[dict[str, Any]]:
    """Return the fields of a record of lists that is made for a number of balls and of times."""

    def shape(values: Any) -> tuple[int, int]:
        return len(values), len(values[0]) if values and isinstance(values[0], list) else 1

    shapes = [[shape(values) for values in make(*sizes)] for sizes in _TRIALS]
    hints = get_type_hints(record, include_extras=True)
    return [
        _field(name, kind, *map(_terms, zip(*trials, strict=True)))
        for (name, kind), trials in zip(hints.items(), zip(*shapes, strict=True), strict=True)
    ]


def _terms(lengths: Sequence[int]) -> Terms:
    """Return the terms of a length that is linear in the numbers of balls and of times.

    Raises
    ------
    ValueError
        If it is not.
    """
    one, balls, times, both, more = lengths
    product = both - balls - times + one
    terms = {"balls times": product, "balls": balls - one - product, "times": times - one - product}
    terms[""] = one - sum(terms.values())
    if more != terms[""] + 5 * terms["balls"] + 7 * terms["times"] + 35 * product:
        raise ValueError("the length of an array is not linear in the numbers of balls and times")
    return {name: factor for name, factor in terms.items() if factor}


def _workspace() -> list[dict[str, Any]]:
    """Return the fields of a `Workspace`."""
    rows: dict[str, Terms] = {
        "floats": {"scratch": 1},
        "integers": {},
        "log": {"": _LOG_ROWS * LOG_COLUMNS, "balls": LOG_COLUMNS},
        "after": {"": records.AFTER, "balls": 1},
    }
    hints = get_type_hints(Workspace, include_extras=True)
    return [_field(name, kind, rows[name], {"": 1}) for name, kind in hints.items()]


def _rows_of_drops(record: type) -> list[dict[str, Any]]:
    """Return the fields of a record with a row for each drop."""
    hints = get_type_hints(record, include_extras=True)
    return [
        _field(
            name,
            kind,
            {"drops": 1},
            {"balls": 1} if kind in (FloatTable, IntegerTable) else {"": 1},
        )
        for name, kind in hints.items()
    ]
