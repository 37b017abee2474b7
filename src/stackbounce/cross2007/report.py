"""The whole paper, in the order of its text, and the files of `stackbounce paper` and its page."""

import itertools
import json
import re
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from stackbounce.cross2007 import (
    checks_basketball,
    checks_fits,
    checks_models,
    checks_superballs,
    figures_models,
    figures_records,
    tables,
)
from stackbounce.cross2007.bench import CLAIMS, PAPER, Bench, Data
from stackbounce.cross2007.checks import AGREES, DIFFERS, WITHIN_ERROR, Row, last_place, run_check
from stackbounce.cross2007.pages import data_uri, make_environment
from stackbounce.cross2007.style import Picture, data_of, render, use_style
from stackbounce.cross2007.tables import Table, make_table_one, make_table_two
from stackbounce.errors import one_of, shown
from stackbounce.extras import MEASURING, need
from stackbounce.files import prepare_folder, write_folder
from stackbounce.library_types import DataFrame
from stackbounce.shown import Shown
from stackbounce.version import __version__

_MODULES = (checks_models, checks_basketball, tables, checks_superballs, checks_fits)
COMPUTED = {name: compute for module in _MODULES for name, compute in module.COMPUTED.items()}
"""The function that computes each claim, by name."""

READINGS = {name: found for module in _MODULES for name, found in module.READINGS.items()}
"""The functions that compute the other readings of some claims, by name."""

FIGURES: dict[str, Callable[[Bench], Picture]] = {
    name.removeprefix("draw_figure_").replace("_", "-"): draw
    for module in (figures_models, figures_records)
    for name, draw in vars(module).items()
    if name.startswith("draw_figure_")
}
"""The functions that draw the figures, by the paper's number; 1 and 3 are sketches.

"8-hollow" is Fig. 8 with another model."""
_TABLES = {"I": make_table_one, "II": make_table_two}
_SIGNS = re.compile(r"(?i)^fig(ure|\.)?|^table|[()\s]")  # in "Fig. 4(a)", besides its name
_WIDE = 40  # letters of a cell in the text of the audit
_NAMES = ("index.html", "audit.csv", "audit.json")


@dataclass(frozen=True, repr=False)
class Audit(Shown):
    """The paper's numbers beside the computed ones; it shows the counts and what differs.

    Parameters
    ----------
    rows : tuple of Row
        A row per printed number, in the order of the paper.
    data : mapping of str to Input
        The inputs that it was computed from.
    """

    rows: tuple[Row, ...]
    data: Data

    @property
    def counts(self) -> dict[str, int]:
        """The number of rows with each verdict."""
        verdicts = [row.verdict for row in self.rows]
        return {verdict: verdicts.count(verdict) for verdict in (AGREES, WITHIN_ERROR, DIFFERS)}

    @property
    def table(self) -> DataFrame:
        """All rows by name, with the library calls and the inputs of each."""
        import pandas as pd

        return pd.DataFrame(map(_cells, self.rows)).set_index("id")

    def __repr__(self) -> str:
        """The counts, and what differs with the beginning of the reason."""
        rows = self._differing.to_string(float_format="{:.4g}".format, max_colwidth=_WIDE)
        return f"{self.counted}\n{rows}\nAll rows with all reasons: table"

    def _repr_html_(self) -> str:
        """The counts, and what differs with the reason, for a notebook."""
        import pandas as pd

        with pd.option_context("display.max_colwidth", None):
            rows = self._differing.to_html(float_format="{:.4g}".format)
        return f"<p>{self.counted}</p>{rows}"

    @property
    def counted(self) -> str:
        """The counts in a sentence."""
        counts = ", ".join(f"{verdict} {count}" for verdict, count in self.counts.items())
        return f"{len(self.rows)} numbers of the paper: {counts}"

    @property
    def _differing(self) -> DataFrame:
        rows = self.table.query("verdict == @DIFFERS").set_index("what")
        return rows[["printed", "computed", "unit", "reason"]]

    def as_dict(self) -> dict[str, Any]:
        """Return the audit as plain dicts, lists, strings and numbers, for JSON."""
        return {
            "paper": "R. Cross, Vertical bounce of two vertically aligned balls, "
            "Am. J. Phys. 75, 1009 (2007), doi:10.1119/1.2772286",
            "stackbounce": __version__,
            "counts": self.counts,
            "rows": [{**asdict(row), "explained": row.explained} for row in self.rows],
            "inputs": [asdict(number) for number in self.data.values()],
        }


def audit(data: Data = PAPER, progress: Callable[[str], None] = lambda _: None) -> Audit:
    """Return the audit of the paper.

    Parameters
    ----------
    data : mapping of str to Input, optional
        The input numbers, by default those of the paper.
    progress : callable, optional
        Receives a line of text for each step.

    Returns
    -------
    Audit
        It shows the counts and what differs; `table` is a pandas DataFrame of all rows.

    Raises
    ------
    MissingExtra
        If the extra `lab` is not installed.

    Examples
    --------
    >>> result = audit()
    >>> [row.verdict for row in result.rows if row.id == "II.ten_springs"]
    ['agrees']
    """
    need("the audit of the paper", *MEASURING)
    rows: list[Row] = []
    for _, section in itertools.groupby(CLAIMS.values(), lambda claim: claim.id.partition(".")[0]):
        claims = list(section)
        progress(f"audit of {claims[0].where}: {len(claims)} numbers")
        for claim in claims:
            readings = READINGS.get(claim.id, ())
            rows.append(run_check(claim, COMPUTED[claim.id], readings, data))
    return Audit(tuple(rows), data)


def figure(name: str | int, data: Data = PAPER) -> Picture:
    """Return a figure of the paper, recomputed, with its curves and the points of its text.

    Parameters
    ----------
    name : str or int
        As the paper has it: ``"4a"``, ``"Fig. 4(a)"``, ``"Figure 5"`` or ``5``. ``"8-hollow"`` is
        Fig. 8 with a hollow ball. Figs. 1 and 3 are sketches, which are not drawn.
    data : mapping of str to Input, optional
        The input numbers, by default those of the paper.

    Returns
    -------
    Picture
        It shows itself in a notebook. `picture` is matplotlib's Figure, whose `axes` take more
        curves. `data` are the curves with their units, an xarray Dataset; its variables `known_…`
        are what the paper's text gives: points, or lines across or along the figure. `table` has
        what the text reports beside what is computed here.

    Raises
    ------
    InvalidValue
        If there is no figure of that name; the message lists all.
    MissingExtra
        If the extra `lab` is not installed.

    Examples
    --------
    >>> found = figure("4a")
    >>> found.data.rebound_ratio.sel(ball=1, mass_ratio=10).round(3).item()
    1.127
    >>> found.data.known_rebound_ratio.values  # as the paper's text has them
    array([1.13, 1.19, 0.76])
    """
    need("a figure of the paper", *MEASURING, "matplotlib")
    short = _SIGNS.sub("", str(name)).lower()
    one_of(short, FIGURES, f"the paper has no figure {shown(name)}")
    bench = Bench(data)
    with use_style():
        found = FIGURES[short](bench)
    return replace(found, data=data_of(bench, short))


def table(name: str | int, data: Data = PAPER) -> Table:
    """Return a table of the paper, recomputed, with the errors carried through.

    Parameters
    ----------
    name : str or int
        ``"I"`` or ``"II"``, also ``"Table II"``.
    data : mapping of str to Input, optional
        The input numbers, by default those of the paper.

    Returns
    -------
    Table
        It shows itself in a notebook; `table` is a pandas DataFrame of texts.

    Raises
    ------
    InvalidValue
        If there is no table of that name.
    MissingExtra
        If the extra `lab` is not installed.

    Examples
    --------
    >>> table("II").table["e2"]["basketball"]
    '1.640±0.005'
    """
    need("a table of the paper", *MEASURING)
    short = _SIGNS.sub("", str(name)).upper()
    one_of(short, _TABLES, f"the paper has no table {shown(name)}")
    return _TABLES[short](Bench(data))


def write(
    out: Path, progress: Callable[[str], None] = lambda _: None, *, explorer: str | None = None
) -> Audit:
    """Recompute the paper and write the results to files.

    Parameters
    ----------
    out : Path
        A folder, which is made if it is missing. It receives ``index.html``, ``audit.csv``,
        ``audit.json``, ``figures/``, and ``stackbounce.sha256``, the digests of all of them.
        Existing files of these names are replaced after everything has been computed, and only if
        the digests there tell that `write` has written them. The same version always writes the
        same bytes.
    progress : callable, optional
        Receives a line of text for each step.
    explorer : str, optional
        The address of the explorer from the page, which then has a way back to it.

    Returns
    -------
    Audit

    Raises
    ------
    FileError
        If the folder cannot be made or written to, or a file in it is not one of `write`. This is
        found before anything is computed.
    """
    need("stackbounce paper", *MEASURING, "jinja2", "matplotlib")
    prepare_folder(out, [*_NAMES, *(f"figures/figure-{name}.svg" for name in FIGURES)])
    done = audit(PAPER, progress)
    files: dict[str, bytes] = {}
    drawn: list[tuple[Picture, str]] = []
    for name in FIGURES:
        progress(f"figure {name}")
        picture = figure(name)
        images = render(picture.picture)
        files |= {f"figures/figure-{picture.name}.{end}": data for end, data in images.items()}
        drawn.append((picture, data_uri(images["svg"])))
    progress("tables I and II")
    tables = [table(name) for name in _TABLES]
    progress(f"writing to {out}")
    files["audit.csv"] = done.table.to_csv().encode()
    files["audit.json"] = _json(done, [picture for picture, _ in drawn], tables).encode()
    files["index.html"] = _page(done, drawn, tables, explorer).encode()
    write_folder(out, files)
    return done


def _json(done: Audit, drawn: list[Picture], tables: list[Table]) -> str:
    content = done.as_dict()
    told = ("name", "caption", "guesses", "features")
    content["figures"] = [{key: getattr(picture, key) for key in told} for picture in drawn]
    content["tables"] = [vars(table) for table in tables]
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def _cells(row: Row) -> dict[str, Any]:
    """Return a row of the audit by the columns of its table."""
    readings = [
        f"{attempt.reading}: {attempt.computed:.6g} ({attempt.verdict})" for attempt in row.attempts
    ]
    names = ("id", "where", "what", "printed", "unit", "computed", "tolerance", "error")
    return {
        **{name: getattr(row, name) for name in (*names, "verdict", "reason")},
        "other readings": "; ".join(readings),
        "computed by": row.source,
        "library calls": "; ".join(row.calls),
        "inputs": "; ".join(row.inputs),
    }


def _page(
    done: Audit, drawn: list[tuple[Picture, str]], tables: list[Table], explorer: str | None
) -> str:
    pages = make_environment()
    pages.filters["digits"] = _digits
    pages.filters["groupby_reason"] = _by_reason
    return pages.get_template("paper.html.j2").render(
        audit=done,
        figures=drawn,
        tables=tables,
        version=__version__,
        total=len(done.rows),
        explorer=explorer,
    )


def _by_reason(rows: Iterable[Row]) -> list[list[Row]]:
    """Group consecutive rows with the same reason."""
    return [list(group) for _, group in itertools.groupby(rows, key=lambda row: row.reason)]


def _digits(value: float, row: Row, number: str = "") -> str:
    """Format a computed number with two digits more than the printed one, a count without any."""
    if row.tolerance == 0.0:
        return f"{value:.0f}"
    return f"{value:.{max(0, 2 - last_place(number or row.digits))}f}"
