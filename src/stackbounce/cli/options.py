"""Options that several commands share, and tables of options for their signatures."""

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer

from stackbounce.model.laws import LAWS

RARE = "Rarely needed"
"""The last panel of a command's help."""

Command = TypeVar("Command", bound=Callable[..., None])


def option(
    kind: Any, metavar: str | None, text: str, *names: str, default: Any = None, **more: Any
) -> tuple[Any, Any]:
    """Return the annotation and the default of an option, for `add_options`.

    Parameters
    ----------
    kind : type
        The type annotation that typer reads.
    metavar, text : str
        The name of its value in the help, and the help text.
    *names : str
        Its names on the command line; by default ``--`` and its key.
    default : optional
        The value if the option is not given.
    **more
        Other arguments of `typer.Option`.
    """
    return Annotated[kind, typer.Option(*names, metavar=metavar, help=text, **more)], default


def add_options(options: Mapping[str, tuple[Any, Any]]) -> Callable[[Command], Command]:
    """Return a decorator that gives a command more options, which it takes as ``**given``.

    They come after the command's positional parameters and before its keyword-only ones.
    """

    def changed(run: Command) -> Command:
        own = inspect.signature(run)
        *rest, _ = own.parameters.values()
        first = [each for each in rest if each.kind is not each.KEYWORD_ONLY]
        added = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, annotation=kind, default=value)
            for name, (kind, value) in options.items()
        ]
        ordered = [*first, *added, *rest[len(first) :]]
        run.__signature__ = own.replace(parameters=ordered)  # type: ignore[attr-defined]
        return run

    return changed


def ball_names(incomplete: str) -> list[str]:
    """Return the balls of the catalogue that begin so, for the shell's completion."""
    from stackbounce.model.catalogue import BALLS, CLASS_BALLS

    names = [str(entry.ball.name).replace(" ", "-") for entry in (*BALLS, *CLASS_BALLS)]
    return [name for name in names if name.startswith(incomplete)]


def law_names(incomplete: str) -> list[str]:
    """Return the contact laws that begin so, for the shell's completion."""
    return [name for name in LAWS if name.startswith(incomplete)]


DROP = {
    "height": option(str | None, "LENGTH", "Height fallen from rest, such as 0.63m."),
    "speed": option(str | None, "SPEED", "Impact speed, such as 3.53m/s."),
    "gap": option(
        list[str] | None, "LENGTH", "Gap between two balls; once per pair, lowest first."
    ),
    "contact": option(
        list[str] | None,
        "LAW",
        "Contact below a ball, such as 'Spring stiffness=2.5kN/m'; once per ball, "
        f"lowest first. Laws: {', '.join(LAWS)}; none for no floor.",
        autocompletion=law_names,
    ),
    "gravity": option(str | None, "ACCELERATION", "Gravity during the run, such as 9.81m/s^2."),
}
"""The options that change a drop, as `stackbounce.cli.scenario.read` takes them."""

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]
Plot = Annotated[
    Path | None, typer.Option(metavar="FILE", readable=False, help="Draw it: .svg, .png or .pdf.")
]
What = Annotated[
    list[str],
    typer.Argument(
        metavar="SCENARIO|BALLS",
        help="A scenario file in TOML, or balls of the catalogue, the lowest first.",
        show_default=False,
        autocompletion=ball_names,
    ),
]
Overwrite = Annotated[
    bool,
    typer.Option(
        "--overwrite",
        help="Replace files that are there. Without it only those are replaced that stackbounce "
        "wrote and nobody changed since.",
        rich_help_panel=RARE,
    ),
]
Until = Annotated[
    str | None,
    typer.Option(metavar="TIME", help="Stop at this time, not when the balls have parted."),
]
Tolerance = Annotated[
    float,
    typer.Option(
        metavar="NUMBER",
        help="Relative error to aim at under nonlinear contact laws.",
        rich_help_panel=RARE,
    ),
]
Save = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", readable=False, help="Write the best stack as a scenario: best.toml."
    ),
]
