"""From measurements to parameters: what a person records, as stiffness, restitution and gap."""

from stackbounce.measure.press import Press, Split, press, series_stiffness, split_series
from stackbounce.measure.stiffness import LawConstants, dynamic_stiffness, law_constants
from stackbounce.measure.table import Row

__all__ = [
    "LawConstants",
    "Press",
    "Row",
    "Split",
    "dynamic_stiffness",
    "law_constants",
    "press",
    "series_stiffness",
    "split_series",
]
