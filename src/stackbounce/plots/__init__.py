"""Pictures: the bounce of one drop, lines and maps of a sweep, measurements, models."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.compared import compared
from stackbounce.plots.measured import measured
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "compared", "heatmap", "lines", "measured"]
