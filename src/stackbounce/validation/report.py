"""The files of `stackbounce validate`: a page, the figures, and the numbers as CSV and JSON."""

import csv
import io
import json
from collections.abc import Callable
from functools import partial
from pathlib import Path

from stackbounce.cross2007.pages import data_uri
from stackbounce.datasets import describe, names
from stackbounce.extras import need
from stackbounce.files import prepare_folder, write_folder
from stackbounce.plots.style import render
from stackbounce.validation.comparison import format_p
from stackbounce.validation.figures import draw
from stackbounce.validation.results import Validation, validate
from stackbounce.version import __version__

__all__ = ["write"]

_NAMES = ("index.html", "validation.csv", "validation.json")
_COLUMNS = (
    "law", "verdict", "p", "p_calibrated", "p_half", "p_twice", "p_without_air", "steady",
    "chi_squared", "freedom", "value", "error",
)  # fmt: skip


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
    need("paper", "stackbounce validate")
    prepare_folder(out, [*_NAMES, *(f"figures/{name}.svg" for name in names())])
    done = validate(progress)
    progress(f"writing to {out}")
    figures = {one.series.name: render(partial(draw, one), "svg") for one in done.comparisons}
    files = {f"figures/{name}.svg": picture for name, picture in figures.items()}
    files["validation.csv"] = _csv(done).encode()
    files["validation.json"] = (json.dumps(done.as_dict(), indent=1) + "\n").encode()
    files["index.html"] = _page(done, figures).encode()
    write_folder(out, files)
    return done


def _csv(done: Validation) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(("dataset", "ball", "quantity", *_COLUMNS))
    for one in done.as_dict()["datasets"]:
        for law in one["laws"]:
            row = (law[key] for key in _COLUMNS)
            writer.writerow((one["name"], one["ball"], one["quantity"], *row))
    return stream.getvalue()


def _page(done: Validation, figures: dict[str, bytes]) -> str:
    import jinja2

    pages = jinja2.Environment(
        loader=jinja2.PackageLoader("stackbounce.validation"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    pages.filters["p"] = lambda value: "–" if value is None else format_p(value)
    return pages.get_template("validation.html.j2").render(
        done=done,
        about={name: describe(name) for name in names()},
        figures={name: data_uri(picture) for name, picture in figures.items()},
        version=__version__,
    )
