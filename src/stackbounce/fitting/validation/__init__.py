"""Published measurements beside what each contact law gives for them.

- `series.py`: a dataset as restitutions at several speeds, with their covariance
- `family.py`: the laws of a class that a calibration at one speed gives
- `comparison.py`: χ² and p of each law for a series, also with half and twice the assumed errors
- `results.py`: `validate`, all datasets and all laws; `write`, the page and the tables of that
- `figures.py`: the picture of a series
"""

from stackbounce.fitting.validation.comparison import Comparison, Outcome
from stackbounce.fitting.validation.results import Validation, validate, write
from stackbounce.fitting.validation.series import Series

__all__ = ["Comparison", "Outcome", "Series", "Validation", "validate", "write"]
