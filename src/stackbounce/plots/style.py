"""The style of all plots."""

import functools
import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, a_or_an, shown
from stackbounce.library_types import Axes, Figure

_Plot = TypeVar("_Plot", bound=Callable[..., Any])

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""The palette of Okabe and Ito, which colour-blind readers can tell apart."""

WIDTH = 7.2
"""The usual width of a figure in inches."""

_UNDATED = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


@functools.cache
def read_style() -> Any:
    """Return matplotlib's settings from ``plots.mplstyle``."""
    import matplotlib as mpl

    path = Path(__file__).with_name("plots.mplstyle")
    return mpl.rc_params_from_file(path, use_default_template=False)


@contextmanager
def styled_figure(width: float, height: float, style: Any = None) -> Iterator[Figure]:
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

    from stackbounce.plots.figure import Figure

    with mpl.rc_context({**read_style(), **(style or {})}):
        yield Figure(figsize=(width, height))


@contextmanager
def panels(
    size: tuple[float, float], axes: Any = None, ratios: Any = (1.0,), *, sharex: bool = True
) -> Iterator[tuple[Figure, list[Axes]]]:
    """Yield a figure, as `styled_figure`, and its panels from top to bottom.

    Parameters
    ----------
    size : (float, float)
        Width and height of a new figure in inches.
    axes : matplotlib.axes.Axes or sequence of them, optional
        The panels, if they are there already.
    ratios : sequence of float, optional
        The heights of the panels of a new figure, over each other.
    sharex : bool, optional
        Whether the panels of a new figure have one horizontal axis.

    Raises
    ------
    InvalidValue
        If `axes` are not as many as `ratios`.

    Examples
    --------
    >>> with panels((7.2, 4.4), ratios=[3, 2]) as (figure, (above, below)):
    ...     _ = below.set_xlim(0.0, 2.0)
    >>> above.get_xlim() == (0.0, 2.0)
    True
    """
    with styled_figure(*size) as figure:
        if axes is not None:
            yield list_axes(axes, len(ratios))
            return
        look: Any = {"sharex": sharex, "squeeze": False, "height_ratios": ratios}
        yield figure, figure.subplots(len(ratios), 1, **look)[:, 0].tolist()
        figure.align_ylabels()


def into_axes(plot: _Plot) -> _Plot:
    """Let a plot return the axes that it was given: a notebook shows their figure by itself.

    Used as a decorator; without axes the plot returns its figure. ``ax=`` is taken as ``axes=``.
    """

    @functools.wraps(plot)
    def drawn(*args: Any, **options: Any) -> Any:
        if "ax" in options:
            options["axes"] = options.pop("ax")
        figure, axes = plot(*args, **options), options.get("axes")
        return figure if axes is None else axes

    return cast("_Plot", drawn)


def list_axes(axes: Any, *counts: int) -> tuple[Figure, list[Axes]]:
    """Return the figure of axes of the user, and these; raise if they are not so many.

    Raises
    ------
    InvalidValue
        If their number is none of `counts`.

    Examples
    --------
    >>> list_axes([], 1, 2)
    Traceback (most recent call last):
    stackbounce.errors.InvalidValue: axes must be 1 or 2 Axes of matplotlib, got 0
    """
    from matplotlib.axes import Axes

    own = [panel for panel in np.ravel(np.asarray(axes, dtype=object)) if isinstance(panel, Axes)]
    if len(own) not in counts:
        most = " or ".join(map(str, counts))
        raise InvalidValue(f"axes must be {most} Axes of matplotlib, got {len(own)}")
    return cast("Figure", own[0].figure), own  # or a part of one, if the user has parts


_DRAWN_BY = dict.fromkeys(("Comparison", "Fit", "Posterior", "SeriesFit"), "fit")
_DRAWN_BY |= {"Prediction": "bounce", "Result": "bounce", "Drop": "bounce(simulate(drop))"}
_DRAWN_BY |= {"Dataset": "lines, heatmap or highest"}


def drawn_by(value: Any) -> str:
    """Return what was given instead of a plot's own sort of thing, and which plot draws it.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drawn_by(sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.8)], height=1.0))
    'a Drop: plots.bounce(simulate(drop)) draws it'
    >>> drawn_by(3)
    '3'
    """
    kind = type(value).__name__
    plot = "measured(data, found)" if hasattr(value, "picture") else _DRAWN_BY.get(kind)
    return f"{a_or_an(kind)}: plots.{plot} draws it" if plot else shown(value)


def check_kind(value: Any, name: str, *kinds: str) -> None:
    """Raise `InvalidType`, with the plot that draws such a value, unless its class is named."""
    if type(value).__name__ not in kinds:
        right = " or ".join(map(a_or_an, kinds))
        raise InvalidType(f"{name} must be {right}, got {drawn_by(value)}")


def file_of(data: Any) -> str:
    """Return the name of the file that data were read from, or an empty text.

    Examples
    --------
    >>> file_of(None)
    ''
    """
    return str(getattr(data, "attrs", {}).get("source", ""))


def render(make: Callable[[], Figure], kind: str) -> bytes:
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
        mpl.rcParams.update(read_style())
        figure.savefig(stream, format=kind, dpi=150, metadata=_UNDATED.get(kind))
    return stream.getvalue()


def annotate(axes: Axes, text: str, place: tuple[Any, Any], color: str, **more: Any) -> None:
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
