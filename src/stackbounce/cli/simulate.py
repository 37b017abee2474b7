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
    straight: str | None,
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
    from stackbounce.cli.sideways import Sideways
    from stackbounce.cli.simulation_tables import print_simulation
    from stackbounce.run.collision import separate

    output.check_picture(plot, overwrite)
    plain, written = split_errors(given)
    chosen, end = scenario.read(what, with_errors=True, **plain), read_until(until)
    sideways = Sideways(chosen.drop, offset, straight)
    errors = read_errors(chosen.drop, {**chosen.errors, **written}, error) | sideways.errors
    prediction = None
    if errors:
        with output.progress_bar("draws") as progress:
            prediction = predict(chosen.drop, errors, until=end, rtol=rtol, progress=progress)
    result = simulate(chosen.drop, until=end, rtol=rtol)
    aside = sideways.found(result)
    laws = chosen.drop.contacts
    joined = any(law is not None and law.pulls for law in laws)  # no collision of the textbook's
    textbook = None if chosen.drop.rigid or joined else simulate(separate(chosen.drop))
    output.draw_picture(plot, overwrite, "bounce", prediction or result)
    if as_json:
        output.print_json(summary(chosen, result, textbook, prediction) | aside)
    else:
        print_simulation(output.console(), chosen, result, textbook, prediction)
        sideways.print(output.console(), aside, prediction)
        output.print_files(plot)
    output.check_solved({result.status.name: 1})


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
