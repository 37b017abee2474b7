"""The command ``stackbounce simulate``: how each ball of one drop bounces."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stackbounce.cli import output

if TYPE_CHECKING:
    from stackbounce.cli.scenario import Scenario
    from stackbounce.prediction import Prediction
    from stackbounce.run.result import Result


def run(
    what: Sequence[str],
    until: str | None,
    rtol: float,
    error: Sequence[str] | None,
    offset: str | None,
    plot: Path | None,
    overwrite: bool,
    as_json: bool,
    **given: Any,
) -> None:
    """Drop a stack of balls and tell how each one bounces."""
    from stackbounce import predict, simulate
    from stackbounce.cli import scenario
    from stackbounce.cli.drop_options import read_until
    from stackbounce.cli.errors_given import read_errors, split_errors
    from stackbounce.cli.simulation_tables import print_aside, print_simulation
    from stackbounce.run.collision import separate
    from stackbounce.units import quantity

    output.check_picture(plot, overwrite)
    plain, written = split_errors(given)
    chosen, end = scenario.read(what, with_errors=True, **plain), read_until(until)
    errors = read_errors(chosen.drop, {**chosen.errors, **written}, error)
    prediction = None
    if errors:
        with output.progress_bar("draws") as progress:
            prediction = predict(chosen.drop, errors, until=end, rtol=rtol, progress=progress)
    result = simulate(chosen.drop, until=end, rtol=rtol)
    moved = None if offset is None else quantity(offset, "m", "--offset")
    aside = [] if moved is None else leave_aside(result, moved)
    laws = chosen.drop.contacts
    joined = any(law is not None and law.pulls for law in laws)  # no collision of the textbook's
    textbook = None if chosen.drop.rigid or joined else simulate(separate(chosen.drop))
    output.draw_picture(plot, overwrite, "bounce", prediction or result)
    if as_json:
        sideways = {} if moved is None else {"sideways": aside}
        output.print_json(summary(chosen, result, textbook, prediction) | sideways)
    else:
        print_simulation(output.console(), chosen, result, textbook, prediction)
        if moved is not None:
            print_aside(output.console(), result, moved, aside)
        output.print_files(plot)
    output.check_solved({result.status.name: 1})


def leave_aside(result: "Result", offset: float) -> list[dict[str, float]]:
    """Return how the uppermost ball leaves for each ball that is moved aside alone."""
    found = []
    for ball in range(1, len(result.drop.balls)):
        top = result.sideways({ball: offset}).isel(ball=-1)
        found.append({"moved": ball, **{str(name): float(value) for name, value in top.items()}})
    return found


def summary(
    scenario: "Scenario",
    result: "Result",
    textbook: "Result | None",
    prediction: "Prediction | None" = None,
) -> dict[str, object]:
    """Return what ``stackbounce simulate --json`` prints."""
    from stackbounce.version import __version__

    return {
        "stackbounce": __version__,
        "drop": scenario.drop.to_mapping(),
        "contact_sources": scenario.contact_sources,
        "gap_sources": scenario.gap_sources,
        "reference_speed": scenario.drop.reference_speed,
        **result.to_mapping(),
        "intervals": result.intervals,
        "apexes": result.apexes,
        "separate": None if textbook is None else textbook.to_mapping(),
        **({} if prediction is None else {"errors": prediction.as_dict()}),
    }
