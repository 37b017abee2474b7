"""Pictures: the bounce of one drop, lines and maps of a sweep, what was found in a measurement."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.measured import measured
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "heatmap", "lines", "measured"]
