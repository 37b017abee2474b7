"""Options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["AsJson", "Height", "Plot", "Speed"]

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]
Height = Annotated[
    str | None, typer.Option(metavar="LENGTH", help="Height fallen from rest, such as 0.63m.")
]
Speed = Annotated[str | None, typer.Option(metavar="SPEED", help="Impact speed, such as 3.53m/s.")]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", readable=False, help="Draw it: .svg, .png or .pdf.")
]
