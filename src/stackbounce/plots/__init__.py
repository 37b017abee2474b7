"""Pictures: one drop's bounce, sweeps, what a measurement, a fit or a comparison found."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.compared import compared
from stackbounce.plots.fitted import fitted
from stackbounce.plots.measured import measured
from stackbounce.plots.posterior import corner
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "compared", "corner", "fitted", "heatmap", "lines", "measured"]
