"""The command ``stackbounce sweep``: solve a grid of drops into a file, and summarise it."""

import contextlib
import logging
import socket
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stackbounce.cli.options import (
    DROP,
    AsJson,
    Overwrite,
    Plot,
    Tolerance,
    Until,
    What,
    add_options,
)
from stackbounce.cli.output import (
    check_picture,
    check_solved,
    console,
    draw_picture,
    print_files,
    print_json,
    progress_bar,
)
from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.extras import need
from stackbounce.files import check_place

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

    from stackbounce.model import Drop

__all__ = ["EPILOG", "run"]

EPILOG = (
    "For example: stackbounce sweep basketball tennis --over balls.0.mass=50g:500g:100:log "
    "--over gaps.0=0mm:5mm:50 --out map.zarr --plot map.png"
)
_BLOCK = 2**18  # drops that are summarised together
_SPOKEN = ("rebound_ratio", "collisions", "energy_retained")


@add_options(DROP)
def run(
    what: What,
    *,
    over: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=VALUES",
            help="A parameter that varies: balls.0.mass=50g:500g:40 (start, stop, how many), "
            "contacts.0.stiffness=1kN/m:1MN/m:40:log (logarithmic spacing) or gaps.0=0mm,1mm,5mm; "
            "once per parameter. Balls, contacts and gaps count from 0, the lowest.",
            show_default=False,
        ),
    ] = None,
    draws: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            readable=False,
            help="A table whose rows are a drop each, such as fit --draws writes: its columns are "
            "numbers of the drop that vary together, gaps.0 (mm). 300 rows are 300 drops.",
        ),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            metavar="FILE",
            readable=False,
            help="Zarr store to write all results to, such as map.zarr. Stopped, the same command "
            "goes on where it was.",
            show_default=False,
        ),
    ],
    until: Until = None,
    rtol: Tolerance = 1e-12,
    cluster: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Solve on this cluster: its dask scheduler."),
    ] = None,
    show: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="What --plot draws: rebound_ratio, collisions, energy_retained, first_touch or "
            "last_release; of one ball or contact with its number, such as rebound_ratio.0.",
        ),
    ] = "rebound_ratio",
    plot: Plot = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    **given: Any,
) -> None:
    """Drop a stack for all combinations of other numbers in it, into a Zarr store."""
    from stackbounce.cli import scenario

    check_picture(plot, overwrite)
    check_place(out)
    drop = scenario.read(what, **given).drop
    end = scenario.read_until(until)
    values = _values(drop, over or [], draws)
    if plot is not None:
        _check_shown(drop, over or [], show, draws)
    done = _write(drop, values, out, cluster=cluster, until=end, rtol=rtol)
    if plot is not None:
        _draw(done.load(), show, plot, overwrite)
    found = summary(done, out)
    if as_json:
        print_json(found)
    else:
        print_sweep(console(), done, found)
        print_files(plot)
    check_solved(found["status"])


def _values(drop: "Drop", over: Sequence[str], draws: Path | None) -> dict[str, Any]:
    """Return the numbers that vary: those of ``--over``, and those of ``--draws``, together."""
    from stackbounce.cli.draws import read_draws
    from stackbounce.sweeps import grid

    if not over and draws is None:
        raise InvalidValue("nothing is to vary: give --over PATH=VALUES or --draws FILE")
    values, drawn = grid(drop, over), {} if draws is None else read_draws(drop, draws)
    for path in values.keys() & drawn.keys():
        raise InvalidValue(f"{path} is in --over and in --draws: only one of the two can have it")
    return {**drawn, **values}


def _write(
    drop: "Drop", values: Mapping[str, Any], out: Path, *, cluster: str | None, **options: Any
) -> "xr.Dataset":
    """Sweep a drop over values into a file with a progress bar; return it."""
    from stackbounce.sweeps import opened, write

    with _client(cluster) as client, progress_bar("drops") as progress:
        write(out, drop, values, client=client, progress=progress, **options)
    return opened(out)


def _check_shown(drop: "Drop", over: Sequence[str], show: str, draws: Path | None) -> None:
    """Refuse a picture that could not be drawn, before anything is computed."""
    from stackbounce.plots.sweep_curves import TITLES

    if draws is not None:
        raise InvalidValue("--plot draws over the numbers of --over, and has no picture of --draws")
    if len(over) not in (1, 2):
        raise InvalidValue(f"--plot needs one or two parameters that vary, got {len(over)}")
    name, dot, which = show.partition(".")
    if name not in TITLES:
        raise InvalidValue(f"--show must name a result, got {shown(name)}; {nearest(name, TITLES)}")
    most = len(drop.balls) - 1
    if dot and name == "energy_retained":
        raise InvalidValue(f"--show {name} is of the whole stack, got {shown(show)}")
    if dot and which not in map(str, range(most + 1)):
        raise InvalidValue(
            f"--show {name}. must end in a ball or contact from 0 to {most}, got {shown(show)}"
        )


def _draw(data: "xr.Dataset", show: str, path: Path, overwrite: bool) -> None:
    """Draw the lines or the map of a sweep over one number or two."""
    name, dot, which = show.partition(".")
    kind = "lines" if len(data.status.dims) == 1 else "heatmap"
    index = {"index": int(which)} if dot else {}
    draw_picture(path, overwrite, kind, data, name, **index)


def summary(data: "xr.Dataset", out: Path) -> dict[str, Any]:
    """Return the summary of a sweep for --json, read in blocks as it may exceed the memory."""
    import numpy as np

    from stackbounce.run.blocks import blocks, sides
    from stackbounce.run.result import Status

    dims, shape = data.status.dims, data.status.shape
    counts = np.zeros(max(Status) + 1, dtype=int)
    low: dict[str, Any] = dict.fromkeys(_SPOKEN, np.nan)
    high = low.copy()
    for block in blocks(shape, sides(shape, _BLOCK)):
        part = data.isel(dict(zip(dims, block, strict=True)))
        counts += np.bincount(part.status.values.ravel(), minlength=len(counts))
        for name in _SPOKEN:
            values = part[name].values
            rows = values.reshape(-1, *values.shape[len(dims) :])
            low[name] = np.fmin(low[name], np.fmin.reduce(rows))
            high[name] = np.fmax(high[name], np.fmax.reduce(rows))
    return {
        "store": str(out),
        "drops": data.status.size,
        "over": {str(dim): data.sizes[dim] for dim in dims},
        "status": {status.name: int(counts[status]) for status in Status if counts[status]},
        "ranges": {
            name: _ranges(data[name].dims[len(dims) :], low[name], high[name]) for name in _SPOKEN
        },
    }


def print_sweep(console: "Console", data: "xr.Dataset", found: dict[str, Any]) -> None:
    """Print the summary of a sweep."""
    from stackbounce.run.result import Status

    console.print(f"{found['drops']} drops, over")
    for dim, size in found["over"].items():
        if dim in data.coords:
            console.print(f"  {dim}: {size}, {_span(data[dim])}")
            continue
        console.print(f"  {dim}: {size}, each with its own")
        for path, one in data.coords.items():
            if one.dims == (dim,):
                console.print(f"    {path}: {_span(one)}")
    for name, ranges in found["ranges"].items():
        for part, (low, high) in ranges.items():
            console.print(f"  {name} {part}".rstrip() + f": {_range(low, high)}")
    for name, count in found["status"].items():
        console.print(f"  {count} {name}: {Status[name].advice}")
    console.print(f"Written: {found['store']}")


def _span(axis: "xr.DataArray") -> str:
    """Return the smallest and the largest value of a number that varies, with its unit."""
    return f"{_range(axis.values.min(), axis.values.max())} {axis.attrs.get('units', '')}".rstrip()


def _range(low: float, high: float) -> str:
    one, other = f"{low:.6g}", f"{high:.6g}"
    return one if one == other else f"{one} to {other}"


def _ranges(own: Sequence[Any], low: Any, high: Any) -> dict[str, tuple[float, float]]:
    """Return smallest and largest values by ball or contact; `own` is that dimension, if any."""
    import numpy as np

    pairs = zip(np.atleast_1d(low).tolist(), np.atleast_1d(high).tolist(), strict=True)
    return {f"{own[0]} {k}" if own else "": pair for k, pair in enumerate(pairs)}


@contextlib.contextmanager
def _client(address: str | None) -> Iterator[Any]:
    """Connect to a cluster, if any."""
    if address is None:
        yield None
        return
    need("cluster", "--cluster")
    import distributed

    for name in ("distributed", "distributed.client"):  # our own error says it in one line
        logging.getLogger(name).setLevel(logging.CRITICAL)
    wrong = f"--cluster must be the address of a dask scheduler, got {shown(address)}"
    connect: Any = distributed.Client
    try:
        _check_listening(address)
        client = connect(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InvalidValue(wrong) from error
    with client:
        yield client


def _check_listening(address: str) -> None:
    """Raise OSError or ValueError if nothing listens there; dask would retry for a long time."""
    host, _, port = address.rpartition("://")[2].rpartition(":")
    with socket.create_connection((host, int(port)), timeout=5.0):
        pass
