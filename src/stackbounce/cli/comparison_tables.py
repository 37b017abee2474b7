"""What ``stackbounce fit --compare`` prints."""

from typing import Any

from rich.console import Console

from stackbounce.cli.tables import new_table, number
from stackbounce.fitting import Comparison

_CRITERIA = {"aicc": "AICc", "bic": "BIC"}
_MANY = 8  # more data are not printed in a column each


def comparison_as_dict(done: Comparison) -> dict[str, Any]:
    """Return a comparison for --json, with the predictions of what is left out."""
    return {
        **done.as_dict(),
        "left_out": {
            name: [{**row._asdict(), "pull": row.pull} for row in rows]
            for name, rows in done.left_out.items()
        },
    }


def print_comparison(console: Console, done: Comparison) -> None:
    """Print a comparison."""
    name = _CRITERIA[done.criterion]
    scores = (f"{name}\nabove best", "left out:\nscore")
    headings = ("\nnumbers", "chi\nsquared", "for\ndegrees", *scores)
    table = new_table(None, ["\nModel"], headings)
    best = getattr(done.scores[0], done.criterion)
    for score in done.scores:
        above = getattr(score, done.criterion) - best
        row = (score.parameters, number(score.chi_squared), score.degrees_of_freedom)
        criteria = (number(above), number(done.predictive(score.model)))
        table.add_row(score.model, *map(str, row), *criteria)
    console.print(table)
    console.print(
        f"\n{name} is chi squared plus a penalty for each fitted number: 10 above the best is "
        "hopeless. The score of what is left out says how well each measurement is predicted from "
        "all others: more is better."
    )
    _print_pulls(console, done)
    for model, reason in done.refused.items():
        console.print(f"Not fitted: {model}: {reason}.")
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")


def _print_pulls(console: Console, done: Comparison) -> None:
    """Print the residuals of each model in standard errors, unless there are many data."""
    data = done.pulls.datum.values.tolist()
    if len(data) > _MANY:
        return
    headings = [datum.replace(".", ".\n", 1) for datum in data]
    table = new_table(None, ["Fitted less measured, in errors"], headings)
    for score in done.scores:
        row = done.pulls.sel(model=score.model).values
        table.add_row(score.model, *(f"{pull:+.1f}" for pull in row))
    console.print()
    console.print(table)
