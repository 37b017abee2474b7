"""The paper recomputed: R. Cross, Am. J. Phys. 75, 1009 (2007), its data, audit, tables, figures.

`write` makes the report that ``stackbounce paper`` writes; `audit` compares every printed number
with what the library's solvers give.
"""

from stackbounce.cross2007.bench import PAPER, Data, Input, changed
from stackbounce.cross2007.report import Audit, audit, write

__all__ = ["PAPER", "Audit", "Data", "Input", "audit", "changed", "write"]
