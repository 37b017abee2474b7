"""The command ``stackbounce highest``: the stack that throws its top ball highest."""

import math
from collections import Counter
from typing import Annotated, Any

import typer

from stackbounce.cli.options import (
    DROP,
    RARE,
    AsJson,
    Overwrite,
    Plot,
    Save,
    add_options,
    ball_names,
    law_names,
)
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
from stackbounce.errors import InvalidValue, positive, shown

__all__ = ["EPILOG", "run"]

EPILOG = "For example: stackbounce highest B1 B2 B3 tennis --gap 0 --gap 2mm --masses"


@add_options({name: DROP[name] for name in ("height", "speed", "contact")})
def run(
    what: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[BALL]...",
            help="Balls of the catalogue, or scenario files of one ball each, as measure --save "
            "writes them; by default the balls of the paper. A file of several balls is one stack.",
            show_default=False,
            autocompletion=ball_names,
        ),
    ] = None,
    *,
    balls: Annotated[int, typer.Option(metavar="NUMBER", help="Balls in a stack.")] = 3,
    gap: Annotated[
        list[str] | None,
        typer.Option(
            metavar="LENGTH",
            help="Gap between all neighbours, once for each that is tried; the order is that of "
            "the first; by default 0, 1 mm and 5 mm, or those of a file's stack.",
        ),
    ] = None,
    masses: Annotated[
        bool,
        typer.Option("--masses", help="Find the best inner masses of the best stack, too."),
    ] = False,
    within: Annotated[
        str | None,
        typer.Option(
            metavar="MASS:MASS",
            help="The smallest and the largest mass for --masses, such as 10g:1kg; by default "
            "those of the lowest and the top ball.",
            rich_help_panel=RARE,
        ),
    ] = None,
    in_order: Annotated[
        bool,
        typer.Option(
            "--in-order",
            help="Try only the stack in the order given, with its contacts in simulate; --contact "
            "does so, too.",
            rich_help_panel=RARE,
        ),
    ] = False,
    repeat: Annotated[
        bool,
        typer.Option("--repeat", help="Take each ball any number of times.", rich_help_panel=RARE),
    ] = False,
    law: Annotated[
        str,
        typer.Option(
            metavar="LAW",
            help="Of the catalogue's contacts, with the ball's contact time and restitution: "
            "hysteretic, or spring, which loses nothing.",
            rich_help_panel=RARE,
            autocompletion=law_names,
        ),
    ] = "hysteretic",
    rows: Annotated[int, typer.Option(metavar="NUMBER", help="Stacks to print.", min=1)] = 10,
    save: Save = None,
    plot: Plot = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Find which balls, order, gaps and masses throw the top ball of a stack highest."""
    from stackbounce import highest
    from stackbounce.cli.scenario import is_file, read
    from stackbounce.cli.stack_tables import print_stacks, summary
    from stackbounce.model import Drop
    from stackbounce.model.laws import law_named
    from stackbounce.run.result import Status
    from stackbounce.units import quantity

    what = what or []
    check_picture(plot, overwrite)
    check_scenario(save, overwrite, what)
    chosen: dict[str, Any] = {"masses": _limits(within) if within else masses}
    if gap:
        chosen["gaps"] = [quantity(text, "m", "--gap") for text in gap]
    if in_order or given["contact"] or (len(what) == 1 and is_file(what[0])):
        chosen["balls"] = read(what, **given).drop
    else:
        named = [Drop.from_toml(name) if is_file(name) else name for name in what]
        chosen |= {"balls": named or None, "count": balls, "repeat": repeat, "law": law_named(law)}
        chosen["impact_speed"] = _impact_speed(given["height"], given["speed"])
    data = highest(**chosen)
    write_scenario(data.attrs["best"], save, overwrite)
    draw_picture(plot, overwrite, "highest", data)
    if as_json:
        print_json(summary(data))
    else:
        print_stacks(console(), data, rows)
        print_files(plot, best=save)
    check_solved(Counter(Status(status).name for status in data["status"].values.ravel()))


def _limits(text: str) -> tuple[float, ...]:
    """Return the smallest and the largest mass in kg of ``--within``."""
    from stackbounce.units import quantity

    ends = text.split(":")
    if len(ends) != 2:
        raise InvalidValue(f"--within must be MASS:MASS, such as 10g:1kg, got {shown(text)}")
    return tuple(quantity(end, "kg", "--within") for end in ends)


def _impact_speed(height: str | None, speed: str | None) -> float | None:
    """Return the impact speed in m/s of ``--height`` or ``--speed``."""
    from stackbounce.cli.scenario import read_fall
    from stackbounce.model import STANDARD_GRAVITY

    fall = read_fall(height, speed)
    if "height" in fall:
        return math.sqrt(2.0 * STANDARD_GRAVITY * positive("--height", fall["height"], "metres"))
    return fall.get("impact_speed")
