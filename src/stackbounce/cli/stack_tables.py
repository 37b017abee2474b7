"""The table of ``stackbounce highest``, for people and for machines."""

import math
from typing import Any

import xarray as xr
from rich.console import Console

from stackbounce.cli.tables import new_table, number, percent

_NAMES = ("place", "rebound_ratio", "height_ratio", "energy_share", "energy_retained", "collisions")


def summary(data: xr.Dataset) -> dict[str, Any]:
    """Return what ``stackbounce highest --json`` prints."""
    stacks = [
        {"balls": row["balls"].values, "masses": row["mass"].values, "name": row["stack"].values}
        | {name: row[name].values for name in _NAMES}
        for row in (data.isel(stack=i) for i in range(data.sizes["stack"]))
    ]
    return {**data.attrs, "gap": data["gap"].values, "stacks": stacks}


def print_stacks(console: Console, data: xr.Dataset, rows: int) -> None:
    """Print the first stacks in order, and how the gap changes the order."""
    count, names, gaps = data.sizes["stack"], data["stack"].values, data["gap"].values
    speed, shown_rows = number(data.attrs["impact_speed"]), min(rows, count)
    console.print(f"The best {shown_rows} of {count} stacks, at {speed} m/s", style="bold")
    first = "its own gaps" if math.isnan(gaps[0]) else f"gaps of {number(1e3 * gaps[0])} mm"
    places = [
        f"{'' if k else 'place, bounce'}\n{1e3 * gap:.4g} mm" for k, gap in enumerate(gaps[1:])
    ]
    numbers = ["ratio\nv/v0", "bounce\n/drop", "share of\nenergy", *places]
    table = new_table(f"Top ball, with {first}", ["\nballs, the lowest first"], numbers)
    for i in range(shown_rows):
        row = data.isel(stack=i)
        heights = [number(float(height)) for height in row["height_ratio"].values]
        others = [
            f"{place}, {text}" for place, text in zip(row["place"].values, heights, strict=True)
        ]
        ratio = number(float(row["rebound_ratio"][0, -1]))
        share = percent(float(row["energy_share"][0]))
        table.add_row(str(names[i]), ratio, heights[0], share, *others[1:])
    console.print(table)
    for gap, best in zip(gaps[1:], names[data["place"].values.argmin(axis=0)][1:], strict=True):
        if best != names[0]:
            console.print(f"With gaps of {1e3 * gap:.4g} mm {best} is first.")
    for i in data.attrs.get("at_the_end", ()):
        low, high = data.attrs["within"]
        console.print(
            f"The mass of ball {i} lies at the end of what was tried, {low:.6g} kg to {high:.6g} "
            "kg: the best one is beyond (--within)"
        )
