"""Pictures: one drop's bounce, lines and maps of a sweep, designs, what was measured."""

from stackbounce.plots.bounce import bounce
from stackbounce.plots.designed import highest, transition
from stackbounce.plots.measured import measured
from stackbounce.plots.swept import heatmap, lines

__all__ = ["bounce", "heatmap", "highest", "lines", "measured", "transition"]
