"""The command ``stackbounce measure``: files -> their results, and a ball for ``simulate``."""

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import AsJson, Overwrite, Plot, add_options, option
from stackbounce.cli.output import (
    check_picture,
    check_scenario,
    console,
    draw_picture,
    print_json,
    write_scenario,
)
from stackbounce.errors import InvalidValue
from stackbounce.extras import need
from stackbounce.measure.messages import OptionHint
from stackbounce.measure.options import OPTIONS, Option

if TYPE_CHECKING:
    from stackbounce.measure.constants import LawConstants
    from stackbounce.measure.measurement import Measurement

EPILOG = (
    "For example: stackbounce measure bounces.wav --mass 57g --height 1m --save ball.toml, "
    "then: stackbounce simulate ball.toml"
)
Files = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="FILE...",
        readable=False,
        help="Sound, force waveform, video track, acceleration, times or heights of bounces, or "
        "press curve, as Tracker, ImageJ, phyphox, oscilloscopes or spreadsheets write it.",
        show_default=False,
    ),
]
Name = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="For --save.", rich_help_panel="What is known of the ball"),
]
Save = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", readable=False, help="Write the ball as a scenario for simulate: ball.toml."
    ),
]


def _as_command(table_row: Option) -> tuple[Any, Any]:
    """Return the command's option for one of the table."""
    several = table_row.form == "columns"
    kinds: dict[str, Any] = {"flag": bool, "file": Path | None, "columns": list[str] | None}
    return option(
        kinds.get(table_row.form, str if table_row.default else str | None),
        None if table_row.form == "flag" else table_row.value_name,
        table_row.says,
        table_row.on_command_line,
        default=table_row.default,
        rich_help_panel=table_row.panel or None,
        readable=table_row.form != "file",
        show_default=not several,
    )


@add_options({each.name: _as_command(each) for each in OPTIONS})
def run(
    files: Files = None,
    *,
    name: Name = None,
    save: Save = None,
    plot: Plot = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Find restitutions, stiffnesses, speeds and heights in what was measured, with errors."""
    need("measure", "stackbounce measure")
    from stackbounce.cli.measure_tables import print_measured, summary
    from stackbounce.measure.measurement import measure_file, measure_numbers
    from stackbounce.measure.option_values import read_options

    files = files or []
    if plot is not None:
        check_picture(plot, overwrite)
        count = len(files) + (given["heights"] is not None)
        if count != 1:
            raise InvalidValue(f"--plot draws one file or --heights, got {count}")
    known = read_options(given, lambda one: one.on_command_line)
    if save is not None:
        check_scenario(save, overwrite)
        if "mass" not in known:
            raise InvalidValue("--save needs the mass of the ball, such as --mass 57g")
    done = [measure_file(path, known, _wording) for path in files] + measure_numbers(known)
    if not done:
        raise InvalidValue("measure needs a file, --heights, --contact-time or --restitution")
    law = _law_of(known, done) if "law" in known else None
    saved = {} if save is None else _save(done, law, save, known, name, overwrite)
    if plot is not None:
        draw_picture(plot, overwrite, "measured", done[0].data, done[0].found[-1])
    if as_json:
        print_json(summary(done, law, saved))
        return
    print_measured(console(), done, law)
    if save is not None:
        typer.echo(f"Ball: {save}; now: stackbounce simulate {save}")
    if plot is not None:
        typer.echo(f"Picture: {plot}")


def _wording(hint: OptionHint) -> str:
    """Return the options of a hint as they are typed, with the whole command if it names a file."""
    known = {option.name: option.on_command_line for option in OPTIONS}
    typed = []
    for name, value in hint.options.items():
        columns = value.items() if isinstance(value, Mapping) else ()
        texts = [f"{key}={one}" for key, one in columns] or [value]
        typed += [
            known[name] if text is None else f"{known[name]} {shlex.quote(str(text))}"
            for text in texts
        ]
    if hint.file:
        return " ".join(["stackbounce measure", shlex.quote(hint.file), *typed])
    all_names = all(value is None for value in hint.options.values())
    return (", " if all_names else " ").join(typed)


def _law_of(known: Mapping[str, Any], done: "Sequence[Measurement]") -> "LawConstants":
    """Return the law of ``--law``, calibrated to the results and the known numbers."""
    from stackbounce.measure import one_law
    from stackbounce.measure.setup import Setup

    names = ("mass", "contact_time", "restitution", "exponent")
    given = {name: known[name] for name in names if name in known}
    of_fall = ("height", "speed", "gravity", "mass", "diameter", "drag_coefficient", "air_density")
    speed = Setup.of(of_fall, known).impact_speed
    found = [finding for each in done for finding in each.found]
    return one_law(known["law"], found, **given, impact_speed=speed)


def _save(
    done: "Sequence[Measurement]",
    law: "LawConstants | None",
    path: Path,
    known: Mapping[str, Any],
    name: str | None,
    overwrite: bool,
) -> dict[str, Any]:
    """Write the ball that was measured as a scenario file, and return what is in it."""
    from stackbounce.measure import one_ball

    parts = [found.parts() for one in done for found in one.found]
    if law is not None:
        parts = [{key: part[key] for key in part if key != "contact"} for part in parts]
        parts.append(law.parts())
    ball = {key: known[key] for key in ("mass", "diameter") if key in known}
    plain = {key: getattr(value, "nominal_value", value) for key, value in ball.items()}
    drop = one_ball(parts, **plain, name=name)
    write_scenario(drop.to_toml(), path, overwrite)
    return drop.to_mapping()
