"""The options of ``stackbounce fit``."""

from pathlib import Path
from typing import Annotated, Any

import typer

from stackbounce.cli.options import RARE, ball_names, option
from stackbounce.model.laws import usual_laws

_PROBLEM: Any = {"rich_help_panel": "The problem"}
_SEARCH: Any = {"rich_help_panel": "The search and its results"}
_RARE: Any = {"rich_help_panel": RARE}

What = Annotated[
    list[str],
    typer.Argument(
        metavar="SCENARIO|BALLS",
        help="A scenario file in TOML, which may also have what was measured, varied and tied; or "
        "balls of the catalogue, the lowest first; or a measurement of the paper, such as "
        "cross2007/B1-B2.",
        show_default=False,
        autocompletion=ball_names,
    ),
]
QUESTION = {
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
"""The options that are parts of the problem, as `build_problem` takes them."""

RESULTS = {
    "compare": option(
        bool,
        None,
        f"Fit the usual models ({', '.join(usual_laws())}) instead and lay them side by side; "
        "the search starts from the contacts and gaps of the drop.",
        "--compare",
        default=False,
        **_SEARCH,
    ),
    "interval": option(
        bool,
        None,
        "Give confidence intervals of 68.3 %, often asymmetric.",
        "--interval",
        default=False,
        **_SEARCH,
    ),
    "sample": option(
        int | None, "DRAWS", "Take so many draws from the posterior.", "--sample", **_SEARCH
    ),
    "starts": option(int | None, "COUNT", "How many trials are screened first.", **_RARE),
    "seed": option(int, "NUMBER", "The seed of trials and draws.", default=0, **_RARE),
    "draws": option(
        Path | None,
        "FILE",
        "Write the draws of --sample as a table, for stackbounce sweep --draws: draws.csv; "
        "of several drops into a folder of that name, a file each.",
        readable=False,
        **_RARE,
    ),
    "save": option(
        Path | None,
        "FILE",
        "Write the fitted drop as a scenario for simulate: fitted.toml; several drops into a "
        "folder of that name, a file each.",
        readable=False,
    ),
    "corner": option(
        Path | None,
        "FILE",
        "Draw the posterior of --sample: .svg, .png or .pdf.",
        readable=False,
        **_RARE,
    ),
}
"""The options of the search and of what it writes."""
