"""Options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

from stackbounce.model.laws import LAWS

__all__ = [
    "AsJson",
    "Contact",
    "Gap",
    "Gravity",
    "Height",
    "Plot",
    "Save",
    "Speed",
    "Tolerance",
    "Until",
    "What",
]

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]
Height = Annotated[
    str | None, typer.Option(metavar="LENGTH", help="Height fallen from rest, such as 0.63m.")
]
Speed = Annotated[str | None, typer.Option(metavar="SPEED", help="Impact speed, such as 3.53m/s.")]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", readable=False, help="Draw it: .svg, .png or .pdf.")
]
What = Annotated[
    list[str],
    typer.Argument(
        metavar="SCENARIO|BALLS",
        help="A scenario file in TOML, or balls of the catalogue, the lowest first.",
        show_default=False,
    ),
]
Gap = Annotated[
    list[str] | None,
    typer.Option(metavar="LENGTH", help="Gap between two balls; once per pair, lowest first."),
]
Contact = Annotated[
    list[str] | None,
    typer.Option(
        metavar="LAW",
        help="Contact below a ball, such as 'Spring stiffness=2.5kN/m'; once per ball, "
        f"lowest first. Laws: {', '.join(LAWS)}; none for no floor.",
    ),
]
Gravity = Annotated[
    str | None,
    typer.Option(metavar="ACCELERATION", help="Gravity during the run, such as 9.81m/s^2."),
]
Until = Annotated[
    str | None,
    typer.Option(metavar="TIME", help="Stop at this time, not when the balls have parted."),
]
Tolerance = Annotated[
    float, typer.Option(metavar="NUMBER", help="Relative error to aim at under laws not linear.")
]
Save = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", readable=False, help="Write the best stack as a scenario: best.toml."
    ),
]
