"""The command ``stackbounce masses``: the inner masses that throw the top ball highest."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import DROP, AsJson, Overwrite, Save, What, add_options
from stackbounce.cli.output import (
    check_scenario,
    check_solved,
    console,
    print_files,
    print_json,
    write_scenario,
)
from stackbounce.errors import InvalidValue, shown

if TYPE_CHECKING:
    from rich.console import Console

    from stackbounce.cli.scenario import Scenario
    from stackbounce.model import Drop

__all__ = ["EPILOG", "run"]

EPILOG = "For example: stackbounce masses basketball tennis B3 --save best.toml"
_AT_THE_END = 1e-3  # relative


@add_options({name: DROP[name] for name in ("height", "speed", "gap", "contact")})
def run(
    what: What,
    *,
    within: Annotated[
        str | None,
        typer.Option(
            metavar="MASS:MASS",
            help="The smallest and the largest mass that are tried, such as 10g:1kg; by default "
            "those of the lowest and the top ball.",
        ),
    ] = None,
    save: Save = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Find the masses between the lowest and the top ball that throw the top one highest."""
    from stackbounce import best_masses, simulate
    from stackbounce.cli import scenario

    check_scenario(save, overwrite, what)
    tried = None if within is None else limits(within)
    chosen = scenario.read(what, **given)
    best = best_masses(chosen.drop, within=tried)
    write_scenario(best.to_toml(), save, overwrite)
    found = summary(chosen.drop, best, tried)
    if as_json:
        print_json(found)
    else:
        print_masses(console(), chosen, found)
        print_files(best=save)
    check_solved({simulate(best).status.name: 1})


def limits(text: str) -> tuple[float, float]:
    """Return the lowest and the highest mass in kg of ``--within``.

    Examples
    --------
    >>> limits("10g:1kg")
    (0.01, 1.0)
    """
    from stackbounce.units import quantity

    low, colon, high = text.partition(":")
    if not colon:
        raise InvalidValue(f"--within must be MASS:MASS, such as 10g:1kg, got {shown(text)}")
    return quantity(low, "kg", "--within"), quantity(high, "kg", "--within")


def summary(given: "Drop", best: "Drop", within: tuple[float, float] | None) -> dict[str, Any]:
    """Return what ``stackbounce masses --json`` prints."""
    from stackbounce.gaps_and_masses.masses import geometric_masses, replace_masses
    from stackbounce.version import __version__

    means = replace_masses(given, geometric_masses(given)[1:-1])
    outer = sorted([given.balls[0].mass, given.balls[-1].mass])
    low, high = outer if within is None else within
    ends = [
        i
        for i, ball in enumerate(best.balls[1:-1], start=1)
        if min(ball.mass / low, high / ball.mass) < 1.0 + _AT_THE_END
    ]
    stacks = {"best": best, "given": given, "geometric_means": means}
    return {
        "stackbounce": __version__,
        "drop": best.to_mapping(),
        "within": [low, high],
        "at_the_end": ends,
        **{name: _outcome(drop) for name, drop in stacks.items()},
    }


def print_masses(console: "Console", scenario: "Scenario", found: dict[str, Any]) -> None:
    """Print the best masses beside those given and the geometric means."""
    from stackbounce.cli.tables import incidence, label, new_table, number

    console.print(incidence(scenario), style="bold")
    balls = scenario.drop.balls
    names = [label(ball.name, i) for i, ball in enumerate(balls)]
    title = "Masses in g, the lowest first, and the top ball"
    table = new_table(title, [""], [*names, "v/v0", "bounce/drop"])
    for name in ("best", "given", "geometric_means"):
        one = found[name]
        top = float(one["rebound_ratios"][-1])
        heights = [number(top), number(max(top, 0.0) ** 2)]
        words = name.replace("_", " ")
        table.add_row(words, *(number(1e3 * mass) for mass in one["masses"]), *heights)
    console.print(table)
    low, high = found["within"]
    for i in found["at_the_end"]:
        console.print(
            f"{label(balls[i].name, i)} lies at the end of what was tried, {low:.6g} kg to "
            f"{high:.6g} kg: the best mass is beyond (--within)"
        )


def _outcome(drop: "Drop") -> dict[str, Any]:
    from stackbounce import simulate

    result = simulate(drop)
    return {
        "masses": [ball.mass for ball in drop.balls],
        "rebound_ratios": result.rebound_ratios,
        "collisions": result.collisions,
        "energy_retained": result.energy_retained,
    }
