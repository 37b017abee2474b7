"""The whole paper: its audit, figures and tables, in the order of its text."""

import itertools
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

from stackbounce.cross2007 import (
    checks_basketball,
    checks_fits,
    checks_models,
    checks_superballs,
    checks_tables,
    figures_models,
    figures_records,
)
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import AGREES, DIFFERS, WITHIN_ERROR, Row, run_check
from stackbounce.cross2007.claims import CLAIMS
from stackbounce.cross2007.data import PAPER, Data
from stackbounce.cross2007.style import Picture, use_style
from stackbounce.extras import need
from stackbounce.version import __version__

_MODULES = (
    checks_models,
    checks_basketball,
    checks_tables,
    checks_superballs,
    checks_fits,
)
COMPUTED = {name: compute for module in _MODULES for name, compute in module.COMPUTED.items()}
"""The function that computes each claim, by name."""

READINGS = {name: found for module in _MODULES for name, found in module.READINGS.items()}
"""The functions that compute the other readings of some claims, by name."""

FIGURES: dict[str, Callable[[Bench], Picture]] = {
    "2a": figures_models.draw_figure_2a,
    "2b": figures_models.draw_figure_2b,
    "4a": figures_models.draw_figure_4a,
    "4b": figures_models.draw_figure_4b,
    "5": figures_models.draw_figure_5,
    "6": figures_models.draw_figure_6,
    "7": figures_records.draw_figure_7,
    "8": figures_records.draw_figure_8,
    "8-hollow": figures_records.draw_figure_8_hollow,
    "9": figures_records.draw_figure_9,
    "10a": figures_records.draw_figure_10a,
    "10b": figures_records.draw_figure_10b,
    "11a": figures_records.draw_figure_11a,
    "11b": figures_records.draw_figure_11b,
    "12": figures_records.draw_figure_12,
    "13": figures_records.draw_figure_13,
}
"""The functions that draw the figures, by the paper's number; 1 and 3 are sketches.

"8-hollow" is Fig. 8 with another model."""


@dataclass(frozen=True)
class Audit:
    """The paper's numbers beside the computed ones.

    Parameters
    ----------
    rows : tuple of Row
        A row per printed number, in the order of the paper.
    data : mapping of str to Input
        The inputs that it was computed from.
    """

    rows: tuple[Row, ...]
    data: Data

    @property
    def counts(self) -> dict[str, int]:
        """The number of rows with each verdict."""
        verdicts = [row.verdict for row in self.rows]
        return {verdict: verdicts.count(verdict) for verdict in (AGREES, WITHIN_ERROR, DIFFERS)}

    def as_dict(self) -> dict[str, Any]:
        """Return the audit as plain dicts, lists, strings and numbers, for JSON."""
        return {
            "paper": "R. Cross, Vertical bounce of two vertically aligned balls, "
            "Am. J. Phys. 75, 1009 (2007), doi:10.1119/1.2772286",
            "stackbounce": __version__,
            "counts": self.counts,
            "rows": [{**asdict(row), "explained": row.explained} for row in self.rows],
            "inputs": [asdict(number) for number in self.data.values()],
        }


def audit(data: Data = PAPER, progress: Callable[[str], None] = lambda _: None) -> Audit:
    """Return the audit of the paper.

    Parameters
    ----------
    data : mapping of str to Input, optional
        The input numbers, by default those of the paper.
    progress : callable, optional
        Receives a line of text for each step.

    Returns
    -------
    Audit

    Examples
    --------
    >>> result = audit()
    >>> [row.verdict for row in result.rows if row.id == "II.ten_springs"]
    ['agrees']
    """
    need("paper", "stackbounce paper")
    rows: list[Row] = []
    for _, section in itertools.groupby(CLAIMS.values(), lambda claim: claim.id.partition(".")[0]):
        claims = list(section)
        progress(f"audit of {claims[0].where}: {len(claims)} numbers")
        for claim in claims:
            readings = READINGS.get(claim.id, ())
            rows.append(run_check(claim, COMPUTED[claim.id], readings, data))
    return Audit(tuple(rows), data)


def draw_figures(
    data: Data = PAPER, progress: Callable[[str], None] = lambda _: None
) -> Iterator[Picture]:
    """Yield the paper's figures, recomputed; see `audit` for the arguments."""
    for name, draw in FIGURES.items():
        progress(f"figure {name}")
        with use_style():
            picture = draw(Bench(data))
        yield picture
