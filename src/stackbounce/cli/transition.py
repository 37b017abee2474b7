"""The command ``stackbounce transition``: a stack with gaps from 0 to separate collisions."""

import math
from collections import Counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import DROP, AsJson, Overwrite, Plot, Tolerance, What, add_options
from stackbounce.cli.output import (
    check_picture,
    check_solved,
    console,
    draw_picture,
    print_files,
    print_json,
)

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

    from stackbounce.cli.scenario import Scenario

__all__ = ["EPILOG", "run"]

EPILOG = "For example: stackbounce transition basketball tennis --plot gaps.svg"
_SHARES = (0.02, 0.05, 0.1, 0.2, 0.5)  # of the whole range, at which the table has rows
_CHANGES = 12  # at most so many changes of a count have rows
_WIDE = 5  # of more balls only the top one has a column
_REST = 1e-6  # a smaller rebound ratio is shown as 0
_OUTPUTS = ("rebound_ratio", "collisions", "first_touch", "last_release", "energy_retained")


@add_options({name: DROP[name] for name in ("height", "speed", "gap", "contact")})
def run(
    what: What,
    *,
    only: Annotated[
        int | None,
        typer.Option(
            metavar="NUMBER",
            help="Vary only this gap, counted from 0, the lowest; default all, with one value.",
        ),
    ] = None,
    stop: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="The widest gap; default where the collisions are separate, and a little more.",
        ),
    ] = None,
    rtol: Tolerance = 1e-12,
    plot: Plot = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Open the gaps of a stack, from touching balls to separate collisions."""
    from stackbounce import transition
    from stackbounce.cli import scenario
    from stackbounce.units import quantity

    check_picture(plot, overwrite)
    last = None if stop is None else quantity(stop, "m", "--stop")
    chosen = scenario.read(what, **given)
    data = transition(chosen.drop, only, stop=last, rtol=rtol)
    draw_picture(plot, overwrite, "transition", data)
    if as_json:
        print_json(summary(chosen, data))
    else:
        print_transition(console(), chosen, data)
        print_files(plot)
    check_solved(Counter(_statuses(data)))


def summary(scenario: "Scenario", data: "xr.Dataset") -> dict[str, Any]:
    """Return what ``stackbounce transition --json`` prints."""
    from stackbounce.version import __version__

    return {
        "stackbounce": __version__,
        "drop": scenario.drop.to_mapping(),
        "separate_from": data.attrs["separate_from"],
        "changes": [
            {"gap": gap, "before": before, "after": after} for gap, before, after in _changes(data)
        ],
        "gap": data["gap"].values,
        **{name: data[name].values for name in _OUTPUTS},
        "status": _statuses(data),
        "textbook": {
            "rebound_ratio": data["textbook_ratio"].values,
            "collisions": data["textbook_collisions"].values,
            "energy_retained": float(data["textbook_energy"]),
        },
    }


def _statuses(data: "xr.Dataset") -> list[str]:
    from stackbounce.run.result import Status

    return [Status(status).name for status in data["status"].values]


def print_transition(console: "Console", scenario: "Scenario", data: "xr.Dataset") -> None:
    """Print a transition: some of the gaps, and those at which a count changes."""
    import numpy as np

    from stackbounce.cli.tables import incidence, label, new_table

    drop, gap = scenario.drop, data["gap"].values
    console.print(incidence(scenario), style="bold")
    limit, last = data.attrs["separate_from"], gap[-1]
    balls = range(len(drop.balls)) if len(drop.balls) <= _WIDE else [len(drop.balls) - 1]
    names = [f"\n{label(drop.balls[i].name, i)}" for i in balls]
    columns = ["gap\nmm", *names, "energy\nretained", "collisions,\nfloor first"]
    table = new_table("Rebound ratios, the lowest ball first, by the gap", (), columns)
    table.add_column("\n")
    changes = data.attrs["changes"]
    notes = {0.0: "touching"} | dict.fromkeys(changes[:_CHANGES], "a count changes")
    if limit <= last:
        notes[limit] = "separate from here on"
    usual = [gap[np.abs(gap - share * last).argmin()] for share in (*_SHARES, 1.0)]
    for one in sorted({*notes, *map(float, usual)}):
        row = data.isel(gap=int(np.flatnonzero(gap == one)[0]))
        ratios = row["rebound_ratio"].values[list(balls)]
        counts = _counts(row["collisions"].values)
        note = notes.get(one, "")
        table.add_row(*_numbers(1e3 * one, ratios, row["energy_retained"]), counts, note)
    ratios = data["textbook_ratio"].values[list(balls)]
    counts = _counts(data["textbook_collisions"].values)
    table.add_row(*_numbers(math.nan, ratios, data["textbook_energy"]), counts, "textbook")
    console.print(table)
    if limit <= last:
        console.print(
            f"\nFrom {1e3 * limit:.6g} mm on nothing changes: the collisions are separate."
        )
    elif math.isfinite(limit):
        console.print(f"\nThe collisions are separate from {1e3 * limit:.6g} mm on, beyond --stop.")
    else:
        console.print("\nThe collisions are never all separate, however wide the gap.")
    if len(changes) > _CHANGES:
        console.print(f"{len(changes) - _CHANGES} more changes of counts: see --json.")


def _changes(data: "xr.Dataset") -> list[tuple[float, Any, Any]]:
    """Return the gaps at which counts change, with the counts before and after."""
    import numpy as np

    counts, found = data["collisions"].values, []
    for gap in data.attrs["changes"]:
        i = int(np.flatnonzero(data["gap"].values == gap)[0])
        found.append((gap, counts[i - 1], counts[i]))
    return found


def _numbers(gap: float, ratios: Any, energy: Any) -> list[str]:
    from stackbounce.cli.tables import number, percent

    cells = [number(float(one) if abs(one) > _REST else 0.0) for one in ratios]
    return [number(gap), *cells, percent(float(energy))]


def _counts(counts: Any) -> str:
    from stackbounce.cli.tables import write_count

    return " ".join(map(write_count, counts))
