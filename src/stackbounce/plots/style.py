"""The style of all plots."""

import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""The palette of Okabe and Ito, which colour-blind readers can tell apart."""

FORCES = {"N": "force (N)", "V": "signal (V)"}
"""The label of a force axis, by the unit of the record."""

STYLE: Any = {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "lines.linewidth": 1.8,
    "svg.fonttype": "none",
    "svg.hashsalt": "stackbounce",
    "figure.constrained_layout.use": True,
}
"""Matplotlib's settings."""

WIDTH = 7.2
"""The usual width of a figure in inches."""

_UNDATED = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


@contextmanager
def styled_figure(width: float, height: float, style: Any = None) -> "Iterator[Figure]":
    """Yield an empty figure of a size in inches, within the style of this package.

    ``style`` are further settings of matplotlib, which override this style.

    Examples
    --------
    >>> with styled_figure(7.2, 4.4) as figure:
    ...     axes = figure.subplots()
    >>> axes.spines["top"].get_visible()
    False
    """
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context(STYLE | (style or {})):
        yield Figure(figsize=(width, height))


@contextmanager
def two_panels(height: float, ratios: Sequence[float]) -> "Iterator[tuple[Figure, Axes, Axes]]":
    """Yield a figure, as `styled_figure`, and its two panels with one horizontal axis.

    Examples
    --------
    >>> with two_panels(4.4, [3, 2]) as (figure, above, below):
    ...     _ = below.set_xlim(0.0, 2.0)
    >>> above.get_xlim() == (0.0, 2.0)
    True
    """
    with styled_figure(WIDTH, height) as figure:
        above, below = figure.subplots(2, 1, sharex=True, height_ratios=list(ratios))
        yield figure, above, below
        figure.align_ylabels()


def with_error(value: Any, plain: str = ".3g") -> str:
    """Return a number with the error of its last digit, or written as `plain` if it has none.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> with_error(ufloat(0.752, 0.013)), with_error(ufloat(0.752, float("nan")), ".2f")
    ('0.75(1)', '0.75')
    """
    return f"{value:.1uS}" if value.std_dev > 0.0 else f"{value.nominal_value:{plain}}"


def file_of(data: Any) -> str:
    """Return the name of the file that data were read from, or an empty text.

    Examples
    --------
    >>> file_of(None)
    ''
    """
    return str(getattr(data, "attrs", {}).get("source", ""))


def render(make: "Callable[[], Figure]", kind: str) -> bytes:
    """Return a picture as the bytes of a file, whatever matplotlib's settings of this user are.

    The same picture is the same file: no time of day, no random names inside.

    Parameters
    ----------
    make : callable
        Draws and returns the figure.
    kind : str
        ``svg``, ``png`` or ``pdf``.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> render(Figure, "png")[1:4]
    b'PNG'
    """
    import matplotlib as mpl

    stream = io.BytesIO()
    with mpl.rc_context():
        mpl.rcdefaults()
        figure = make()
        mpl.rcParams.update(STYLE)
        figure.savefig(stream, format=kind, dpi=150, metadata=_UNDATED.get(kind))
    return stream.getvalue()


def annotate(axes: "Axes", text: str, place: tuple[Any, Any], color: str, **more: Any) -> None:
    """Write a short text beside a point in data coordinates, or at a place given by `xycoords`."""
    at = {} if "xycoords" in more else {"xytext": (7, 7), "textcoords": "offset points"}
    axes.annotate(text, place, fontsize=9, color=color, **(at | more))


def color_of(index: int) -> str:
    """Return the color of a ball, or of the contact below it.

    Examples
    --------
    >>> color_of(0)
    '#0072B2'
    """
    return COLORS[index % len(COLORS)]


def written(name: str) -> str:
    r"""Return a name escaped for matplotlib: no mathtext, no unprintable character.

    Examples
    --------
    >>> print(written("5 $ ball"))
    5 \$ ball
    """
    return "".join(c if c.isprintable() else "?" for c in name).replace("$", r"\$")
