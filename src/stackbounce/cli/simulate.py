"""``stackbounce simulate``: one drop, and how each ball bounces."""

from typing import TYPE_CHECKING

import typer

from stackbounce.cli.options import (
    AsJson,
    Contact,
    Gap,
    Gravity,
    Height,
    Plot,
    Speed,
    Tolerance,
    Until,
    What,
)
from stackbounce.cli.output import check_picture, console, draw, print_json

if TYPE_CHECKING:
    from stackbounce.cli.scenario import Scenario
    from stackbounce.run.result import Result

__all__ = ["EPILOG", "run"]

EPILOG = "For example: stackbounce simulate basketball tennis --height 0.63m --gap 2mm"


def run(
    what: What,
    height: Height = None,
    speed: Speed = None,
    gap: Gap = None,
    contact: Contact = None,
    gravity: Gravity = None,
    until: Until = None,
    rtol: Tolerance = 1e-12,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Drop a stack of balls and tell how each one bounces."""
    from stackbounce import simulate
    from stackbounce.calibration import separate
    from stackbounce.cli import scenario
    from stackbounce.cli.simulation_tables import print_simulation
    from stackbounce.units import quantity

    if plot is not None:
        check_picture(plot)
    chosen = scenario.read(
        what, height=height, speed=speed, gaps=gap, contacts=contact, gravity=gravity
    )
    end = None if until is None else quantity(until, "s", "--until")
    result = simulate(chosen.drop, until=end, rtol=rtol)
    textbook = None if chosen.drop.rigid else simulate(separate(chosen.drop))
    if plot is not None:
        from stackbounce import plots

        draw(lambda: plots.bounce(result), plot)
    if as_json:
        print_json(summary(chosen, result, textbook))
    else:
        print_simulation(console(), chosen, result, textbook)
        if plot is not None:
            typer.echo(f"Picture: {plot}")


def summary(scenario: "Scenario", result: "Result", textbook: "Result | None") -> dict[str, object]:
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
    }
