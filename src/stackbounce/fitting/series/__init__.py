"""Restitutions at several speeds beside what each contact law gives for them.

- `columns.py`: what a column of a table of bounces holds
- `table.py`: a table of bounces as data sets, one for each ball
- `stack.py`: a table with a column for each ball of a stack, as drops with data
- `series.py`: a data set as restitutions at several speeds, with their covariance
- `family.py`: the laws of a class that a calibration at one speed gives
- `comparison.py`: χ² and p of each law for a series, also with half and twice the assumed errors
- `results.py`: `fit_series`, tables and data sets beside the laws; `write`, the page of that
"""

from stackbounce.fitting.series.comparison import Comparison as Comparison
from stackbounce.fitting.series.comparison import Outcome as Outcome
from stackbounce.fitting.series.results import SeriesFit as SeriesFit
from stackbounce.fitting.series.results import fit_series as fit_series
from stackbounce.fitting.series.results import write as write
from stackbounce.fitting.series.series import Series as Series
from stackbounce.fitting.series.stack import StackTable as StackTable
from stackbounce.fitting.series.stack import read_stack as read_stack
from stackbounce.fitting.series.table import read_table as read_table
