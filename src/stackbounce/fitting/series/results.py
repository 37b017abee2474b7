"""Tables and data sets beside the contact laws, and the page that says so."""

import json
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from stackbounce import datasets
from stackbounce.errors import InvalidValue
from stackbounce.extras import need
from stackbounce.files import prepare_folder, write_folder
from stackbounce.fitting.rows import File
from stackbounce.fitting.series.comparison import REFUTED_BELOW, Comparison, compare_laws, format_p
from stackbounce.fitting.series.series import make_series, why_not
from stackbounce.fitting.series.table import read_table
from stackbounce.json_values import plain
from stackbounce.library_types import DataFrame, Dataset
from stackbounce.model.laws import LAWS, law_named
from stackbounce.shown import Shown, Table
from stackbounce.version import __version__

_ONCE = "stackbounce measure --heights '1, 0.64, 0.65 m' --repeated takes one drop height"
PREFIX = "dataset:"
"""Begins the name of a published data set, in place of a file."""

_NAMES = ("index.html", "laws.csv", "laws.json")
_NO_WORD = re.compile(r"[^\w.-]+")  # in the name of a file
_OF_SERIES = ("name", "title", "ball", "drag", "speeds", "values")
_OF_COMPARISON = ("skipped", "tells_apart", "steady", "summary")


@dataclass(frozen=True, repr=False)
class SeriesFit(Shown):
    """What restitutions at several speeds say of the contact laws; made by `fit_series`.

    Parameters
    ----------
    comparisons : tuple of Comparison
        One for each ball, or data set, that has restitutions at several speeds.
    left_out : dict of str to str
        The others, and why.
    notes : tuple of str, optional
        What was assumed of the table or left out of it, a sentence each.
    """

    comparisons: tuple[Comparison, ...]
    left_out: dict[str, str]
    notes: tuple[str, ...] = ()

    @property
    def summary(self) -> str:
        """How many verdicts there are, and how many series rest on errors that are assumed."""
        verdicts = sum(len(found.outcomes) for found in self.comparisons)
        shaky = sum(not found.steady for found in self.comparisons)
        count = len(self.comparisons)
        return (
            f"{count} series {'has' if count == 1 else 'have'} {verdicts} verdicts; if all laws "
            f"were true, chance alone would refute {REFUTED_BELOW * verdicts:.1f} of them. "
            f"Half or twice the assumed errors change a verdict in {shaky} of the series."
        )

    @property
    def table(self) -> DataFrame:
        """The laws of each ball, the best first: restitution at the highest speed, χ², p."""
        import pandas as pd

        tables = {found.series.title: found.table for found in self.comparisons}
        return pd.concat(tables, names=["ball"]) if tables else pd.DataFrame()

    def _tables(self) -> Sequence[Table]:
        return [table for found in self.comparisons for table in found._tables()]

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain values, for JSON."""
        return {
            "stackbounce": __version__,
            "summary": self.summary,
            "series": [_as_dict(found) for found in self.comparisons],
            "left_out": self.left_out,
            "notes": list(self.notes),
        }


def fit_series(
    source: File,
    *,
    laws: Collection[str] | None = None,
    errors: Sequence[str] = (),
    mass: float | None = None,
    diameter: float | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> SeriesFit:
    r"""Fit contact laws to a table of bounces from several heights, or at several speeds.

    A law has one free number, the restitution at the highest speed of a series. It is fitted to all
    speeds, and judged by χ², with all errors and their correlations.

    Parameters
    ----------
    source : str or path-like, or (str, bytes)
        A table, as `read_table` reads it, or its name and content; or ``dataset:NAME``, a published
        data set, or ``dataset:all``.
    laws : collection of str, optional
        The names of the laws; by default all, your own with them.
    errors : sequence of str, optional
        Errors of numbers that have none, such as ``"5 mm"`` or ``"drop height = 2 mm"``.
    mass, diameter : float, optional
        Of the ball in kg and m: with both the drag of the air is corrected.
    progress : callable, optional
        Receives a line of text for each series.

    Returns
    -------
    SeriesFit

    Raises
    ------
    FileError
        If the table cannot be read.
    InvalidValue
        If it does not tell what it holds, a cell is wrong, or a law or a data set is unknown.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "heights.csv"
    >>> _ = path.write_text("drop height (cm),rebound height (cm)\n150,81.2\n100,54\n50,27.3\n")
    >>> (found,) = fit_series(path, laws=["Rigid"], errors=["5 mm"]).comparisons
    >>> [f"{limit:.3f}" for limit in found.outcomes[0].interval()]
    ['0.734', '0.738']
    """
    laws = [law_named(law).__name__ for law in (LAWS if laws is None else laws)]
    name = str(source)
    if not name.startswith(PREFIX):
        table = read_table(source, errors, mass=mass, diameter=diameter)
        done = _compared(table.groups, laws, progress, table.notes)
        if not done.comparisons:
            why = "; ".join(": ".join(filter(None, own)) for own in done.left_out.items())
            once = f"; {_ONCE}" if "one value" in why else ""
            raise InvalidValue(f"{table.name}: {why}{once}")
        return done
    if errors or mass or diameter:
        raise InvalidValue("a data set has errors, mass and diameter of its own")
    name = name.removeprefix(PREFIX)
    chosen = datasets.names() if name == "all" else (name,)
    return _compared({key: datasets.load(key) for key in chosen}, laws, progress)


def _compared(
    groups: Mapping[str, Dataset],
    laws: Collection[str],
    progress: Callable[[str], None],
    notes: tuple[str, ...] = (),
) -> SeriesFit:
    """Compare laws with each of some data sets that is a series."""
    found: list[Comparison] = []
    left_out: dict[str, str] = {}
    for name, data in groups.items():
        reason = why_not(data)
        if not reason:
            progress(name)
            series = make_series(data)
            without_air = make_series(data, air=False) if series.drag else None
            compared = compare_laws(series, without_air, laws)
            if compared.outcomes:
                found.append(compared)
                continue
            reason = "; ".join(map(": ".join, compared.skipped.items()))
        left_out[name] = reason
    return SeriesFit(tuple(found), left_out, notes)


def write(done: SeriesFit, out: Path) -> None:
    """Write a page and tables of what was found.

    Parameters
    ----------
    done : SeriesFit
        What was found.
    out : Path
        A folder, which is made if it is missing. It receives ``index.html``, ``laws.csv``,
        ``laws.json`` and ``figures/``. Existing files of these names are replaced after
        everything has been computed, and only if `write` has written them.

    Raises
    ------
    FileError
        If the folder cannot be made or written to, or a file in it is not one of `write`.
    """
    from stackbounce.plots import restitutions
    from stackbounce.plots.style import render

    need("the page of a comparison", "jinja2", "matplotlib")
    figures = {
        found.series.name: render(partial(restitutions, replace(done, comparisons=(found,))), "svg")
        for found in done.comparisons
    }
    files = {f"figures/{_NO_WORD.sub('_', name)}.svg": svg for name, svg in figures.items()}
    prepare_folder(out := Path(out), [*_NAMES, *files])
    files["laws.csv"] = _csv(done).encode()
    files["laws.json"] = (json.dumps(done.as_dict(), indent=1) + "\n").encode()
    files["index.html"] = _page(done, figures).encode()
    write_folder(out, files)


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
            {"law": name, **outcome.as_dict()}
            for outcome in comparison.outcomes
            for name in outcome.laws
        ],
    }
    found |= {name: getattr(comparison, name) for name in _OF_COMPARISON}
    plain_values: dict[str, Any] = plain(found)
    return plain_values


def _csv(done: SeriesFit) -> str:
    import pandas as pd

    rows = [
        {"dataset": found["name"], "ball": found["ball"], **law}
        for found in done.as_dict()["series"]
        for law in found["laws"]
    ]
    return str(pd.DataFrame(rows).to_csv(index=False, lineterminator="\n"))


def _page(done: SeriesFit, figures: dict[str, bytes]) -> str:
    import jinja2

    from stackbounce.cross2007.pages import data_uri, make_environment

    pages = make_environment().overlay(loader=jinja2.PackageLoader("stackbounce.fitting.series"))
    pages.filters["p"] = lambda value: "–" if value is None else format_p(value)
    return pages.get_template("laws.html.j2").render(
        done=done,
        about={name: datasets.describe(name) for name in figures if name in datasets.names()},
        figures={name: data_uri(picture) for name, picture in figures.items()},
        version=__version__,
    )
