"""The command ``stackbounce highest``: the stack that throws its top ball highest."""

import math
from collections import Counter
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import DROP, AsJson, Overwrite, Plot, Save, add_options
from stackbounce.cli.output import (
    check_picture,
    check_scenario,
    check_solved,
    console,
    draw_picture,
    print_files,
    print_json,
    write_scenario,
)
from stackbounce.errors import positive

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

__all__ = ["EPILOG", "run"]

EPILOG = "For example: stackbounce highest --balls 3 --gap 0 --gap 2mm --plot stacks.svg"


@add_options({name: DROP[name] for name in ("height", "speed")})
def run(
    what: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[BALL]...",
            help="Balls of the catalogue, or scenario files of one ball each, as measure --save "
            "writes them; by default the balls of the paper.",
            show_default=False,
        ),
    ] = None,
    *,
    balls: Annotated[int, typer.Option(metavar="NUMBER", help="Balls in a stack.")] = 3,
    repeat: Annotated[
        bool, typer.Option("--repeat", help="Take each ball any number of times.")
    ] = False,
    gap: Annotated[
        list[str] | None,
        typer.Option(
            metavar="LENGTH",
            help="Gap between all neighbours, once for each that is tried; the order is that of "
            "the first; by default 0, 1 mm and 5 mm.",
        ),
    ] = None,
    law: Annotated[
        str,
        typer.Option(
            metavar="LAW",
            help="Of the catalogue's contacts, with the ball's contact time and restitution: "
            "hysteretic, or spring, which loses nothing.",
        ),
    ] = "hysteretic",
    rows: Annotated[int, typer.Option(metavar="NUMBER", help="Stacks to print.", min=1)] = 10,
    save: Save = None,
    plot: Plot = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Try all stacks of some balls: which one throws its top ball highest."""
    from stackbounce import highest
    from stackbounce.cli.scenario import is_file
    from stackbounce.model import Drop
    from stackbounce.model.laws import law_named
    from stackbounce.run.result import Status
    from stackbounce.units import quantity

    check_picture(plot, overwrite)
    check_scenario(save, overwrite, what or ())
    chosen: dict[str, Any] = {"law": law_named(law), "impact_speed": _impact_speed(**given)}
    if what:
        chosen["balls"] = [Drop.from_toml(one) if is_file(one) else one for one in what]
    if gap:
        chosen["gaps"] = [quantity(one, "m", "--gap") for one in gap]
    data = highest(count=balls, repeat=repeat, **chosen)
    write_scenario(data.attrs["best"], save, overwrite)
    draw_picture(plot, overwrite, "highest", data)
    if as_json:
        print_json(summary(data))
    else:
        print_stacks(console(), data, rows)
        print_files(plot, best=save)
    check_solved(Counter(Status(status).name for status in data["status"].values.ravel()))


def _impact_speed(height: str | None, speed: str | None) -> float | None:
    """Return the impact speed in m/s of ``--height`` or ``--speed``."""
    from stackbounce.cli.scenario import read_fall
    from stackbounce.model import STANDARD_GRAVITY

    fall = read_fall(height, speed)
    if "height" in fall:
        return math.sqrt(2.0 * STANDARD_GRAVITY * positive("--height", fall["height"], "metres"))
    return fall.get("impact_speed")


def summary(data: "xr.Dataset") -> dict[str, Any]:
    """Return what ``stackbounce highest --json`` prints."""
    names = ("place", "rebound_ratio", "height_ratio", "energy_share", "energy_retained")
    stacks = []
    for i in range(data.sizes["stack"]):
        row = data.isel(stack=i)
        stacks.append(
            {"balls": row["balls"].values, "collisions": row["collisions"].values}
            | {name: row[name].values for name in names}
        )
    return {**data.attrs, "gap": data["gap"].values, "stacks": stacks}


def print_stacks(console: "Console", data: "xr.Dataset", rows: int) -> None:
    """Print the first stacks in order, and how the gap changes the order."""
    import numpy as np

    from stackbounce.cli.tables import new_table, number, percent

    speed = data.attrs["impact_speed"]
    count, gaps = data.sizes["stack"], 1e3 * data["gap"].values
    shown_rows = min(rows, count)
    console.print(f"The best {shown_rows} of {count} stacks, at {number(speed)} m/s", style="bold")
    title = f"Top ball, with gaps of {number(gaps[0])} mm"
    places = [f"{'' if k else 'place, bounce'}\n{gap:.4g} mm" for k, gap in enumerate(gaps[1:])]
    numbers = ["ratio\nv/v0", "bounce\n/drop", "share of\nenergy", *places]
    table = new_table(title, ["\nballs, the lowest first"], numbers)
    for i in range(shown_rows):
        row = data.isel(stack=i)
        others = [
            f"{int(place)}, {number(float(height))}"
            for place, height in zip(row["place"].values, row["height_ratio"].values, strict=True)
        ]
        table.add_row(
            " + ".join(map(str, row["balls"].values)),
            number(float(row["rebound_ratio"][0, -1])),
            number(float(row["height_ratio"][0])),
            percent(float(row["energy_share"][0])),
            *others[1:],
        )
    console.print(table)
    first = data["balls"].values[data["place"].values.argmin(axis=0)]
    for gap, names in zip(gaps[1:], first[1:], strict=True):
        if list(names) != list(first[0]):
            console.print(f"With gaps of {gap:.4g} mm {' + '.join(names)} is first.")
    unfinished = int((~np.isfinite(data["rebound_ratio"].values[..., -1])).sum())
    if unfinished:
        console.print(f"{unfinished} drops could not be finished.")
