"""The command ``stackbounce fit``."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from stackbounce.cli import output, series
from stackbounce.cli.options import DROP
from stackbounce.errors import InvalidValue
from stackbounce.extras import MEASURING, need

if TYPE_CHECKING:
    from stackbounce.cli.fit_tables import Fitted
    from stackbounce.fitting import Comparison, FitProblem
    from stackbounce.fitting.series import StackTable


def run(
    what: Sequence[str], plot: Path | None, overwrite: bool, as_json: bool, **given: Any
) -> None:
    """Fit parameters of a drop to measured values, with errors."""
    need("stackbounce fit", *MEASURING)
    output.check_picture(plot, overwrite)
    table = series.is_series(what)
    stack = series.stack_of(what[0], given) if table else None
    if table and stack is None:
        series.fit_series(what[0], plot, overwrite, as_json, given)
        return
    _check_of_drop(given, () if stack is None else ("error",))
    from stackbounce.cli import fit_files, fit_tables
    from stackbounce.fitting.question import build_problem
    from stackbounce.fitting.standard import calibration_speed, usual_model

    save, draws, corner = given["save"], given["draws"], given["corner"]
    output.check_picture(corner, overwrite, "--corner")
    _check_together(given)
    parts = fit_files.read_parts_of(what, {name: given[name] for name in DROP}, stack)
    question = {name: given[name] for name in ("data", "measured", "vary", "tie")}
    usual = stack is not None and not given["vary"]
    problem = build_problem(parts, **question, compared=given["compare"] or usual)
    if usual and not given["compare"]:
        problem = usual_model(problem)
    if given["compare"]:
        compared, speed = _compare(problem, given), calibration_speed(problem.drops)
        output.draw_picture(plot, overwrite, "compared", compared)
        if as_json:
            output.print_json({**compared.as_dict(), "calibration_speed": speed})
        else:
            fit_tables.print_comparison(output.console(), compared, speed)
            _print_end(compared, stack, given, plot)
        return
    fit_files.check_save(save, overwrite, problem, what)
    fit_files.check_save(draws, overwrite, problem, what, "--draws", ".csv")
    done = _fit(problem, given, as_json)
    output.draw_picture(plot, overwrite, "fitted", done.fit)
    output.draw_picture(corner, overwrite, "corner", done.posterior)
    saved = fit_files.save(done.fit, save, overwrite)
    drawn = fit_files.save(done.fit, draws, overwrite, done.posterior)
    if as_json:
        output.print_json(fit_tables.as_dict(done, saved, drawn))
        return
    fit_tables.print_fit(output.console(), done)
    if saved:
        typer.echo(f"Fitted: {save}; now: stackbounce simulate {saved[0]}")
    if drawn:
        typer.echo(f"Draws: {draws}; now: stackbounce sweep … --draws {drawn[0]}")
    _print_end(done.fit, stack, given, plot, corner)


def _print_end(
    found: Any, stack: "StackTable | None", given: Mapping[str, Any], *pictures: Path | None
) -> None:
    """Print the notes on a stack's table, the files of pictures, and how to cite what was found."""
    for note in stack.notes if stack else ():
        output.console().print(f"Note: {note}")
    output.print_files(*pictures)
    series.print_citation(given["cite"], found)


def _check_of_drop(given: Mapping[str, Any], allowed: Sequence[str]) -> None:
    """Refuse options that are of a table of bounces."""
    for name in ("error", "mass", "diameter", "out"):
        if given[name] is not None and name not in allowed:
            raise InvalidValue(f"--{name} is of a table of bounces, such as heights.csv")


def _check_together(given: Mapping[str, Any]) -> None:
    """Refuse options that mean nothing without another one, or beside it."""
    if given["sample"] is not None:
        need("--sample", "emcee")
    if given["corner"] is not None:
        need("--corner", "corner")
    for name, does in (("corner", "draws the posterior"), ("draws", "writes the draws")):
        if given["sample"] is None and given[name] is not None:
            raise InvalidValue(f"--{name} {does} of --sample: give both")
    for name in ("vary", "tie", "interval", "sample", "save"):
        if given["compare"] and given[name]:
            raise InvalidValue(f"--compare has models of its own: --{name} is for one fit")


def _fit(problem: "FitProblem", given: Mapping[str, Any], as_json: bool) -> "Fitted":
    """Make the fit, with intervals and draws if they are asked for.

    After Ctrl+C the fit is printed as far as it is made.
    """
    from stackbounce.cli.fit_tables import Fitted
    from stackbounce.fitting import Interrupted

    seed, intervals, posterior = given["seed"], None, None
    try:
        with output.progress_bar("trials") as progress:
            fit = problem.fit(starts=given["starts"], rng=seed, progress=progress)
        try:
            if given["interval"]:
                with output.progress_bar("trials of intervals") as progress:
                    intervals = fit.intervals(progress=progress)
            if given["sample"] is not None:
                with output.progress_bar("draws") as progress:
                    posterior = fit.sample(given["sample"], rng=seed, progress=progress)
        except KeyboardInterrupt as stopped:
            raise Interrupted(fit) from stopped
    except Interrupted as stopped:
        if as_json:
            output.print_json({"interrupted": str(stopped), "values": stopped.fit.best})
        else:
            typer.echo(f"Interrupted: {stopped}")
        raise
    return Fitted(fit, intervals, posterior)


def _compare(problem: "FitProblem", given: Mapping[str, Any]) -> "Comparison":
    """Fit the usual models to what was measured."""
    from stackbounce.fitting import compare, standard_models
    from stackbounce.fitting.question import has_times

    models = standard_models(problem.drops, times=any(map(has_times, problem.data.values())))
    search = {"starts": given["starts"], "rng": given["seed"]}
    with output.progress_bar("trials of a model") as progress:
        return compare(models, problem.data, **search, progress=progress)
