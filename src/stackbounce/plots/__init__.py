"""Pictures: bounces, sweeps, designs, what a measurement, a fit or a comparison found."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.compared import compared
from stackbounce.plots.designed import highest, transition
from stackbounce.plots.fitted import fitted
from stackbounce.plots.measured import measured
from stackbounce.plots.posterior import corner
from stackbounce.plots.swept import heatmap, lines

__all__ = [
    "bounce",
    "compared",
    "corner",
    "fitted",
    "heatmap",
    "highest",
    "lines",
    "measured",
    "transition",
]
