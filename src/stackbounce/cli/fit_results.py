"""Fits on the command line: the problem from arguments and files, tables and JSON of results."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.cli import scenario
from stackbounce.cli.draws import draws_text
from stackbounce.cli.output import check_file, progress_bar
from stackbounce.cli.tables import new_table, number
from stackbounce.cross2007.datasets import PREFIX, load_dataset
from stackbounce.errors import FileError, InvalidValue, nearest, shown
from stackbounce.files import check_own, check_place, write_file
from stackbounce.fitting import (
    Comparison,
    Fit,
    FitProblem,
    Interrupted,
    Interval,
    Posterior,
    compare,
    read_drops,
    standard_models,
)
from stackbounce.fitting.files import Parts, convert_measured, read_parts
from stackbounce.fitting.notes import describe_freedom
from stackbounce.fitting.quantities import QUANTITIES
from stackbounce.run.paths import numbers_of
from stackbounce.units import handy, rounded

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

__all__ = [
    "Fitted",
    "as_dict",
    "check_save",
    "compare_models",
    "comparison_as_dict",
    "print_comparison",
    "print_fit",
    "read_problem",
    "run",
    "save",
    "save_draws",
]

_STRONG = 0.5  # a correlation above it is printed
_QUANTILES = (0.159, 0.5, 0.841)
_CRITERIA = {"aicc": "AICc", "bic": "BIC"}
_MANY = 8  # more data are not printed in a column each


@dataclass(frozen=True)
class Fitted:
    """A fit, with intervals and draws if they were asked for."""

    fit: Fit
    intervals: dict[str, Interval] | None
    posterior: Posterior | None


def read_problem(
    what: Sequence[str],
    *,
    data: Path | None = None,
    measured: Sequence[str] | None = None,
    vary: Sequence[str] | None = None,
    tie: Sequence[str] | None = None,
    compared: bool = False,
    **changes: Any,
) -> FitProblem:
    """Return the fit problem of the arguments: that of a file or a drop, changed by options.

    With `compared`, nothing has to vary: each of the models has its own parameters.
    """
    parts = _read_parts(what, changes)
    if data is not None:
        if set(parts.drops) != {""} or parts.data:
            raise InvalidValue(
                "--data has drops and what was measured of them: the file must have one drop and "
                "nothing measured"
            )
        drops, rows = read_drops(parts.drops[""], data)
        parts = parts._replace(drops=drops, data=rows)
    found = {key: dict(one) for key, one in parts.data.items()}
    for name, value in _pairs(measured, "--measured", "NAME=VALUE"):
        key, own = _own_name(parts, name)
        found.setdefault(key, {})[own] = convert_measured(own, value, Path())
    if not found:
        raise InvalidValue(
            "nothing was measured: give --measured 'rebound_ratios.1=1.64 ± 0.02', --data "
            "drops.csv, or [measured] in the file"
        )
    if compared:
        return FitProblem(parts.drops, found)
    varied = parts.vary | dict(_pairs(vary, "--vary", "PATH=BOUNDS", alone=True))
    tied = parts.tie | dict(_pairs(tie, "--tie", "PATH=FORMULA"))
    if not varied:
        paths = dict.fromkeys(path for drop in parts.drops.values() for path in numbers_of(drop))
        raise InvalidValue(
            "nothing is to vary: give --vary 'contacts.0.stiffness=1kN/m:1MN/m' or [vary] in the "
            f"file; {nearest('', paths)}"
        )
    return FitProblem(parts.drops, found, varied, tied)


def _read_parts(what: Sequence[str], changes: dict[str, Any]) -> Parts:
    """Return the parts of a fit problem: from a data set, from a file, or a drop without data."""
    if len(what) == 1 and what[0].startswith(PREFIX) and not Path(what[0]).exists():
        drop, data, vary, _ = load_dataset(what[0])
        return Parts({"": scenario.change(drop, **changes)}, {"": data}, vary, {})
    if len(what) == 1 and scenario.is_file(what[0]):
        parts = read_parts(what[0])
        drops = {key: scenario.change(drop, **changes) for key, drop in parts.drops.items()}
        return parts._replace(drops=drops)
    return Parts({"": scenario.read(what, **changes).drop}, {}, {}, {})


def _pairs(
    texts: Sequence[str] | None, option: str, right: str, *, alone: bool = False
) -> list[tuple[str, Any]]:
    """Return the ``NAME=VALUE`` texts of an option; a name alone, if allowed, has None."""
    found: list[tuple[str, Any]] = []
    for text in texts or ():
        name, equals, value = (part.strip() for part in text.partition("="))
        if not name or not (value or (alone and not equals)):
            raise InvalidValue(f"{option} must be {right}, got {shown(text)}")
        if name in (other for other, _ in found):
            raise InvalidValue(f"{option} must name each number once, got {name} twice")
        found.append((name, value or None))
    return found


def _own_name(parts: Parts, name: str) -> tuple[str, str]:
    """Split a measured number's name into its drop's name (empty for a single one) and the rest."""
    if "" in parts.drops:
        return "", name
    key, _, own = name.partition(".")
    if key not in parts.drops:
        right = f"DROP.NAME, such as {next(iter(parts.drops))}.rebound_ratios.1"
        raise InvalidValue(f"--measured must be {right}, got {name}; {nearest(key, parts.drops)}")
    return key, own


def run(
    problem: FitProblem, *, starts: int | None, seed: int, interval: bool, sample: int | None
) -> Fitted:
    """Make the fit, with intervals and draws if they are asked for.

    Raises
    ------
    Interrupted
        After Ctrl+C; it has the fit as far as it is made.
    """
    intervals = drawn = None
    with progress_bar("trials") as progress:
        found = problem.fit(starts=starts, seed=seed, progress=progress)
    try:
        if interval:
            with progress_bar("trials of intervals") as progress:
                intervals = found.intervals(progress=progress)
        if sample is not None:
            with progress_bar("draws") as progress:
                drawn = found.sample(sample, seed=seed, progress=progress)
    except KeyboardInterrupt as stopped:
        raise Interrupted(found) from stopped
    return Fitted(found, intervals, drawn)


def check_save(
    path: Path | None,
    overwrite: bool,
    problem: FitProblem,
    read: Sequence[str],
    option: str = "--save",
    suffix: str = ".toml",
) -> None:
    """Refuse a path for --save or --draws that cannot be written, before anything is computed."""
    if path is None or len(problem.drops) == 1:
        check_file(path, overwrite, option, suffix, read)
    elif path.suffix or (path.exists() and not path.is_dir()):
        raise InvalidValue(
            f"{option} must name a folder for {len(problem.drops)} drops, a file each, got {path}"
        )
    else:
        check_place(path)
        for name in problem.drops:
            check_own(path / f"{name}{suffix}", overwrite, read)


def save(done: Fitted, path: Path | None, overwrite: bool) -> list[Path]:
    """Write the fitted drop into a file, or several into a folder, and return the files."""
    texts = {key: drop.to_toml() for key, drop in done.fit.drops.items()} if path else {}
    return _write_each(texts, path, ".toml", overwrite)


def save_draws(done: Fitted, path: Path | None, overwrite: bool) -> list[Path]:
    """Write the draws of the drop into a file, of several into a folder, and return the files."""
    if path is None or done.posterior is None:
        return []
    drops = done.fit.drops
    texts = {key: draws_text(drops[key], done.fit.draws(done.posterior, key)) for key in drops}
    return _write_each(texts, path, ".csv", overwrite)


def _write_each(
    texts: Mapping[str, str], path: Path | None, suffix: str, overwrite: bool
) -> list[Path]:
    """Write one text into a file, or several into a folder by their names."""
    if path is None:
        return []
    files = dict.fromkeys([path], next(iter(texts.values())))
    if len(texts) > 1:
        try:
            path.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(f"{path} cannot be written: {error.strerror or error}") from error
        files = {path / f"{name}{suffix}": text for name, text in texts.items()}
    for file, text in files.items():
        write_file(file, text.encode(), overwrite)
    return list(files)


def as_dict(done: Fitted, saved: Sequence[Path], drawn_files: Sequence[Path]) -> dict[str, Any]:
    """Return the results for --json."""
    found, intervals, drawn = done.fit, done.intervals, done.posterior
    return {
        **found.as_dict(),
        "records": [
            {"drop": one.drop, "name": one.name, "samples": len(one.times), "scatter": one.scatter}
            for one in found.records
        ],
        "intervals": intervals and {name: one._asdict() for name, one in intervals.items()},
        "posterior": drawn
        and {
            "draws": drawn.log_probability.size,
            "seed": drawn.seed,
            "acceptance": drawn.acceptance,
            "notes": list(drawn.notes),
            "values": {name: _drawn(drawn, name) for name in drawn.names},
        },
        "saved": list(saved),
        "draws": list(drawn_files),
    }


def print_fit(console: "Console", done: Fitted) -> None:
    """Print the results of a fit."""
    found = done.fit
    console.print(_tabulate_parameters(done))
    if found.residuals:
        console.print()
        console.print(_tabulate_residuals(found))
    for one in found.records:
        words = f"{len(one.times)} samples scatter by {one.scatter:.3g} of their error"
        console.print(f"  {one.label}: {words} around the fitted curve")
    console.print(f"\n{_describe_goodness(found)}")
    pairs = _list_correlations(found)
    if pairs:
        console.print("Correlations: " + "; ".join(pairs))
    if done.posterior is not None:
        console.print(_describe_draws(done.posterior))
    notes = found.notes + (done.posterior.notes if done.posterior else ())
    for note in notes:
        console.print(f"Note: {note}.")


def _drawn(drawn: Posterior, name: str) -> dict[str, Any]:
    return {
        "mean": drawn[name].nominal_value,
        "deviation": drawn[name].std_dev,
        "quantiles": dict(
            zip(map(str, _QUANTILES), drawn.quantiles(name, _QUANTILES), strict=True)
        ),
        "autocorrelation": drawn.autocorrelation[name],
        "unit": drawn.units[name],
    }


def _tabulate_parameters(done: Fitted) -> "Table":
    """Return the table of the parameters."""
    headings = ["\nvalue", "\nerror"]
    headings += ["interval\nfrom", "\nto"] if done.intervals else []
    headings += ["draws\n15.9 %", "\n50 %", "\n84.1 %"] if done.posterior else []
    table = new_table(None, ["\nVaried"], headings)
    table.add_column("\nunit")
    for name, one in done.fit.values.items():
        interval = done.intervals[name][:2] if done.intervals else ()
        drawn = done.posterior.quantiles(name, _QUANTILES).tolist() if done.posterior else []
        values = [one.nominal_value, one.std_dev, *interval, *drawn]
        errors = [one.std_dev, *(abs(end - values[0]) for end in interval), *np.diff(drawn)]
        # the smallest error sets the decimals, unless it is nearly 0
        least = min((error for error in errors if error > 0.01 * errors[0]), default=errors[0])
        unit, factor = handy(max(map(abs, values)), done.fit.units[name])
        texts = rounded([factor * value for value in values], factor * least)
        if done.intervals:
            for k in (2, 3):
                texts[k] += " (bound)" if done.intervals[name][k] else ""
        table.add_row(name, *texts, unit)
    return table


def _tabulate_residuals(found: Fit) -> "Table":
    headings = ("\nvalue", "\nerror", "\nfitted", "off by\nerrors")
    table = new_table(None, ["\nMeasured"], headings)
    table.add_column("\nunit")
    most: dict[str, float] = {}
    for one in found.residuals:
        most[one.name] = max(most.get(one.name, 0.0), abs(one.measured), one.error)
    for one in found.residuals:
        unit, factor = handy(most[one.name], one.unit)
        numbers = [factor * value for value in (one.measured, one.error, one.fitted)]
        table.add_row(one.label, *rounded(numbers, factor * one.error), f"{one.pull:+.2f}", unit)
    return table


def _describe_goodness(found: Fit) -> str:
    """Return chi squared in words."""
    count = found.degrees_of_freedom
    words = f"Chi squared: {number(found.chi_squared)} for {describe_freedom(count)}"
    if not count:
        return f"{words}: too few data to tell whether the model is right."
    share = 100.0 * found.probability
    often = f"{share:.2g} %" if share >= 0.01 else "less than 0.01 %"
    return f"{words}; were the model right, it would be larger in {often} of all cases."


def _describe_draws(drawn: Posterior) -> str:
    """Return the quality of the draws in words."""
    longest = max(drawn.autocorrelation.values())
    return (
        f"Draws: {drawn.log_probability.size} kept; {drawn.acceptance:.0%} of the steps were "
        f"accepted, and the autocorrelation time is {longest:.0f} steps."
    )


def _list_correlations(found: Fit) -> list[str]:
    matrix, names = found.correlations.values, found.names
    return [
        f"{names[i]} and {names[j]} {matrix[i, j]:+.2f}"
        for i, j in np.argwhere(np.triu(np.abs(matrix) > _STRONG, 1))
    ]


def compare_models(problem: FitProblem, *, starts: int | None, seed: int) -> Comparison:
    """Fit the usual models to what was measured."""
    timed = any(_is_timed(one) for one in problem.data.values())
    models = standard_models(problem.drops, times=timed)
    with progress_bar("trials of a model") as progress:
        return compare(models, problem.data, starts=starts, seed=seed, progress=progress)


def comparison_as_dict(done: Comparison) -> dict[str, Any]:
    """Return a comparison for --json, with the predictions of what is left out."""
    return {
        **done.as_dict(),
        "left_out": {
            name: [{**one._asdict(), "pull": one.pull} for one in rows]
            for name, rows in done.left_out.items()
        },
    }


def print_comparison(console: "Console", done: Comparison) -> None:
    """Print a comparison."""
    name = _CRITERIA[done.criterion]
    scores = (f"{name}\nabove best", "left out:\nscore")
    headings = ("\nnumbers", "chi\nsquared", "for\ndegrees", *scores)
    table = new_table(None, ["\nModel"], headings)
    best = getattr(done.scores[0], done.criterion)
    for score in done.scores:
        above = getattr(score, done.criterion) - best
        row = (score.parameters, number(score.chi_squared), score.degrees_of_freedom)
        criteria = (number(above), number(done.predictive(score.model)))
        table.add_row(score.model, *map(str, row), *criteria)
    console.print(table)
    console.print(
        f"\n{name} is chi squared plus a penalty for each fitted number: 10 above the best is "
        "hopeless. The score of what is left out says how well each measurement is predicted from "
        "all others: more is better."
    )
    _print_pulls(console, done)
    for model, reason in done.refused.items():
        console.print(f"Not fitted: {model}: {reason}.")
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")


def _print_pulls(console: "Console", done: Comparison) -> None:
    """Print the residuals of each model in standard errors, unless there are many data."""
    data = done.pulls.datum.values.tolist()
    if len(data) > _MANY:
        return
    headings = [datum.replace(".", ".\n", 1) for datum in data]
    table = new_table(None, ["Fitted less measured, in errors"], headings)
    for score in done.scores:
        row = done.pulls.sel(model=score.model).values
        table.add_row(score.model, *(f"{pull:+.1f}" for pull in row))
    console.print()
    console.print(table)


def _is_timed(data: Mapping[str, Any]) -> bool:
    """Return whether a time or a force record was measured."""
    names = [name.partition(".")[0] for name in data]
    timed = {"force"} | {name for name, one in QUANTITIES.items() if one.unit == "s"}
    return not timed.isdisjoint(names)
