"""What ``stackbounce fit`` prints: tables of results for people, and JSON for machines."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table

from stackbounce.cli.tables import new_table, number, table_of
from stackbounce.fitting import Comparison, Fit, Interval, Posterior
from stackbounce.fitting.notes import describe_goodness
from stackbounce.units import handy, rounded

_STRONG = 0.5  # a correlation above it is printed
_QUANTILES = (0.159, 0.5, 0.841)
_OF_RECORD = ("drop", "name", "scatter")
_CRITERIA = {"aicc": "AICc", "bic": "BIC"}


class Fitted(NamedTuple):
    """A fit, with intervals and draws if they were asked for."""

    fit: Fit
    intervals: dict[str, Interval] | None
    posterior: Posterior | None


def as_dict(done: Fitted, saved: Sequence[Path], drawn_files: Sequence[Path]) -> dict[str, Any]:
    """Return the results for --json."""
    found, intervals = done.fit, done.intervals
    return {
        **found.as_dict(),
        "records": [
            {name: getattr(record, name) for name in _OF_RECORD} | {"samples": len(record.times)}
            for record in found.records
        ],
        "intervals": intervals and {name: ends._asdict() for name, ends in intervals.items()},
        "posterior": done.posterior and _posterior_as_dict(done.posterior),
        "saved": list(saved),
        "draws": list(drawn_files),
    }


def _posterior_as_dict(posterior: Posterior) -> dict[str, Any]:
    values = {}
    for name in posterior.names:
        quantiles = posterior.quantiles(name, _QUANTILES)
        values[name] = {
            "mean": posterior[name].nominal_value,
            "deviation": posterior[name].std_dev,
            "quantiles": dict(zip(map(str, _QUANTILES), quantiles, strict=True)),
            "autocorrelation": posterior.autocorrelation[name],
            "unit": posterior.units[name],
        }
    return {
        "draws": posterior.log_probability.size,
        "seed": posterior.seed,
        "acceptance": posterior.acceptance,
        "notes": list(posterior.notes),
        "values": values,
    }


def print_fit(console: Console, done: Fitted) -> None:
    """Print the results of a fit."""
    found, posterior = done.fit, done.posterior
    console.print(_tabulate_parameters(done))
    if found.residuals:
        console.print()
        console.print(_tabulate_residuals(found))
    for record in found.records:
        words = f"{len(record.times)} samples scatter by {record.scatter:.3g} of their error"
        console.print(f"  {record.label}: {words} around the fitted curve")
    console.print(f"\n{describe_goodness(found)}")
    matrix, names = found.correlations.values, found.names
    strong = [
        f"{names[i]} and {names[j]} {matrix[i, j]:+.2f}"
        for i, j in np.argwhere(np.triu(np.abs(matrix) > _STRONG, 1))
    ]
    if strong:
        console.print("Correlations: " + "; ".join(strong))
    if posterior is not None:
        longest = max(posterior.autocorrelation.values())
        console.print(
            f"Draws: {posterior.log_probability.size} kept; {posterior.acceptance:.0%} of the "
            f"steps were accepted, and the autocorrelation time is {longest:.0f} steps."
        )
    for note in found.notes + (posterior.notes if posterior else ()):
        console.print(f"Note: {note}.")


def _tabulate_parameters(done: Fitted) -> Table:
    """Return the table of the parameters."""
    headings = ["\nvalue", "\nerror"]
    headings += ["interval\nfrom", "\nto"] if done.intervals else []
    headings += ["draws\n15.9 %", "\n50 %", "\n84.1 %"] if done.posterior else []
    table = new_table(None, ["\nVaried"], headings)
    table.add_column("\nunit")
    for name, best in done.fit.values.items():
        interval = done.intervals[name][:2] if done.intervals else ()
        drawn = done.posterior.quantiles(name, _QUANTILES).tolist() if done.posterior else []
        values = [best.nominal_value, best.std_dev, *interval, *drawn]
        errors = [best.std_dev, *(abs(end - values[0]) for end in interval), *np.diff(drawn)]
        # the smallest error sets the decimals, unless it is nearly 0
        least = min((error for error in errors if error > 0.01 * errors[0]), default=errors[0])
        unit, factor = handy(max(map(abs, values)), done.fit.units[name])
        texts = rounded([factor * value for value in values], factor * least)
        if done.intervals:
            for k in (2, 3):
                texts[k] += " (bound)" if done.intervals[name][k] else ""
        table.add_row(name, *texts, unit)
    return table


def _tabulate_residuals(found: Fit) -> Table:
    table = new_table(None, ["\nMeasured"], ("\nvalue", "\nerror", "\nfitted", "off by\nerrors"))
    table.add_column("\nunit")
    most: dict[str, float] = {}
    for row in found.residuals:
        most[row.name] = max(most.get(row.name, 0.0), abs(row.measured), row.error)
    for row in found.residuals:
        unit, factor = handy(most[row.name], row.unit)
        numbers = [factor * value for value in (row.measured, row.error, row.fitted)]
        table.add_row(row.label, *rounded(numbers, factor * row.error), f"{row.pull:+.2f}", unit)
    return table


def print_comparison(console: Console, done: Comparison, speed: float) -> None:
    """Print a comparison of models that were calibrated at a speed in m/s."""
    name = _CRITERIA[done.criterion]
    other = "bic" if done.criterion == "aicc" else "aicc"
    shorter = {"probability": "p", "degrees_of_freedom": "degrees", "parameters": "numbers"}
    console.print(table_of(done.table.drop(columns=other).rename(columns=shorter)))
    console.print(
        "\nEach model has the same contacts in all drops. The search began with contacts that last "
        f"as long as yours at {number(speed)} m/s, the geometric mean of the impact speeds. "
        "p is the probability of a larger chi squared if the model is right. "
        f"{name} is chi squared plus a penalty for each fitted number: 10 above the best is "
        "hopeless."
    )
    for remark in done.remarks:
        console.print(remark)
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")
