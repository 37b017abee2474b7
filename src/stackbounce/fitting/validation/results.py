"""All datasets beside all laws, and the files of `stackbounce validate` that say so."""

import csv
import io
import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from stackbounce import datasets
from stackbounce.cross2007.pages import data_uri, make_environment
from stackbounce.extras import need
from stackbounce.files import prepare_folder, write_folder
from stackbounce.fitting.validation.comparison import (
    REFUTED_BELOW,
    Comparison,
    Outcome,
    compare_laws,
    format_p,
)
from stackbounce.fitting.validation.series import make_series, why_not
from stackbounce.json_values import plain
from stackbounce.version import __version__

_NAMES = ("index.html", "validation.csv", "validation.json")
_COLUMNS = (
    "law", "verdict", "p", "p_calibrated", "p_half", "p_twice", "p_without_air", "steady",
    "chi_squared", "freedom", "value", "error",
)  # fmt: skip
_OF_SERIES = ("name", "title", "ball", "drag", "speeds", "values")
_OF_COMPARISON = ("skipped", "tells_apart", "steady", "summary")


@dataclass(frozen=True)
class Validation:
    """What the published measurements say of the contact laws.

    Parameters
    ----------
    comparisons : tuple of Comparison
        One for each dataset that has restitutions at several speeds.
    left_out : dict of str to str
        The other datasets, and why.
    """

    comparisons: tuple[Comparison, ...]
    left_out: dict[str, str]

    @property
    def summary(self) -> str:
        """How many verdicts there are, and how many series rest on errors that are assumed."""
        verdicts = sum(len(found.outcomes) for found in self.comparisons)
        shaky = sum(not found.steady for found in self.comparisons)
        return (
            f"{len(self.comparisons)} series have {verdicts} verdicts; if all laws were true, "
            f"chance alone would refute {REFUTED_BELOW * verdicts:.1f} of them. {shaky} of the "
            "series are not steady: half or twice the assumed errors change a verdict."
        )

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain values."""
        return {
            "summary": self.summary,
            "datasets": [_as_dict(found) for found in self.comparisons],
            "left_out": self.left_out,
        }


def validate(progress: Callable[[str], None] = lambda _: None) -> Validation:
    """Compare each contact law with each published measurement that depends on the speed.

    Each law is calibrated at the highest speed of a series and asked for the others, and it is
    fitted to all of them. Both are judged by χ², with all errors and their correlations.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each dataset.

    Returns
    -------
    Validation
    """
    found: list[Comparison] = []
    left_out: dict[str, str] = {}
    for name in datasets.names():
        data = datasets.load(name)
        reason = why_not(data)
        if reason:
            left_out[name] = reason
            continue
        progress(name)
        series = make_series(data)
        without_air = make_series(data, air=False) if series.drag else None
        found.append(compare_laws(series, without_air))
    return Validation(tuple(found), left_out)


def write(out: Path, progress: Callable[[str], None] = lambda _: None) -> Validation:
    """Compare the laws with the published measurements, and write the results to files.

    Parameters
    ----------
    out : Path
        A folder, which is made if it is missing. It receives ``index.html``, ``validation.csv``,
        ``validation.json`` and ``figures/``. Existing files of these names are replaced after
        everything has been computed, and only if `write` has written them.
    progress : callable, optional
        Receives a line of text for each step.

    Returns
    -------
    Validation

    Raises
    ------
    FileError
        If the folder cannot be made or written to, or a file in it is not one of `write`.
    """
    from stackbounce.fitting.validation.figures import draw
    from stackbounce.plots.style import render

    need("paper", "stackbounce validate")
    prepare_folder(out, [*_NAMES, *(f"figures/{name}.svg" for name in datasets.names())])
    done = validate(progress)
    progress(f"writing to {out}")
    figures = {found.series.name: render(partial(draw, found), "svg") for found in done.comparisons}
    files = {f"figures/{name}.svg": picture for name, picture in figures.items()}
    files["validation.csv"] = _csv(done).encode()
    files["validation.json"] = (json.dumps(done.as_dict(), indent=1) + "\n").encode()
    files["index.html"] = _page(done, figures).encode()
    write_folder(out, files)
    return done


def _as_dict(comparison: Comparison) -> dict[str, Any]:
    series = comparison.series
    found = {name: getattr(series, name) for name in _OF_SERIES} | {
        "quantity": "restitution",
        "errors": [float(variance) ** 0.5 for variance in series.covariance().diagonal()],
        "assumed_errors": series.has_assumed_errors,
        "freedom_of_errors": series.freedom(),
        "exponent": comparison.exponent,
        "exponent_error": comparison.exponent_error,
        "p_power": comparison.p_power,
        "laws": [
            _law_as_dict(name, outcome) for outcome in comparison.outcomes for name in outcome.laws
        ],
    }
    plain_values: dict[str, Any] = plain(
        found | {name: getattr(comparison, name) for name in _OF_COMPARISON}
    )
    return plain_values


def _law_as_dict(name: str, outcome: Outcome) -> dict[str, Any]:
    numbers = {key: value for key, value in vars(outcome).items() if key != "laws"}
    return {"law": name} | numbers | {"verdict": outcome.verdict, "steady": outcome.steady}


def _csv(done: Validation) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(("dataset", "ball", "quantity", *_COLUMNS))
    for found in done.as_dict()["datasets"]:
        for law in found["laws"]:
            row = (law[key] for key in _COLUMNS)
            writer.writerow((found["name"], found["ball"], found["quantity"], *row))
    return stream.getvalue()


def _page(done: Validation, figures: dict[str, bytes]) -> str:
    import jinja2

    own = jinja2.PackageLoader("stackbounce.fitting.validation")
    pages = make_environment().overlay(loader=own)
    pages.filters["p"] = lambda value: "–" if value is None else format_p(value)
    return pages.get_template("validation.html.j2").render(
        done=done,
        about={name: datasets.describe(name) for name in datasets.names()},
        figures={name: data_uri(picture) for name, picture in figures.items()},
        version=__version__,
    )
