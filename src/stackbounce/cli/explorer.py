"""The command ``stackbounce app``: the explorer in the browser."""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

from stackbounce.cli.output import print_json

if TYPE_CHECKING:
    from stackbounce.explorer.addresses import Place


def run(
    host: str,
    port: int | None,
    browser: bool,
    workers: int | None,
    export: str | None,
    embed: Sequence[str] | None,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Open the explorer in the browser: the bounce in slow motion."""
    from stackbounce.explorer.framing import read_origin

    framed_by = [read_origin(origin) for origin in embed or ()]
    if export is not None:
        from stackbounce.cli.explorer_export import write

        write(export, framed_by, overwrite, as_json)
        return
    import dataclasses

    from stackbounce.errors import whole
    from stackbounce.explorer import LIMITS
    from stackbounce.explorer.serve import serve
    from stackbounce.version import __version__

    def tell(address: str, others: "list[Place]") -> None:
        if as_json:
            known = {"address": address, "others": [place.address for place in others]}
            print_json({"stackbounce": __version__, **known})
            return
        typer.echo(f"The explorer: {address} (Ctrl+C ends it)")
        if others or host in ("0.0.0.0", "::"):
            _tell_others(others)

    by_default = min(max((os.cpu_count() or 1) // 2, 2), 4)
    count = by_default if workers is None else whole("--workers", workers, 1, 64)
    limits = dataclasses.replace(LIMITS, workers=count)
    serve(host, port, limits, browser=browser, tell=tell, framed_by=framed_by)


def _tell_others(others: "list[Place]") -> None:
    """Print the addresses that a class can type, and the first one as a QR code."""
    import sys

    from stackbounce.explorer.addresses import code_text

    if not others:
        typer.echo("This machine is in no network: others cannot open the page.")
        return
    typer.echo(f"For others on the same network: {' or '.join(place.address for place in others)}")
    lines = code_text(others[0].address).splitlines()
    try:
        lines[0].encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:  # a terminal that cannot show it
        return
    width = len(lines[0])
    for line in lines:
        typer.secho(line.ljust(width), fg="bright_white", bg="black")
