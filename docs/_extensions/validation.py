"""The directive `validation`: which contact law follows which published measurement."""

from typing import Any

from docutils.nodes import Element, Node
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from stackbounce.fitting.series import Comparison, fit_series
from stackbounce.fitting.series.comparison import format_p


def row(one: Comparison) -> str:
    """Return a series' row: its name, its speeds, the laws with their p, whether it is steady."""
    low, high = one.series.speeds.min(), one.series.speeds.max()
    cells = [
        f"`{one.series.name}`",
        f"{low:.2g} to {high:.2g}",
        *(_laws(one, verdict) for verdict in ("agrees", "doubtful", "refuted")),
        "yes" if one.steady else "no",
    ]
    return f"| {' | '.join(cells)} |"


def _laws(comparison: Comparison, verdict: str) -> str:
    found = [one for one in comparison.outcomes if one.verdict == verdict]
    return ", ".join(f"{one.short_name} ({format_p(one.p)})" for one in found)


class Validation(SphinxDirective):
    """Writes the table, and what it adds up to, where it stands."""

    def run(self) -> list[Node]:
        """Return the table and the sentences below it."""
        names = ("Series", "Speeds, m/s", "Agree", "Doubtful", "Refuted", "Steady")
        head = [f"| {' | '.join(names)} |", "|" + "---|" * len(names)]
        done = fit_series("dataset:all")
        rows = [row(one) for one in done.comparisons]
        lines = StringList([*head, *rows, "", done.summary], source="stackbounce.fitting.series")
        holder = Element()
        self.state.nested_parse(lines, self.content_offset, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("validation", Validation)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
