"""The command ``stackbounce fit`` and its options."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import DROP, AsJson, Overwrite, Plot, add_options, option
from stackbounce.cli.output import check_picture, console, draw_picture, print_files, print_json
from stackbounce.errors import InvalidValue
from stackbounce.extras import need
from stackbounce.model.laws import usual_laws

if TYPE_CHECKING:
    from stackbounce.fitting import FitProblem

__all__ = ["EPILOG", "run"]

EPILOG = (
    "For example: stackbounce fit basketball tennis --height 63cm --measured "
    "'rebound_ratios.1=1.64 ± 0.02' --vary 'contacts.1.stiffness=0.7kN/m:2.5kN/m' --interval"
)
_PROBLEM: Any = {"rich_help_panel": "The problem"}
_SEARCH: Any = {"rich_help_panel": "The search and its results"}

What = Annotated[
    list[str],
    typer.Argument(
        metavar="SCENARIO|BALLS",
        help="A scenario file in TOML, which may also have what was measured, varied and tied; or "
        "balls of the catalogue, the lowest first; or a measurement of the paper, such as "
        "cross2007/B1-B2.",
        show_default=False,
    ),
]
_DATA = {
    "data": option(
        Path | None,
        "FILE",
        "A table, such as drops.csv: each row a drop of this stack, columns such as "
        "'height (cm)', 'gaps.0 (mm)', rebound_ratios.1 and 'error of rebound_ratios.1'.",
        readable=False,
        **_PROBLEM,
    ),
    "measured": option(
        list[str] | None,
        "NAME=VALUE",
        "What was measured, with its error: 'rebound_ratios.1=1.64 ± 0.02', "
        "'rebound_heights.0=12 ± 1 cm', 'first_touch.1=2.0 ± 0.5 ms', durations.0, last_release.0, "
        "rebound_speeds.0, energy_retained; collisions.0=2 and force.0=scope.csv have none; once "
        "per number. Balls and contacts count from 0, the lowest.",
        **_PROBLEM,
    ),
    "vary": option(
        list[str] | None,
        "PATH=BOUNDS",
        "What may change: 'gaps.0=0mm:5mm', or what is known of it, 'gaps.0=1.3 ± 0.9 mm', or "
        "its path alone; once per parameter.",
        **_PROBLEM,
    ),
    "tie": option(
        list[str] | None,
        "PATH=FORMULA",
        "A parameter that follows from others: 'contacts.1.stiffness=0.5*contacts.0.stiffness'; "
        "once per parameter.",
        **_PROBLEM,
    ),
}
Compare = Annotated[
    bool,
    typer.Option(
        "--compare",
        help=f"Fit the usual models ({', '.join(usual_laws())}) instead and lay them side by side; "
        "the search starts from the contacts and gaps of the drop.",
        **_SEARCH,
    ),
]
Interval = Annotated[
    bool,
    typer.Option(
        "--interval", help="Give confidence intervals of 68.3 %, often asymmetric.", **_SEARCH
    ),
]
Sample = Annotated[
    int | None,
    typer.Option(metavar="DRAWS", help="Take so many draws from the posterior.", **_SEARCH),
]
Starts = Annotated[
    int | None, typer.Option(metavar="COUNT", help="How many trials are screened first.", **_SEARCH)
]
Seed = Annotated[
    int, typer.Option(metavar="NUMBER", help="The seed of trials and draws.", **_SEARCH)
]
Corner = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE", readable=False, help="Draw the posterior of --sample: .svg, .png or .pdf."
    ),
]
Draws = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        readable=False,
        help="Write the draws of --sample as a table, for stackbounce sweep --draws: draws.csv; "
        "of several drops into a folder of that name, a file each.",
    ),
]
Save = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        readable=False,
        help="Write the fitted drop as a scenario for simulate: fitted.toml; several drops into a "
        "folder of that name, a file each.",
    ),
]


@add_options(_DATA | DROP)
def run(
    what: What,
    *,
    compare: Compare = False,
    interval: Interval = False,
    sample: Sample = None,
    starts: Starts = None,
    seed: Seed = 0,
    draws: Draws = None,
    save: Save = None,
    plot: Plot = None,
    corner: Corner = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Fit parameters of a drop to measured values, with errors."""
    need("fit", "stackbounce fit")
    from stackbounce.cli import fit_results
    from stackbounce.fitting import Interrupted

    check_picture(plot, overwrite)
    check_picture(corner, overwrite, "--corner")
    if corner is not None and sample is None:
        raise InvalidValue("--corner draws the posterior of --sample: give both")
    if draws is not None and sample is None:
        raise InvalidValue("--draws writes the draws of --sample: give both")
    single = {"interval": interval, "sample": sample, "save": save}
    for name, value in (given | single).items():
        if compare and value and name in ("vary", "tie", *single):
            raise InvalidValue(f"--compare has models of its own: --{name} is for one fit")
    problem = fit_results.read_problem(what, compared=compare, **given)
    if compare:
        _compare(problem, starts, seed, plot, overwrite, as_json)
        return
    fit_results.check_save(save, overwrite, problem, what)
    fit_results.check_save(draws, overwrite, problem, what, "--draws", ".csv")
    try:
        done = fit_results.run(problem, starts=starts, seed=seed, interval=interval, sample=sample)
    except Interrupted as stopped:
        if as_json:
            print_json({"interrupted": str(stopped), "values": stopped.fit.best})
        else:
            typer.echo(f"Interrupted: {stopped}")
        raise
    draw_picture(plot, overwrite, "fitted", done.fit)
    draw_picture(corner, overwrite, "corner", done.posterior)
    saved = fit_results.save(done, save, overwrite)
    drawn = fit_results.save_draws(done, draws, overwrite)
    if as_json:
        print_json(fit_results.as_dict(done, saved, drawn))
        return
    fit_results.print_fit(console(), done)
    if saved:
        typer.echo(f"Fitted: {save}; now: stackbounce simulate {saved[0]}")
    if drawn:
        typer.echo(f"Draws: {draws}; now: stackbounce sweep … --draws {drawn[0]}")
    print_files(plot, corner)


def _compare(
    problem: "FitProblem",
    starts: int | None,
    seed: int,
    plot: Path | None,
    overwrite: bool,
    as_json: bool,
) -> None:
    from stackbounce.cli import fit_results

    done = fit_results.compare_models(problem, starts=starts, seed=seed)
    draw_picture(plot, overwrite, "compared", done)
    if as_json:
        print_json(fit_results.comparison_as_dict(done))
        return
    fit_results.print_comparison(console(), done)
    print_files(plot)
