"""Published measurements beside what each contact law gives for them.

- `fall.py`: falls and leaps through air, heights and times ↔ speeds
- `series.py`: a dataset as restitutions or contact times at several speeds, with their covariance
- `family.py`: the laws of a class that a calibration at one speed gives
- `comparison.py`: χ² and p of each law for a series, also with half and twice the assumed errors
- `results.py`: `validate`, all datasets and all laws
- `figures.py`, `report.py`: the page, the tables and the figures that `write` makes
"""

from stackbounce.validation.comparison import Comparison, Outcome
from stackbounce.validation.report import write
from stackbounce.validation.results import Validation, validate
from stackbounce.validation.series import Series

__all__ = ["Comparison", "Outcome", "Series", "Validation", "validate", "write"]
