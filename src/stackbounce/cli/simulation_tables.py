"""What ``stackbounce simulate`` prints."""

import math

from rich.console import Console

from stackbounce.cli.bounce_tables import Bounce
from stackbounce.cli.scenario import Scenario
from stackbounce.cli.tables import number, percent, write_count
from stackbounce.model import Tabulated
from stackbounce.model.catalogue import DEFAULT_HEIGHT
from stackbounce.model.drawing import meetings, names_of
from stackbounce.prediction import Prediction
from stackbounce.run.result import Result, Status

_LONG = 5_000_000  # work of a run that is not repeated to find its conditioning


def incidence(scenario: Scenario) -> str:
    """Return the names of the balls, and their height or speed."""
    drop = scenario.drop
    names = " + ".join(names_of(drop.balls))
    text = drop.incidence
    if scenario.speed_source == "default":
        text += f" ({DEFAULT_HEIGHT:g} m unless --height or --speed is given)"
    return f"{names} {text}"


def print_simulation(
    console: Console,
    scenario: Scenario,
    result: Result,
    textbook: Result | None,
    prediction: Prediction | None = None,
) -> None:
    """Print the result of a drop, beside the result of separate collisions if there is one.

    With a prediction, the numbers have errors instead.
    """
    drop, names = scenario.drop, meetings(scenario.drop.balls)
    console.print(incidence(scenario), style="bold")
    for i, source in enumerate(scenario.contact_sources):
        law = drop.contacts[i]
        words = "none" if law is None else law.described()
        console.print(f"  contact {i}, {names[i]}: {words}  [{source}]")
    for i, source in enumerate(scenario.gap_sources):
        gap = f"{drop.gaps[i] * 1e3:.6g} mm"
        console.print(f"  gap {i}, {names[i + 1]}: {gap}  [{source}]")
    bounce = Bounce(result, prediction)
    for table in (bounce.balls(textbook), bounce.contacts(), bounce.apexes()):
        if table is not None:
            console.print(table)
    console.print(f"\nKinetic energy retained: {bounce.energy()}")
    _closing(console, result, textbook)
    if prediction is not None:
        for text in (prediction.how, prediction.advice(), *prediction.notes):
            if text:
                console.print(f"{text[0].upper()}{text[1:]}.")


def _closing(console: Console, result: Result, textbook: Result | None) -> None:
    if not any(law.loss for law in result.drop.contacts if law is not None):
        console.print(
            "Springs lose nothing. With losses: --contact 'Hysteretic stiffness=K restitution=E'"
        )
    _beyond_tables(console, result)
    if textbook is not None:
        values = [law.restitution for law in textbook.drop.contacts if law is not None]
        listed = ", ".join(f"{value:.4g}" for value in values)
        counts = [write_count(count) for count in textbook.collisions]
        console.print(
            "Separate: the textbook's collisions one after the other, restitution "
            f"{listed} from the floor up: {' + '.join(counts)} collision{'s' * (counts != ['1'])}, "
            f"energy retained {percent(textbook.energy_retained)}"
        )
    _conditioning(console, result)
    for title, one in (("Status", result), ("Status of the separate collisions", textbook)):
        if one is not None and one.status is not Status.FINISHED:
            console.print(f"{title}: {one.status.name}: {one.advice}")


def _beyond_tables(console: Console, result: Result) -> None:
    """Say which contacts were pressed beyond the table of their law, or not to its first point."""
    for i, law in enumerate(result.drop.contacts):
        peaks = result.intervals["peak_compression"][result.intervals["contact"] == i]
        if not isinstance(law, Tabulated) or len(peaks) == 0:
            continue
        pressed = f"Contact {i} is pressed to {number(1e3 * max(peaks))} mm, but its table"
        if max(peaks) > law.compression[-1]:
            console.print(
                f"{pressed} ends at {number(1e3 * law.compression[-1])} mm: from there on the "
                "force rises straight."
            )
        elif max(peaks) < law.compression[1]:
            console.print(
                f"{pressed} begins at {number(1e3 * law.compression[1])} mm: how the force rises "
                "from 0 to there is a guess, and with it the contact time."
            )


def _conditioning(console: Console, result: Result) -> None:
    """Say from which time on no digit of the speeds is known, if there is one."""
    if result.work > _LONG or result.status is Status.INVALID:
        return
    if math.isfinite(result.known_until):
        console.print(
            f"Chaotic: no digit of the speeds is known after {number(result.known_until)} s, where "
            f"an error of {result.precision:.0e} of the numbers has grown to one of the speeds."
        )
