"""The style of the paper's figures: type, lines and colours.

Journal width, serif type, black on white. Colour-blind readers can tell the colours (Okabe and Ito)
apart, and so can readers of a print in grey; line styles and labels carry the same information.
"""

import io
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from stackbounce.cross2007.bench import CLAIMS, Bench
from stackbounce.cross2007.checks import SCALES
from stackbounce.cross2007.drops import Array
from stackbounce.cross2007.pages import data_uri
from stackbounce.files import shipped_table
from stackbounce.library_types import Axes, DataFrame, Dataset, Figure
from stackbounce.shown import Shown
from stackbounce.version import __version__

BLACK = "#000000"
FLOOR = "#0072B2"
UPPER = "#D55E00"
GREY = "#6b6b6b"

WIDTH = 4.2  # inches
_FEATURE = ("what", "paper", "here")
_FILES: dict[str, Any] = {
    "svg": {"metadata": {"Date": None, "Creator": None}},
    "png": {"dpi": 300, "metadata": {"Software": None}},
}
_BRACKET = 0.75  # height of a bracket in its axes


@dataclass(frozen=True, eq=False, repr=False)
class Picture(Shown):
    """A recomputed figure, which shows itself in a notebook.

    ``name`` is the paper's number (``"2a"``), ``guesses`` are assumptions where the paper gives no
    value, and ``features`` compares the figure with the text: each has `what` it is, as the `paper`
    reports it, and as the model gives it `here`. ``picture`` is matplotlib's Figure, whose `axes`
    take more curves. ``data`` is an xarray Dataset of the curves, with units; its variables
    ``known_…`` are what the paper's text gives: points, or lines across or along the figure.
    """

    name: str
    title: str
    caption: str
    guesses: tuple[str, ...]
    features: tuple[dict[str, str], ...]
    picture: Figure
    data: Any = None

    @property
    def table(self) -> DataFrame:
        """The features that the paper's text reports, as it has them and as computed here."""
        import pandas as pd

        return pd.DataFrame(list(self.features), columns=list(_FEATURE)).set_index("what")

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is guessed."""
        return tuple(f"Guessed: {guess}" for guess in self.guesses)

    def __repr__(self) -> str:
        """The words of the figure, and the table."""
        return f"Figure {self.name}: {self.title}\n{self.caption}\n{super().__repr__()}"

    def _drawing(self) -> str:
        """The figure with its words."""
        title = escape(f"Figure {self.name}: {self.title}")
        source = data_uri(render(self.picture, "svg")["svg"])
        image = f'<img src="{source}" alt="{title}" style="background: #fff">'
        return f"{image}<p><b>{title}.</b> {escape(self.caption)}</p>"


def describe(name: str, figure: Figure, **numbers: object) -> Picture:
    """Return a figure with its words from ``figures.toml``, in which the numbers are filled in."""
    words = read_words()[name]
    return Picture(
        name,
        words["title"].format(**numbers),
        words["caption"].format(**numbers),
        tuple(guess.format(**numbers) for guess in words["guesses"]),
        tuple(
            {key: text.format(**numbers) for key, text in zip(_FEATURE, texts, strict=True)}
            for texts in words.get("features", ())
        ),
        figure,
    )


def data_of(bench: Bench, name: str) -> Dataset:
    """Return the curves that the bench has recorded of a figure, and the points of the text."""
    import xarray as xr

    first = next(iter(bench.curves[0].values()))
    data = xr.concat(bench.curves, str(first.dims[0]), combine_attrs="drop_conflicts").squeeze()
    known = [[_place(bench, key) for key in point] for point in read_words()[name].get("known", ())]
    if known:
        data = data.assign_coords(known=["".join(what for what, _ in point) for point in known])
    for axis, column in zip((data[first.dims[-1]], first), zip(*known, strict=True), strict=False):
        data[f"known_{axis.name}"] = "known", [place for _, place in column], axis.attrs
    return data.assign_attrs(stackbounce=__version__)


def _place(bench: Bench, key: str | float) -> tuple[str, float]:
    """Return words for a number that the paper gives and its SI value; or no words and a place."""
    if not isinstance(key, str):
        return "", key
    if key in bench.data:
        return bench.data[key].what, bench(key)
    claim = CLAIMS[key]
    return claim.what, float(claim.digits) * SCALES[claim.unit]


@cache
def read_words() -> dict[str, Any]:
    """Return the contents of ``figures.toml``: the words of each figure by its number."""
    return shipped_table(__package__, "figures.toml")


def use_style() -> AbstractContextManager[None]:
    """Draw in the paper's style within this context."""
    import matplotlib as mpl

    return mpl.rc_context(fname=Path(__file__).with_name("paper.mplstyle"))


def make_axes(
    height: float = 3.0,
    rows: int = 1,
    *,
    right: float = 0.14,
    ratios: tuple[float, ...] | None = None,
) -> tuple[Figure, list[Axes]]:
    """Return an empty figure of journal width with stacked axes that share the horizontal axis.

    The margins are fixed, in inches, so that the frames of all figures line up; `ratios` are the
    relative heights of the axes.
    """
    from stackbounce.plots.figure import Figure

    figure = Figure(figsize=(WIDTH, height))
    panels = list(figure.subplots(rows, 1, sharex=True, squeeze=False, height_ratios=ratios)[:, 0])
    panel = (height - 0.55) / rows
    figure.subplots_adjust(
        left=0.58 / WIDTH,
        right=1.0 - right / WIDTH,
        bottom=0.45 / height,
        top=1.0 - 0.1 / height,
        hspace=0.12 / (panel - 0.12),
    )
    for ax in panels:
        ax.yaxis.set_label_coords(-0.115, 0.5)
    return figure, panels


def bracket(ax: Axes, end: float, text: str) -> None:
    """Mark an interval from 0 that the paper reports above the curves, with a text."""
    place = ax.get_xaxis_transform()
    ends: Any = {"arrowstyle": "|-|,widthA=0.25,widthB=0.25", "shrinkA": 0.0, "shrinkB": 0.0}
    line = ends | {"color": GREY, "lw": 0.8}
    both: Any = {"xycoords": place, "textcoords": place}
    ax.annotate("", (end, _BRACKET), (0.0, _BRACKET), arrowprops=line, **both)
    beside(ax, text, (0.0, _BRACKET), (4.0, 5.0), xycoords=place, color=GREY, fontsize=9)


def beside(
    ax: Axes, text: str, xy: tuple[float, float], by: tuple[float, float], **look: Any
) -> None:
    """Write a text beside a point, moved by some points of type."""
    ax.annotate(text, xy, by, textcoords="offset points", **look)


def note(ax: Axes, text: str) -> None:
    """Write a remark at the right edge of the axes, below their label."""
    ax.text(0.98, 0.6, text, transform=ax.transAxes, ha="right", va="top", color=GREY, fontsize=9)


def tag(
    ax: Axes, xs: Array, ys: Array, at: float, text: str, color: str, *, above: bool = True
) -> None:
    """Label a curve above or below its point at x = `at`."""
    import numpy as np

    point = (at, float(np.interp(at, xs, ys)))
    side, by = ("bottom", 3.5) if above else ("top", -3.5)
    beside(ax, text, point, (0, by), ha="center", va=side, color=color)


def render(figure: Figure, *endings: str) -> dict[str, bytes]:
    """Return a figure as bytes of an SVG and a PNG file; equal figures give equal bytes."""
    images = {}
    with use_style():
        for ending in endings or _FILES:
            buffer = io.BytesIO()
            figure.savefig(buffer, format=ending, **_FILES[ending])
            images[ending] = buffer.getvalue()
    return images
