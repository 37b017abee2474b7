"""Pictures: the bounce of one drop, lines and maps of a sweep."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "heatmap", "lines"]
