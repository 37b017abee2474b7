"""The commands ``stackbounce transition``, ``highest`` and ``masses``, and their options."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from stackbounce.cli.options import AsJson, Contact, Gap, Height, Plot, Save, Speed, Tolerance, What
from stackbounce.cli.output import check_picture, check_scenario, console, draw, write_scenario

__all__ = ["COMMANDS", "highest", "masses", "transition"]


def transition(
    what: What,
    only: Annotated[
        int | None,
        typer.Option(
            metavar="NUMBER",
            help="Vary only this gap, counted from 0, the lowest; default all, with one value.",
        ),
    ] = None,
    stop: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="The widest gap; default where the collisions are separate, and a little more.",
        ),
    ] = None,
    height: Height = None,
    speed: Speed = None,
    gap: Gap = None,
    contact: Contact = None,
    rtol: Tolerance = 1e-12,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Open the gaps of a stack, from touching balls to separate collisions."""
    from stackbounce import plots
    from stackbounce import transition as run
    from stackbounce.cli import designed, machine, scenario
    from stackbounce.units import quantity

    if plot is not None:
        check_picture(plot)
    last = None if stop is None else quantity(stop, "m", "--stop")
    chosen = scenario.read(what, height=height, speed=speed, gaps=gap, contacts=contact)
    data = run(chosen.drop, only, stop=last, rtol=rtol)
    if plot is not None:
        draw(lambda: plots.transition(data), plot)
    if as_json:
        typer.echo(machine.text(designed.transition_summary(chosen, data)))
        return
    designed.tell_transition(console(), chosen, data)
    if plot is not None:
        typer.echo(f"Picture: {plot}")


def highest(
    what: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[BALL]...",
            help="Balls of the catalogue, or scenario files of one ball each, as measure --save "
            "writes them; by default the whole catalogue.",
            show_default=False,
        ),
    ] = None,
    balls: Annotated[int, typer.Option(metavar="NUMBER", help="Balls in a stack.")] = 3,
    repeat: Annotated[
        bool, typer.Option("--repeat", help="Take each ball any number of times.")
    ] = False,
    gap: Annotated[
        list[str] | None,
        typer.Option(
            metavar="LENGTH",
            help="Gap between all neighbours, once for each that is tried; the order is that of "
            "the first; by default 0, 1 mm and 5 mm.",
        ),
    ] = None,
    law: Annotated[
        str,
        typer.Option(
            metavar="LAW",
            help="Of the catalogue's contacts, with the ball's contact time and restitution, as "
            "spring, which loses nothing.",
        ),
    ] = "hysteretic",
    height: Height = None,
    speed: Speed = None,
    rows: Annotated[int, typer.Option(metavar="NUMBER", help="Stacks to print.", min=1)] = 10,
    save: Save = None,
    plot: Plot = None,
    as_json: AsJson = False,
) -> None:
    """Try all stacks of some balls: which one throws its top ball highest."""
    from stackbounce import highest as run
    from stackbounce import plots
    from stackbounce.cli import designed, machine

    if plot is not None:
        check_picture(plot)
    if save is not None:
        check_scenario(save)
    given = designed.candidates(what, law=law, gaps=gap, height=height, speed=speed)
    data = run(count=balls, repeat=repeat, **given)
    if save is not None:
        write_scenario(data.attrs["best"], save)
    if plot is not None:
        draw(lambda: plots.highest(data), plot)
    if as_json:
        typer.echo(machine.text(designed.highest_summary(data)))
        return
    designed.tell_highest(console(), data, rows)
    _tell_files(save, plot)


def masses(
    what: What,
    within: Annotated[
        str | None,
        typer.Option(
            metavar="MASS:MASS",
            help="The smallest and the largest mass that are tried, such as 10g:1kg; by default "
            "those of the lowest and the top ball.",
        ),
    ] = None,
    height: Height = None,
    speed: Speed = None,
    gap: Gap = None,
    contact: Contact = None,
    save: Save = None,
    as_json: AsJson = False,
) -> None:
    """Find the masses between the lowest and the top ball that throw the top one highest."""
    from stackbounce import best_masses
    from stackbounce.cli import designed, machine, scenario

    if save is not None:
        check_scenario(save)
    limits = None if within is None else designed.limits(within)
    chosen = scenario.read(what, height=height, speed=speed, gaps=gap, contacts=contact)
    best = best_masses(chosen.drop, within=limits)
    if save is not None:
        write_scenario(best.to_toml(), save)
    found = designed.masses_summary(chosen.drop, best, limits)
    if as_json:
        typer.echo(machine.text(found))
        return
    designed.tell_masses(console(), chosen, found)
    _tell_files(save, None)


def _tell_files(save: Path | None, plot: Path | None) -> None:
    if save is not None:
        typer.echo(f"Best stack: {save}; now: stackbounce simulate {save}")
    if plot is not None:
        typer.echo(f"Picture: {plot}")


COMMANDS: dict[Callable[..., Any], str] = {
    transition: "For example: stackbounce transition basketball tennis --plot gaps.svg",
    highest: "For example: stackbounce highest --balls 3 --gap 0 --gap 2mm --plot stacks.svg",
    masses: "For example: stackbounce masses basketball tennis B3 --save best.toml",
}
"""The commands, each with an example of its use."""
