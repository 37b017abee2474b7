"""The files of `stackbounce paper`: the audit, the figures, and one page with everything."""

import csv
import io
import itertools
import json
from collections.abc import Callable, Iterable
from pathlib import Path

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Row, last_place
from stackbounce.cross2007.data import PAPER
from stackbounce.cross2007.pages import data_uri, make_environment
from stackbounce.cross2007.paper import FIGURES, Audit, audit, draw_figures
from stackbounce.cross2007.playable import link_figures
from stackbounce.cross2007.style import Picture, render
from stackbounce.cross2007.tables import Table, make_table_one, make_table_two
from stackbounce.extras import need
from stackbounce.files import prepare_folder, write_folder
from stackbounce.version import __version__

_NAMES = ("index.html", "audit.csv", "audit.json")


def write(
    out: Path,
    progress: Callable[[str], None] = lambda _: None,
    *,
    explorer: str | None = None,
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
        The address of the explorer from the page. The page then has a way back to it, and links
        that play the drops of the figures. By default there are none: the page needs no server.

    Returns
    -------
    Audit

    Raises
    ------
    FileError
        If the folder cannot be made or written to, or a file in it is not one of `write`. This is
        found before anything is computed.
    """
    need("paper", "stackbounce paper")
    figures = [f"figures/figure-{name}.svg" for name in FIGURES]
    prepare_folder(out, [*_NAMES, *figures])
    done = audit(PAPER, progress)
    files: dict[str, bytes] = {}
    drawn: list[tuple[Picture, str]] = []
    for picture in draw_figures(PAPER, progress):
        images = render(picture.figure)
        files |= {f"figures/figure-{picture.name}.{end}": data for end, data in images.items()}
        drawn.append((picture, data_uri(images["svg"])))
    progress("tables I and II")
    tables = [make_table_one(Bench(PAPER)), make_table_two(Bench(PAPER))]
    progress(f"writing to {out}")
    files["audit.csv"] = _csv(done).encode()
    files["audit.json"] = _json(done, [picture for picture, _ in drawn], tables).encode()
    files["index.html"] = _page(done, drawn, tables, explorer).encode()
    write_folder(out, files)
    return done


def _json(done: Audit, drawn: list[Picture], tables: list[Table]) -> str:
    content = done.as_dict()
    content["figures"] = [
        {
            "name": picture.name,
            "caption": picture.caption,
            "guesses": picture.guesses,
            "features": [vars(feature) for feature in picture.features],
        }
        for picture in drawn
    ]
    content["tables"] = [vars(table) for table in tables]
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def _csv(done: Audit) -> str:
    stream = io.StringIO()
    rows = [_cells(row) for row in done.rows]
    writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return stream.getvalue()


def _cells(row: Row) -> dict[str, str]:
    """Return a row of the audit by the columns of ``audit.csv``."""
    readings = [
        f"{attempt.reading}: {attempt.computed:.6g} ({attempt.verdict})" for attempt in row.attempts
    ]
    names = ("id", "where", "what", "printed", "unit", "computed", "tolerance", "error")
    return {
        **{name: str(getattr(row, name)) for name in (*names, "verdict", "reason")},
        "other readings": "; ".join(readings),
        "computed by": row.source,
        "library calls": "; ".join(row.calls),
        "inputs": "; ".join(row.inputs),
    }


def _page(
    done: Audit,
    drawn: list[tuple[Picture, str]],
    tables: list[Table],
    explorer: str | None,
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
        links=link_figures(explorer) if explorer else {},
    )


def _by_reason(rows: Iterable[Row]) -> list[list[Row]]:
    """Group consecutive rows with the same reason."""
    return [list(group) for _, group in itertools.groupby(rows, key=lambda row: row.reason)]


def _digits(value: float, row: Row, number: str = "") -> str:
    """Format a computed number with two digits more than the printed one, a count without any."""
    if row.tolerance == 0.0:
        return f"{value:.0f}"
    return f"{value:.{max(0, 2 - last_place(number or row.digits))}f}"
