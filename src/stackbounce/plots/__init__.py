"""Plots of impacts, sweeps, stacks, measurements, fits and model comparisons."""

from stackbounce.extras import need
from stackbounce.plots.by_speed import restitutions
from stackbounce.plots.fit_result import corner, fit, fitted
from stackbounce.plots.impact import bounce
from stackbounce.plots.measurement import measured
from stackbounce.plots.model_comparison import compared
from stackbounce.plots.sweep_curves import heatmap, highest, lines

__all__ = [
    "bounce", "compared", "corner", "fit", "fitted", "heatmap", "highest", "lines", "measured",
    "restitutions",
]  # fmt: skip

need("a picture", "matplotlib")
