"""Pictures that the package draws, to the page that asks for them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib._pylab_helpers import Gcf
from matplotlib.backends.backend_agg import new_figure_manager_given_figure
from matplotlib.figure import Figure

DOCS = Path(__file__).parents[1]


def show(draw: Callable[..., Figure], *given: Any, **options: Any) -> None:
    """Draw a figure as outside these pages, and hand it to pyplot, where a page looks for it."""
    with mpl.rc_context(mpl.rcParamsDefault):
        figure = draw(*given, **options)
    Gcf._set_new_active_manager(new_figure_manager_given_figure(1, figure))
