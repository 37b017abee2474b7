"""The command ``stackbounce measure``: files -> their results, and a ball for ``simulate``."""

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import typer

from stackbounce.cli import output
from stackbounce.errors import InvalidValue, StackbounceError
from stackbounce.extras import MEASURING, need
from stackbounce.measure.messages import OptionHint
from stackbounce.measure.options import OPTIONS


def run(
    files: Sequence[Path] | None,
    name: str | None,
    save: Path | None,
    plot: Path | None,
    overwrite: bool,
    as_json: bool,
    **given: Any,
) -> None:
    """Find restitutions, stiffnesses, speeds and heights in what was measured, with errors."""
    need("stackbounce measure", *MEASURING)
    from stackbounce.cli.measure_tables import law_of, print_measured, save_ball, summary
    from stackbounce.measure.measurement import measure_file, measure_numbers
    from stackbounce.measure.option_values import read_options

    files = files or []
    output.check_picture(plot, overwrite)
    output.check_file(save, overwrite, "--save", (".toml",))
    count = len(files) + (given["heights"] is not None)
    if plot is not None and count != 1:
        raise InvalidValue(f"--plot draws one file or --heights, got {count}")
    known = read_options(given, lambda option: option.on_command_line)
    if save is not None and "mass" not in known:
        raise InvalidValue("--save needs the mass of the ball, such as --mass 57g")
    try:
        done = [measure_file(path, known, _wording) for path in files]
        done += measure_numbers(known, _wording)
    except StackbounceError as error:
        table = next(filter(_has_bounces, files), None)
        if table is None:
            raise
        raise InvalidValue(
            f"{table} is a table of bounces from several heights or at several speeds: "
            f"stackbounce fit {shlex.quote(str(table))} fits it"
        ) from error
    if not done:
        raise InvalidValue("measure needs a file, --heights, --contact-time or --restitution")
    law = law_of(known, done) if "law" in known else None
    saved = {} if save is None else save_ball(done, law, save, known, name, overwrite)
    if plot is not None:
        output.draw_picture(plot, overwrite, "measured", done[0].data, done[0].found[-1])
    if as_json:
        output.print_json(summary(done, law, saved))
        return
    print_measured(output.console(), done, law)
    if save is not None:
        typer.echo(f"Ball: {save}; now: stackbounce simulate {save}")
    output.print_files(plot)


def _has_bounces(path: Path) -> bool:
    """Return whether a file is a table for `stackbounce fit`."""
    try:
        from stackbounce.fitting.series import read_table

        read_table(path)
    except StackbounceError:
        return False
    return True


def _wording(hint: OptionHint) -> str:
    """Return the options of a hint as they are typed, with the whole command if it names a file."""
    known = {option.name: option.on_command_line for option in OPTIONS}
    typed = []
    for name, value in hint.options.items():
        columns = value.items() if isinstance(value, Mapping) else ()
        texts = [f"{column}={role}" for column, role in columns] or [value]
        words = ("" if text is None else f" {shlex.quote(str(text))}" for text in texts)
        typed += [known[name] + word for word in words]
    if hint.file:
        return " ".join(["stackbounce measure", shlex.quote(hint.file), *typed])
    all_names = all(value is None for value in hint.options.values())
    return (", " if all_names else " ").join(typed)
