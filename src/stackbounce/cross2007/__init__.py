"""The paper recomputed: R. Cross, Am. J. Phys. 75, 1009 (2007), its data, audit, tables, figures.

`figure` and `table` recompute one of each, and `audit` compares every printed number with what the
library's solvers give. `write` makes the report that ``stackbounce paper`` writes.
"""

from stackbounce.cross2007.bench import PAPER, Data, Input, changed
from stackbounce.cross2007.report import Audit, audit, figure, table, write

__all__ = ["PAPER", "Audit", "Data", "Input", "audit", "changed", "figure", "table", "write"]
