"""From a press curve to static stiffness, exponent, energy loss and unloading exponent."""

from stackbounce.measure.kinds.press.analysis import press
from stackbounce.measure.kinds.press.result import Curve, Press
from stackbounce.measure.kinds.press.series import Split, series_stiffness, split_series

__all__ = ["Curve", "Press", "Split", "press", "series_stiffness", "split_series"]
