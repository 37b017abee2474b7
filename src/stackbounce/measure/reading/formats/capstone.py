"""PASCO Capstone's CSV files."""

import re

from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text

_RUN = re.compile(r"(Run|Set|Lauf|Ensayo|Essai|Ajo|Kørsel|Körning|Serie) #\d+$")
_AUTO = re.compile(r"\s+Auto$")  # times that Capstone counts itself, the same in all runs


@layout
def capstone(text: Text) -> Layout | None:
    """Recognise PASCO Capstone: names end in ``Run #1``, a time's perhaps in ``Auto``."""
    for k, row in enumerate(text.head):
        cells = [cell for cell in row if cell]
        runs = [cell for cell in cells if _RUN.search(cell)]
        if len(cells) > 1 and runs and all(cell in runs or _AUTO.search(cell) for cell in cells):
            row = [_AUTO.sub("", cell) for cell in row]
            why = f"each column's name has its run after it, as in {runs[0]!r}"
            columns = columns_of(row, len(row))
            return Layout("PASCO Capstone", why, columns, first_row(text, k + 1))
    return None
