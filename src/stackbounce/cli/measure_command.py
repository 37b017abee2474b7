"""The command ``stackbounce measure`` and its options."""

from pathlib import Path
from typing import Annotated

import typer

from stackbounce.cli.options import AsJson, Height, Plot, Speed
from stackbounce.cli.output import check_picture, console, draw
from stackbounce.errors import InvalidValue
from stackbounce.model.laws import LAWS

__all__ = ["EPILOG", "measure"]

EPILOG = (
    "For example: stackbounce measure bounces.wav --mass 57g --height 1m --save ball.toml, "
    "then: stackbounce simulate ball.toml"
)
_BALL, _DROP = "What is known of the ball", "What is known of the drop"
_FILE = "What a file does not say"

Files = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="FILE...",
        readable=False,
        help="Sound, force waveform, video track, acceleration, times or heights of bounces, or "
        "press curve, as Tracker, phyphox, Vernier, PASCO, oscilloscopes or spreadsheets write it.",
        show_default=False,
    ),
]
Mass = Annotated[
    str | None,
    typer.Option(
        metavar="MASS",
        help="Such as 57g, or with its error '57.0 ± 0.5 g', as all numbers of ball and drop.",
        rich_help_panel=_BALL,
    ),
]
Diameter = Annotated[
    str | None, typer.Option(metavar="LENGTH", help="Such as 66mm.", rich_help_panel=_BALL)
]
Name = Annotated[
    str | None, typer.Option(metavar="NAME", help="For --save.", rich_help_panel=_BALL)
]
ContactTime = Annotated[
    str | None,
    typer.Option(
        metavar="TIME",
        help="On the floor, where no file tells it: '5.0 ± 0.1 ms'.",
        rich_help_panel=_BALL,
    ),
]
Restitution = Annotated[
    str | None,
    typer.Option(
        metavar="NUMBER",
        help="On the floor, where no file tells it: '0.75 ± 0.02'.",
        rich_help_panel=_BALL,
    ),
]
Law = Annotated[
    str | None,
    typer.Option(
        metavar="LAW",
        help=f"Give the constants of this contact law, and save it: {', '.join(LAWS)}; as in "
        "'PowerLaw exponent=1.3'. A force waveform's touches and releases are then those of this "
        "law, with smaller errors.",
        rich_help_panel=_BALL,
    ),
]
Heights = Annotated[
    str | None,
    typer.Option(
        metavar="LENGTHS",
        help="Instead of a file: the drop's and those of the bounces, '1.00, 0.62, 0.39 m'.",
        rich_help_panel=_DROP,
    ),
]
HeightError = Annotated[
    str | None,
    typer.Option(
        metavar="LENGTH",
        help="Of each height of --heights or of a table, such as 5mm.",
        rich_help_panel=_DROP,
    ),
]
Repeated = Annotated[
    bool,
    typer.Option(
        "--repeated",
        help="The heights after the first are of one bounce, from drop after drop.",
        rich_help_panel=_DROP,
    ),
]
MeasuredTo = Annotated[
    str,
    typer.Option(
        metavar="POINT",
        help="Point of the ball that heights are those of, or that a track follows: bottom, centre "
        "or top; bottom,top if the drop's and the bounces' differ.",
        rich_help_panel=_DROP,
    ),
]
Floor = Annotated[
    str | None,
    typer.Option(
        metavar="LENGTH",
        help="Level of the floor in a track, such as 0m: for balls that stay on it for long.",
        rich_help_panel=_DROP,
    ),
]
Alone = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        readable=False,
        help="The floor's force under the lower ball alone, from the same height: tells the gap of "
        "the stack that FILE is of.",
        rich_help_panel=_DROP,
    ),
]
TimeConstant = Annotated[
    str | None,
    typer.Option(
        metavar="TIME",
        help="Of a piezo sensor's droop, such as 0.1s: undoes it.",
        rich_help_panel=_DROP,
    ),
]
Gravity = Annotated[
    str | None,
    typer.Option(
        metavar="ACCELERATION",
        help="Where it was measured, such as 9.81m/s^2.",
        rich_help_panel=_DROP,
    ),
]
Holds = Annotated[
    str | None,
    typer.Option(
        metavar="KIND",
        help="What it holds, where it is unsure: sound, knocks, bounces, track, waveform, "
        "acceleration, 'press curve' or table.",
        rich_help_panel=_FILE,
    ),
]
Column = Annotated[
    list[str] | None,
    typer.Option(
        metavar="COLUMN=MEANING",
        help="What a column is, by its name or its number from 1: 2=force; once per column.",
        rich_help_panel=_FILE,
    ),
]
Unit = Annotated[
    list[str] | None,
    typer.Option(
        metavar="COLUMN=UNIT",
        help="Unit of a column: x=cm; once per column.",
        rich_help_panel=_FILE,
    ),
]
Table = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="Which table of a zip.", rich_help_panel=_FILE),
]
Run = Annotated[
    str | None,
    typer.Option(
        "--run", metavar="RUN", help="Which of several runs in it.", rich_help_panel=_FILE
    ),
]
Save = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", readable=False, help="Write the ball as a scenario for simulate: ball.toml."
    ),
]


def measure(
    files: Files = None,
    mass: Mass = None,
    diameter: Diameter = None,
    name: Name = None,
    contact_time: ContactTime = None,
    restitution: Restitution = None,
    law: Law = None,
    heights: Heights = None,
    height_error: HeightError = None,
    repeated: Repeated = False,
    measured_to: MeasuredTo = "bottom",
    height: Height = None,
    speed: Speed = None,
    floor: Floor = None,
    alone: Alone = None,
    time_constant: TimeConstant = None,
    gravity: Gravity = None,
    holds: Holds = None,
    column: Column = None,
    unit: Unit = None,
    table: Table = None,
    run: Run = None,
    save: Save = None,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Find restitutions, stiffnesses, speeds and heights in what was measured, with errors."""
    from stackbounce.cli import machine, measured

    if plot is not None:
        check_picture(plot)
        if len(files or []) + (heights is not None) != 1:
            count = len(files or []) + (heights is not None)
            raise InvalidValue(f"--plot draws one file or --heights, got {count}")
    ball = measured.numbers(mass=mass, diameter=diameter)
    contact = measured.numbers(contact_time=contact_time, restitution=restitution)
    drop = measured.numbers(
        height=height,
        speed=speed,
        height_error=height_error,
        floor=floor,
        time_constant=time_constant,
        gravity=gravity,
    )
    points = {"measured_to": measured.points(measured_to), "repeated": repeated}
    chosen = None if law is None else measured.law(law)
    if save is not None:
        measured.check_save(save, ball)
    reading = {
        "holds": holds,
        "names": measured.pairs(column, "--column", "COLUMN=MEANING, such as 2=force"),
        "units": measured.pairs(unit, "--unit", "COLUMN=UNIT, such as x=cm"),
        "table": table,
        "run": run,
    }
    known = ball | contact | drop | points
    of_law = {} if chosen is None else {"law": chosen[0], **chosen[1]}
    done = measured.run(files or [], alone, reading, known | of_law)
    done += measured.typed(heights, contact, known)
    if not done:
        raise InvalidValue("measure needs a file, --heights, --contact-time or --restitution")
    found = None if chosen is None else measured.constants(chosen, done, known)
    saved = {} if save is None else measured.save(done, found, save, ball | {"name": name})
    if plot is not None:
        draw(lambda: measured.picture(done), plot)
    if as_json:
        typer.echo(machine.text(measured.summary(done, found, saved)))
        return
    measured.tell(console(), done, found)
    if save is not None:
        typer.echo(f"Ball: {save}; now: stackbounce simulate {save}")
    if plot is not None:
        typer.echo(f"Picture: {plot}")
