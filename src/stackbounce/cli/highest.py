"""The command ``stackbounce highest``: the stack that throws its top ball highest."""

import math
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from stackbounce.cli import output
from stackbounce.errors import InvalidValue, positive, shown
from stackbounce.files import write_file
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.units import quantity


def run(
    what: Sequence[str] | None,
    save: Path | None,
    plot: Path | None,
    overwrite: bool,
    as_json: bool,
    **given: Any,
) -> None:
    """Find which balls, order, gaps and masses throw the top ball of a stack highest."""
    from stackbounce import highest
    from stackbounce.cli.scenario import is_file, read
    from stackbounce.cli.stack_tables import print_stacks, summary
    from stackbounce.run.result import Status

    what = what or []
    output.check_picture(plot, overwrite)
    output.check_file(save, overwrite, "--save", (".toml",), what)
    within, fall = given["within"], {name: given[name] for name in ("height", "speed", "contact")}
    chosen: dict[str, Any] = {"masses": _limits(within) if within else given["masses"]}
    if given["gap"]:
        chosen["gaps"] = [quantity(text, "m", "--gap") for text in given["gap"]]
    if given["in_order"] or given["contact"] or (len(what) == 1 and is_file(what[0])):
        chosen["balls"] = read(what, **fall).drop
    else:
        named = [Drop.from_toml(name) if is_file(name) else name for name in what]
        chosen |= {"balls": named or None, "count": given["balls"], "repeat": given["repeat"]}
        chosen["law"] = given["law"]
        chosen["impact_speed"] = _impact_speed(given["height"], given["speed"])
    data = highest(**chosen)
    if save is not None:
        write_file(save, data.attrs["best"].encode(), overwrite)
    output.draw_picture(plot, overwrite, "highest", data)
    if as_json:
        output.print_json(summary(data))
    else:
        print_stacks(output.console(), data, given["rows"])
        output.print_files(plot, best=save)
    output.check_solved(Counter(Status(status).name for status in data["status"].values.ravel()))


def _limits(text: str) -> tuple[float, ...]:
    """Return the smallest and the largest mass in kg of ``--within``."""
    ends = text.split(":")
    if len(ends) != 2:
        raise InvalidValue(f"--within must be MASS:MASS, such as 10g:1kg, got {shown(text)}")
    return tuple(quantity(end, "kg", "--within") for end in ends)


def _impact_speed(height: str | None, speed: str | None) -> float | None:
    """Return the impact speed in m/s of ``--height`` or ``--speed``."""
    from stackbounce.cli.drop_options import read_fall

    fall = read_fall(height, speed)
    if "height" in fall:
        return math.sqrt(2.0 * STANDARD_GRAVITY * positive("--height", fall["height"], "metres"))
    return fall.get("impact_speed")
