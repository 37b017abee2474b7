"""Pictures: one drop's bounce, lines and maps of a sweep, what a measurement or a fit found."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.fitted import fitted
from stackbounce.plots.measured import measured
from stackbounce.plots.posterior import corner
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "corner", "fitted", "heatmap", "lines", "measured"]
