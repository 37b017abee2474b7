"""What ``stackbounce fit --compare`` prints."""

from typing import Any

from rich.console import Console

from stackbounce.cli.tables import number, table_of
from stackbounce.fitting import Comparison

_CRITERIA = {"aicc": "AICc", "bic": "BIC"}


def comparison_as_dict(done: Comparison, speed: float) -> dict[str, Any]:
    """Return a comparison for --json, with the calibration speed and what is left out predicted."""
    return {
        **done.as_dict(),
        "calibration_speed": speed,
        "left_out": {
            name: [{**row._asdict(), "pull": row.pull} for row in rows]
            for name, rows in done.left_out.items()
        },
    }


def print_comparison(console: Console, done: Comparison, speed: float) -> None:
    """Print a comparison of models that were calibrated at a speed in m/s."""
    name = _CRITERIA[done.criterion]
    left_out = [done.predictive(score.model) for score in done.scores]
    other = "bic" if done.criterion == "aicc" else "aicc"
    shorter = {"probability": "p", "degrees_of_freedom": "degrees", "parameters": "numbers"}
    scores = done.table.drop(columns=other).rename(columns=shorter)
    console.print(table_of(scores.assign(left_out=left_out)))
    console.print(
        "\nEach model has the same contacts in all drops. The search began with contacts that last "
        f"as long as yours at {number(speed)} m/s, the geometric mean of the impact speeds. "
        "p is the probability of a larger chi squared if the model is right. "
        f"{name} is chi squared plus a penalty for each fitted number: 10 above the best is "
        "hopeless. The last number says how well each measurement is predicted from all others, if "
        "it is left out: more is better."
    )
    for remark in done.remarks:
        console.print(remark)
    first = done.scores[0].model
    for note in done[first].notes:
        console.print(f"Note on {first}: {note}.")
