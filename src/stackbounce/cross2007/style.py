"""The style of the paper's figures: type, lines and colours.

Journal width, serif type, black on white. Colour-blind readers can tell the colours (Okabe and Ito)
apart, and so can readers of a print in grey; line styles and labels carry the same information.
"""

import io
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from stackbounce.cross2007.drops import Array

BLACK = "#000000"
FLOOR = "#0072B2"
UPPER = "#D55E00"
GREY = "#6b6b6b"

WIDTH = 4.2  # inches
_FEATURE = ("what", "paper", "here")
_BRACKET = 0.75  # height of a bracket in its axes


@dataclass(frozen=True, eq=False)
class Picture:
    """A recomputed figure.

    ``name`` is the paper's number (``"2a"``), ``guesses`` are assumptions where the paper gives no
    value, and ``features`` compares the figure with the text: each has `what` it is, as the `paper`
    reports it, and as the model gives it `here`.
    """

    name: str
    title: str
    caption: str
    guesses: tuple[str, ...]
    features: tuple[dict[str, str], ...]
    figure: "Figure"


def describe(name: str, figure: "Figure", **numbers: object) -> Picture:
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


@cache
def read_words() -> dict[str, Any]:
    """Return the contents of ``figures.toml``: the words of each figure by its number."""
    return tomllib.loads((files(__package__) / "figures.toml").read_text("utf-8"))


@contextmanager
def use_style() -> Iterator[None]:
    """Draw in the paper's style within this context."""
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rc_file(Path(__file__).with_name("paper.mplstyle"))
        yield


def make_axes(
    height: float = 3.0,
    rows: int = 1,
    *,
    right: float = 0.14,
    ratios: tuple[float, ...] | None = None,
) -> tuple["Figure", list["Axes"]]:
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


def bracket(ax: "Axes", end: float, text: str) -> None:
    """Mark an interval from 0 that the paper reports above the curves, with a text."""
    place = ax.get_xaxis_transform()
    ax.annotate(
        "",
        xy=(end, _BRACKET),
        xytext=(0.0, _BRACKET),
        xycoords=place,
        textcoords=place,
        arrowprops={
            "arrowstyle": "|-|,widthA=0.25,widthB=0.25",
            "color": GREY,
            "lw": 0.8,
            "shrinkA": 0.0,
            "shrinkB": 0.0,
        },
    )
    ax.annotate(
        text,
        xy=(0.0, _BRACKET),
        xycoords=place,
        xytext=(4.0, 5.0),
        textcoords="offset points",
        color=GREY,
        fontsize=9,
    )


def note(ax: "Axes", text: str) -> None:
    """Write a remark at the right edge of the axes, below their label."""
    ax.text(0.98, 0.6, text, transform=ax.transAxes, ha="right", va="top", color=GREY, fontsize=9)


def tag(
    ax: "Axes", xs: "Array", ys: "Array", at: float, text: str, color: str, *, above: bool = True
) -> None:
    """Label a curve above or below its point at x = `at`."""
    import numpy as np

    ax.annotate(
        text,
        xy=(at, float(np.interp(at, xs, ys))),
        xytext=(0, 3.5 if above else -3.5),
        textcoords="offset points",
        ha="center",
        va="bottom" if above else "top",
        color=color,
    )


def render(figure: "Figure") -> dict[str, bytes]:
    """Return a figure as bytes of an SVG and a PNG file; equal figures give equal bytes."""
    images = {}
    with use_style():
        for ending, options in (
            ("svg", {"metadata": {"Date": None, "Creator": None}}),
            ("png", {"dpi": 300, "metadata": {"Software": None}}),
        ):
            buffer = io.BytesIO()
            figure.savefig(buffer, format=ending, **options)
            images[ending] = buffer.getvalue()
    return images
