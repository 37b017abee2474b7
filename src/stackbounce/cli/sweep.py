"""The command ``stackbounce sweep``: solve a grid of drops into a file, and summarise it."""

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stackbounce.cli import output
from stackbounce.cli.options import DROP
from stackbounce.errors import InvalidValue, one_of, shown
from stackbounce.extras import need
from stackbounce.files import check_place

if TYPE_CHECKING:
    from stackbounce.model import Drop


def run(
    what: Sequence[str],
    out: Path,
    until: str | None,
    rtol: float,
    plot: Path | None,
    overwrite: bool,
    as_json: bool,
    **given: Any,
) -> None:
    """Drop a stack for all combinations of other numbers in it, into a Zarr store."""
    from stackbounce.cli import scenario
    from stackbounce.cli.drop_options import read_until
    from stackbounce.cli.sweep_tables import print_sweep, summary
    from stackbounce.sweeps import opened, write

    output.check_picture(plot, overwrite)
    check_place(out)
    drop = scenario.read(what, **{name: given[name] for name in DROP}).drop
    end = read_until(until)
    values = _values(drop, given["over"] or [], given["draws"])
    if plot is not None:
        _check_shown(drop, given)
    elif given["show"] != "rebound_ratio":  # which is the default
        raise InvalidValue("--show tells what --plot draws, which is not given")
    with _connect(given["cluster"]) as client, output.progress_bar("drops") as progress:
        write(out, drop, values, client=client, progress=progress, until=end, rtol=rtol)
    done = opened(out)
    if plot is not None:
        name, dot, which = given["show"].partition(".")
        kind = "lines" if len(done.status.dims) == 1 else "heatmap"
        index = {"index": int(which)} if dot else {}
        output.draw_picture(plot, overwrite, kind, done.load(), name, **index)
    found = summary(done, out)
    if as_json:
        output.print_json(found)
    else:
        print_sweep(output.console(), done, found)
        output.print_files(plot)
    output.check_solved(found["status"])


def _values(drop: "Drop", over: Sequence[str], draws: Path | None) -> dict[str, Any]:
    """Return the numbers that vary: those of ``--over``, and those of ``--draws``, together."""
    from stackbounce.sweeps import grid
    from stackbounce.sweeps.draws import read_draws

    if not over and draws is None:
        raise InvalidValue("nothing is to vary: give --over PATH=VALUES or --draws FILE")
    values, drawn = grid(drop, over), {} if draws is None else read_draws(drop, draws)
    for path in values.keys() & drawn.keys():
        raise InvalidValue(f"{path} is in --over and in --draws: only one of the two can have it")
    return {**drawn, **values}


def _check_shown(drop: "Drop", given: Mapping[str, Any]) -> None:
    """Refuse a picture that could not be drawn, before anything is computed."""
    from stackbounce.plots.sweep_curves import SHOWN

    over, show = given["over"] or [], given["show"]
    if given["draws"] is not None:
        raise InvalidValue("--plot draws over the numbers of --over, and has no picture of --draws")
    if len(over) not in (1, 2):
        raise InvalidValue(f"--plot needs one or two parameters that vary, got {len(over)}")
    name, dot, which = show.partition(".")
    one_of(name, SHOWN, f"--show must name a result, got {shown(name)}")
    most = len(drop.balls) - 1
    if dot and name == "energy_retained":
        raise InvalidValue(f"--show {name} is of the whole stack, got {shown(show)}")
    if dot and which not in map(str, range(most + 1)):
        raise InvalidValue(
            f"--show {name}. must end in a ball or contact from 0 to {most}, got {shown(show)}"
        )


@contextlib.contextmanager
def _connect(address: str | None) -> Iterator[Any]:
    """Connect to a cluster, if any."""
    if address is None:
        yield None
        return
    need("--cluster", "distributed")
    import logging
    import socket

    import distributed

    for name in ("distributed", "distributed.client"):  # our own error says it in one line
        logging.getLogger(name).setLevel(logging.CRITICAL)
    wrong = f"--cluster must be the address of a dask scheduler, got {shown(address)}"
    client_of: Any = distributed.Client
    try:
        host, _, port = address.rpartition("://")[2].rpartition(":")
        socket.create_connection((host, int(port)), timeout=5.0).close()  # dask would try for long
        client = client_of(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InvalidValue(wrong) from error
    with client:
        yield client
