"""``stackbounce fit``: a question from files and options, the answer in tables and files."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.cli import scenario
from stackbounce.cli.output import check_scenario, new_table, progress_bar, write_scenario
from stackbounce.cli.tables import number
from stackbounce.cross2007.datasets import PREFIX, load_dataset
from stackbounce.errors import FileError, InvalidValue, nearest, shown
from stackbounce.fitting import Fit, Interval, Posterior, Question, read_drops, read_question
from stackbounce.fitting.files import typed
from stackbounce.run.paths import numbers_of
from stackbounce.units import handy, rounded

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.table import Table

__all__ = [
    "Fitted",
    "check_save",
    "picture",
    "posterior",
    "question",
    "run",
    "save",
    "summary",
    "tell",
]

_STRONG = 0.5  # a correlation that is told
_QUANTILES = (0.159, 0.5, 0.841)


@dataclass(frozen=True)
class Fitted:
    """A fit, and what else was asked for: intervals, draws."""

    fit: Fit
    intervals: dict[str, Interval] | None
    posterior: Posterior | None


def question(
    what: Sequence[str],
    *,
    data: Path | None,
    measured: Sequence[str],
    vary: Sequence[str],
    tie: Sequence[str],
    compared: bool = False,
    **changes: Any,
) -> Question:
    """Return what the arguments ask: a file's question or a drop, with the options put in.

    What is `compared` needs nothing to vary: each model has numbers of its own.
    """
    asked = _asked(what, changes)
    if data is not None:
        if set(asked.drops) != {""} or asked.data:
            raise InvalidValue(
                "--data tells drops and what was measured of them: the file must have one drop and "
                "nothing measured"
            )
        asked = replace(asked, **dict(zip(("drops", "data"), _table(asked, data), strict=True)))
    found = {key: dict(one) for key, one in asked.data.items()}
    for name, value in _pairs(measured, "--measured", "NAME=VALUE"):
        key, own = _own_name(asked, name)
        found.setdefault(key, {})[own] = typed(own, value, Path())
    varied = dict(asked.vary) | dict(_pairs(vary, "--vary", "PATH=BOUNDS", alone=True))
    tied = dict(asked.tie or {}) | dict(_pairs(tie, "--tie", "PATH=FORMULA"))
    if not found:
        raise InvalidValue(
            "nothing was measured: give --measured 'rebound_ratios.1=1.64 ± 0.02', --data "
            "drops.csv, or [measured] in the file"
        )
    if not varied and not compared:
        paths = dict.fromkeys(path for drop in asked.drops.values() for path in numbers_of(drop))
        raise InvalidValue(
            "nothing is to vary: give --vary 'contacts.0.stiffness=1kN/m:1MN/m' or [vary] in the "
            f"file; {nearest('', paths)}"
        )
    return Question(asked.drops, found, varied, tied)


def run(
    asked: Question, *, starts: int | None, seed: int, interval: bool, sample: int | None
) -> Fitted:
    """Fit, and find what else is asked for."""
    found = asked.fit(starts=starts, seed=seed)
    intervals = found.intervals() if interval else None
    if sample is None:
        return Fitted(found, intervals, None)
    with progress_bar("draws") as progress:
        drawn = found.sample(sample, seed=seed, progress=progress)
    return Fitted(found, intervals, drawn)


def picture(done: Fitted) -> "Figure":
    """Return the picture of a fit."""
    from stackbounce import plots

    return plots.fitted(done.fit)


def posterior(done: Fitted) -> "Figure":
    """Return the picture of the draws."""
    from stackbounce import plots

    return plots.corner(done.posterior)


def check_save(path: Path, asked: Question) -> None:
    """Refuse to save what could not be written, before anything is computed."""
    if len(asked.drops) == 1:
        check_scenario(path)
    elif path.suffix or (path.exists() and not path.is_dir()):
        raise InvalidValue(
            f"--save must name a folder for {len(asked.drops)} drops, a file each, got {path}"
        )
    elif not path.parent.is_dir():
        raise FileError(f"{path} cannot be written: there is no folder {path.parent}")


def save(done: Fitted, path: Path) -> list[Path]:
    """Write the fitted drop into a file, or several into a folder, and return the files."""
    drops = done.fit.drops
    files = {path: next(iter(drops.values()))}
    if len(drops) > 1:
        try:
            path.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(f"{path} cannot be written: {error.strerror or error}") from error
        files = {path / f"{name}.toml": drop for name, drop in drops.items()}
    for file, drop in files.items():
        write_scenario(drop.to_toml(), file)
    return list(files)


def summary(done: Fitted, saved: Sequence[Path]) -> dict[str, Any]:
    """Return what was found, for machines."""
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
            "draws": drawn.chain.shape[0] * drawn.chain.shape[1],
            "seed": drawn.seed,
            "acceptance": drawn.acceptance,
            "notes": list(drawn.notes),
            "values": {name: _drawn(drawn, name) for name in drawn.names},
        },
        "saved": list(saved),
    }


def tell(console: "Console", done: Fitted) -> None:
    """Print what was found, for people."""
    found = done.fit
    console.print(_parameters(done))
    if found.residuals:
        console.print()
        console.print(_residuals(found))
    for one in found.records:
        name = f"{one.drop}.{one.name}" if one.drop else one.name
        words = f"{len(one.times)} samples scatter by {one.scatter:.3g} of their error"
        console.print(f"  {name}: {words} around the fitted curve")
    console.print(f"\n{_goodness(found)}")
    pairs = _strong(found)
    if pairs:
        console.print("Correlations: " + "; ".join(pairs))
    if done.posterior is not None:
        console.print(_draws(done.posterior))
    notes = found.notes + (done.posterior.notes if done.posterior else ())
    for note in notes:
        console.print(f"Note: {note}.")


def _asked(what: Sequence[str], changes: dict[str, Any]) -> Question:
    """Return the question of a data set or file, or one drop of which nothing is asked yet."""
    if len(what) == 1 and what[0].startswith(PREFIX) and not Path(what[0]).exists():
        drop, data, vary, _ = load_dataset(what[0])
        return Question({"": scenario.change(drop, **changes)}, {"": data}, vary, {})
    if len(what) == 1 and scenario.is_file(what[0]):
        asked = read_question(what[0])
        changed = {key: scenario.change(drop, **changes) for key, drop in asked.drops.items()}
        return replace(asked, drops=changed)
    return Question({"": scenario.read(what, **changes).drop}, {}, {}, {})


def _table(asked: Question, data: Path) -> tuple[Any, Any]:
    return read_drops(next(iter(asked.drops.values())), data)


def _pairs(
    texts: Sequence[str], option: str, right: str, *, alone: bool = False
) -> list[tuple[str, Any]]:
    """Return the ``NAME=VALUE`` texts of an option; None for a name alone, where that may be."""
    found: list[tuple[str, Any]] = []
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not name or not (value or (alone and not equals)):
            raise InvalidValue(f"{option} must be {right}, got {shown(text)}")
        if name in (other for other, _ in found):
            raise InvalidValue(f"{option} must name each number once, got {name} twice")
        found.append((name, value or None))
    return found


def _own_name(asked: Question, name: str) -> tuple[str, str]:
    """Return which drop a measured number belongs to, and its name there."""
    if "" in asked.drops:
        return "", name
    key, _, own = name.partition(".")
    if key not in asked.drops:
        right = f"DROP.NAME, such as {next(iter(asked.drops))}.rebound_ratios.1"
        raise InvalidValue(f"--measured must be {right}, got {name}; {nearest(key, asked.drops)}")
    return key, own


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


def _parameters(done: Fitted) -> "Table":
    """Return the table of what was varied."""
    table = new_table("\nVaried")
    headings = ["\nvalue", "\nerror"]
    headings += ["interval\nfrom", "\nto"] if done.intervals else []
    headings += ["draws\n15.9 %", "\n50 %", "\n84.1 %"] if done.posterior else []
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("\nunit")
    for name, one in done.fit.values.items():
        values = [one.nominal_value, one.std_dev]
        if done.intervals:
            values += done.intervals[name][:2]
        if done.posterior:
            values += done.posterior.quantiles(name, _QUANTILES).tolist()
        unit, factor = handy(max(map(abs, values)), done.fit.units[name])
        texts = rounded([factor * value for value in values], factor * _least(done, name))
        if done.intervals:
            for k in (2, 3):
                texts[k] += " (bound)" if done.intervals[name][k] else ""
        table.add_row(name, *texts, unit)
    return table


def _least(done: Fitted, name: str) -> float:
    """Return the smallest error that is told of a number: it says how many digits count."""
    value = done.fit[name]
    errors: list[float] = [value.std_dev]
    if done.intervals:
        errors += [abs(end - value.nominal_value) for end in done.intervals[name][:2]]
    if done.posterior:
        errors += np.diff(done.posterior.quantiles(name, _QUANTILES)).tolist()
    return min((one for one in errors if one > 0.01 * errors[0]), default=errors[0])


def _residuals(found: Fit) -> "Table":
    table = new_table("\nMeasured")
    for heading in ("\nvalue", "\nerror", "\nfitted", "off by\nerrors"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("\nunit")
    most: dict[str, float] = {}
    for one in found.residuals:
        most[one.name] = max(most.get(one.name, 0.0), abs(one.measured), one.error)
    for one in found.residuals:
        unit, factor = handy(most[one.name], one.unit)
        numbers = [factor * value for value in (one.measured, one.error, one.fitted)]
        name = f"{one.drop}.{one.name}" if one.drop else one.name
        table.add_row(name, *rounded(numbers, factor * one.error), f"{one.pull:+.2f}", unit)
    return table


def _goodness(found: Fit) -> str:
    """Return chi squared in words."""
    count = found.degrees_of_freedom
    freedom = f"{count} degree{'' if count == 1 else 's'} of freedom"
    words = f"Chi squared: {number(found.chi_squared)} for {freedom}"
    if not count:
        return f"{words}: nothing is left to tell whether the model is right."
    share = 100.0 * found.probability
    often = f"{share:.2g} %" if share >= 0.01 else "less than 0.01 %"
    return f"{words}; were the model right, it would be larger in {often} of all cases."


def _draws(drawn: Posterior) -> str:
    """Return how good some draws are, in words."""
    count, longest = (
        drawn.chain.shape[0] * drawn.chain.shape[1],
        max(drawn.autocorrelation.values()),
    )
    return (
        f"Draws: {count} kept; {drawn.acceptance:.0%} of the steps were taken, and a walker "
        f"forgets where it was after {longest:.0f} of them."
    )


def _strong(found: Fit) -> list[str]:
    matrix, names = found.correlations.values, found.names
    return [
        f"{names[i]} and {names[j]} {matrix[i, j]:+.2f}"
        for i, j in np.argwhere(np.triu(np.abs(matrix) > _STRONG, 1))
    ]
