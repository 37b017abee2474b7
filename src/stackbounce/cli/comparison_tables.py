"""What ``stackbounce fit --compare`` prints."""

from rich.console import Console

from stackbounce.cli.tables import number, table_of
from stackbounce.fitting import Comparison

_CRITERIA = {"aicc": "AICc", "bic": "BIC"}


def print_comparison(console: Console, done: Comparison, speed: float) -> None:
    """Print a comparison of models that were calibrated at a speed in m/s."""
    name = _CRITERIA[done.criterion]
    other = "bic" if done.criterion == "aicc" else "aicc"
    shorter = {"probability": "p", "degrees_of_freedom": "degrees", "parameters": "numbers"}
    console.print(table_of(done.table.drop(columns=other).rename(columns=shorter)))
    console.print(
        "\nEach model has the same contacts in all drops. The search began with contacts that last "
        f"as long as yours at {number(speed)} m/s, the geometric mean of the impact speeds. "
        "p is the probability of a larger chi squared if the model is right. "
        f"{name} is chi squared plus a penalty for each fitted number: 10 above the best is "
        "hopeless."
    )
    for remark in done.remarks:
        console.print(remark)
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")
