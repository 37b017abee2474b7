"""``stackbounce fit --compare``: the usual models side by side."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from stackbounce.cli.output import new_table
from stackbounce.cli.tables import number
from stackbounce.fitting import Comparison, Question, compare, standard_models
from stackbounce.fitting.quantities import QUANTITIES

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

__all__ = ["picture", "run", "summary", "tell"]

_CRITERIA = {"aicc": "AICc", "bic": "BIC"}
_MANY = 8  # data, up to which each has a column of its own


def run(asked: Question, *, starts: int | None, seed: int) -> Comparison:
    """Fit the usual models to what was measured."""
    alone = set(asked.drops) == {""}
    drops: Any = asked.drops[""] if alone else asked.drops
    data: Any = asked.data[""] if alone else asked.data
    timed = any(_is_timed(one) for one in asked.data.values())
    return compare(standard_models(drops, times=timed), data, starts=starts, seed=seed)


def picture(done: Comparison) -> "Figure":
    """Return the picture of a comparison."""
    from stackbounce import plots

    return plots.compared(done)


def summary(done: Comparison) -> dict[str, Any]:
    """Return the comparison for machines, with what each model predicts for what is left out."""
    return {
        **done.as_dict(),
        "left_out": {
            name: [{**one._asdict(), "pull": one.pull} for one in rows]
            for name, rows in done.left_out.items()
        },
    }


def tell(console: "Console", done: Comparison) -> None:
    """Print a comparison, for people."""
    table = new_table("\nModel")
    name = _CRITERIA[done.criterion]
    headings = (
        "\nnumbers",
        "chi\nsquared",
        "for\ndegrees",
        f"{name}\nabove best",
        "left out:\nscore",
    )
    for heading in headings:
        table.add_column(heading, justify="right", no_wrap=True)
    best = getattr(done.scores[0], done.criterion)
    for score in done.scores:
        above = getattr(score, done.criterion) - best
        predicted = done.predictive(score.model)
        degrees, chi = str(score.degrees_of_freedom), number(score.chi_squared)
        table.add_row(
            score.model, str(score.parameters), chi, degrees, number(above), number(predicted)
        )
    console.print(table)
    console.print(
        f"\n{name} counts chi squared and the numbers that were fitted: 10 more than the best is "
        "hopeless. The score of what is left out tells how well each measurement is foretold from "
        "all others: more is better."
    )
    _tell_pulls(console, done)
    for model, reason in done.refused.items():
        console.print(f"Not fitted: {model}: {reason}.")
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")


def _tell_pulls(console: "Console", done: Comparison) -> None:
    """Print what each model gets wrong, in errors, where there are few data."""
    data = done.pulls.datum.values.tolist()
    if len(data) > _MANY:
        return
    table = new_table("Fitted less measured, in errors")
    for datum in data:
        table.add_column(datum.replace(".", ".\n", 1), justify="right", no_wrap=True)
    for score in done.scores:
        row = done.pulls.sel(model=score.model).values
        table.add_row(score.model, *(f"{pull:+.1f}" for pull in row))
    console.print()
    console.print(table)


def _is_timed(data: Mapping[str, Any]) -> bool:
    """Tell whether a time or a force record was measured."""
    names = [name.partition(".")[0] for name in data]
    timed = {"force"} | {name for name, one in QUANTITIES.items() if one.unit == "s"}
    return not timed.isdisjoint(names)
