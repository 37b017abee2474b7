"""The files of the study: its page, its figures and its numbers."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from stackbounce import __version__
from stackbounce.cross2007.pages import data_uri, make_environment
from stackbounce.cross2007.style import Picture, render, use_style
from stackbounce.files import prepare_folder, write_folder
from stackbounce.fitting import Residual
from studies.table2 import inputs
from studies.table2.catalogue import CHOSEN
from studies.table2.choices import (
    ALL_EARLY,
    ALL_LATE,
    BASE,
    FALLING,
    FALLING_LATE,
    LATE,
)
from studies.table2.claims import EXCLUDED, FITS
from studies.table2.cross_validation import HeldOut
from studies.table2.figures import (
    draw_comparison,
    draw_delays,
    draw_misfits,
    name_pair,
)
from studies.table2.figures_predictions import draw_decisive, draw_energy
from studies.table2.readings import LAWS, READINGS, penalty
from studies.table2.results import Study, run_study

_FIGURES = "comparison misfits delays energy decisive".split()


def write(out: Path, progress: Callable[[str], None] = lambda _: None, workers: int = 1) -> None:
    """Write the page, its figures and its numbers to a folder; see `make_files`."""
    prepare_folder(out, ["study.html", "study.json", *(f"figures/study-{x}.svg" for x in _FIGURES)])
    write_folder(out, make_files(progress, workers))


def make_files(
    progress: Callable[[str], None] = lambda _: None, workers: int = 1
) -> dict[str, bytes]:
    """Return ``study.html``, ``study.json`` and the study's figures as bytes, by their names.

    Parameters
    ----------
    progress : callable, optional
        Receives a line of text for each step.
    workers : int, optional
        Processes that share the fits; the files do not depend on it.
    """
    done = run_study(progress, workers)
    found: dict[str, bytes] = {}
    drawn: dict[str, tuple[Picture, str]] = {}
    for picture in draw_pictures(done):
        progress(f"figure {picture.name}")
        images = render(picture.picture)
        found |= {f"figures/{picture.name}.{end}": data for end, data in images.items()}
        drawn[picture.name.removeprefix("study-")] = picture, data_uri(images["svg"])
    found["study.json"] = (json.dumps(_plain(done.as_dict()), indent=1) + "\n").encode()
    found["study.html"] = render_page(done, drawn).encode()
    return found


def draw_pictures(done: Study) -> list[Picture]:
    """Return the study's figures, in the order of the page."""
    with use_style():
        return [
            draw_comparison(done.fits),
            draw_misfits(done.compared),
            draw_delays(done.compared),
            draw_energy(done.kept),
            draw_decisive(done.compared),
        ]


def render_page(done: Study, drawn: dict[str, tuple[Picture, str]]) -> str:
    """Return the page as HTML."""
    import jinja2

    pages = make_environment()
    own = jinja2.FileSystemLoader(Path(__file__).parent / "templates")
    pages.loader = jinja2.ChoiceLoader([own, pages.loader])
    pages.filters["number"] = _number
    pages.filters["chance"] = _chance
    pages.filters["misses"] = _misses
    pages.filters["named"] = name_pair
    pages.filters["fitted"] = _fitted
    compared, cells = done.compared, done.fits.cells
    six = compared["S, six"]
    return pages.get_template("study.html.j2").render(
        study=done,
        figures=drawn,
        base=BASE.name,
        late=LATE.name,
        cells=cells,
        leaders=done.fits.leaders,
        delays={
            "2 ms": BASE.name,
            "7 ms": LATE.name,
            "2 ms, with gravity": FALLING.name,
            "7 ms, with gravity": FALLING_LATE.name,
        },
        likeliest={
            choice: max(row[choice].score.probability for row in cells.values())
            for choice in done.fits.columns
        },
        fitting={
            choice: sum(row[choice].score.probability >= FITS for row in cells.values())
            for choice in done.fits.columns
        },
        early_all=ALL_EARLY.name,
        late_all=ALL_LATE.name,
        models={row["name"]: row for row in done.rows},
        pairs={name: compared.pairs(name) for name in CHOSEN},
        measured={pair: inputs.read_ratios(pair) for pair in inputs.PAIRS},
        balls=READINGS,
        tried={
            choice: {(case.reading, case.law): case.fit.chi_squared for case in tried}
            for choice, tried in done.readings.items()
        },
        penalty=penalty,
        total=_total,
        expected=lambda rows: sum(row.expected for row in rows),
        best_first=lambda rows: sorted(rows, key=lambda name: _total(rows[name])),
        correction=six.aicc - six.chi_squared - 2.0 * six.free,
        fits=FITS,
        excluded=EXCLUDED,
        predicted={prediction.what: prediction for prediction in done.predictions},
        laws=list(LAWS),
        chosen=CHOSEN,
        version=__version__,
    )


def _total(rows: list[HeldOut]) -> float:
    """Return the sum of the scores of the pairs that were left out."""
    return sum(row.score for row in rows)


_LEAST = 1e-4  # the smallest probability that is printed


def _chance(value: float) -> str:
    """Format a probability.

    Examples
    --------
    >>> _chance(0.01234), _chance(0.00052), _chance(1e-9)
    ('0.012', '0.0005', '< 10⁻⁴')
    """
    if value < _LEAST:
        return "< 10⁻⁴"
    return f"{value:.4f}" if value < 1e-3 else f"{value:.3f}"


def _number(value: float, digits: int = 1, *, sign: bool = False) -> str:
    """Format a number with a typographic minus sign.

    Examples
    --------
    >>> _number(-1.26), _number(0.5, 2, sign=True), _number(-0.01), _number(float("nan"))
    ('−1.3', '+0.50', '0.0', '–')
    """
    if math.isnan(value):
        return "–"
    return f"{value:{'+' if sign else ''}z.{digits}f}".replace("-", "−")


def _misses(rows: list[Residual]) -> str:
    """Format the residuals that a model misses."""
    found = [
        f"{_datum(row)} ({_number(row.pull, 1 if abs(row.pull) < 10 else 0, sign=True)})"
        for row in rows
    ]
    return ", ".join(found) or "none by more than two errors"


def _datum(one: Residual) -> str:
    return f"{'e2' if one.name.endswith('1') else 'e1'} of {name_pair(one.drop)}"


_WORDS = {
    "e": "restitution",
    "e_floor": "on the floor",
    "e_between": "of two balls",
    "e_B1": "B1",
    "e_B2": "B2",
    "e_B3": "B3",
    "loss": "loss times",
    "between": "loss of two balls times",
    "stiffer": "stiffness of two balls times",
    "exponent": "exponent",
    "relaxation": "relaxation time over contact time",
}


def _fitted(shared: dict[str, float]) -> str:
    """Format the fitted numbers of a model."""
    return ", ".join(f"{_WORDS[name]} {value:.3g}" for name, value in shared.items()) or "nothing"


def _plain(value: Any) -> Any:
    """Return named tuples as dicts and nan as None, for JSON."""
    if hasattr(value, "_asdict"):
        return _plain(value._asdict())
    if isinstance(value, dict):
        return {str(key): _plain(member) for key, member in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(member) for member in value]
    if isinstance(value, float) and math.isnan(value):
        return None
    return value
