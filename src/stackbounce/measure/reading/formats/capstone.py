"""PASCO Capstone's CSV files."""

import re

from stackbounce.measure.reading.layouts import Layout, columns_of, first_row, layout
from stackbounce.measure.reading.text import Text


@layout
def capstone(text: Text) -> Layout | None:
    """Recognise PASCO Capstone: column names end in ``Run #1``; lines above them are skipped."""
    for k, row in enumerate(text.head):
        cells = [cell for cell in row if cell]
        if len(cells) > 1 and all(
            re.search(r"(Run|Set|Lauf|Ensayo|Essai) #\d+$", cell) for cell in cells
        ):
            why = f"each column's name has its run after it, as in {cells[0]!r}"
            columns = columns_of(row, len(row))
            return Layout("PASCO Capstone", why, columns, first_row(text, k + 1))
    return None
