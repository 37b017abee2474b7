"""The command ``stackbounce app``: the explorer in the browser."""

import os
from pathlib import Path
from typing import Annotated

import typer

from stackbounce.cli.options import AsJson
from stackbounce.cli.output import json_text

__all__ = ["EPILOG", "run"]

EPILOG = "For a class: stackbounce app --host 0.0.0.0, or --export explorer.html, a file to mail"


def run(
    host: Annotated[
        str,
        typer.Option(
            metavar="ADDRESS",
            help="Where to listen: on this machine alone by default; 0.0.0.0 for a class.",
        ),
    ] = "127.0.0.1",
    port: Annotated[
        int | None,
        typer.Option(
            metavar="PORT",
            help="By default the first free one from 8050; 0 for any.",
            show_default=False,
        ),
    ] = None,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
    workers: Annotated[
        int | None,
        typer.Option(
            metavar="COUNT",
            help="Processes for short requests, and as many for long ones; by default half as many "
            "as cores, 2 to 4.",
            show_default=False,
        ),
    ] = None,
    export: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write the explorer as one HTML file, which needs no server and no network.",
            show_default=False,
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Open the explorer in the browser: the bounce in slow motion."""
    if export is not None:
        _export(export, as_json)
        return
    import dataclasses

    from stackbounce.errors import whole
    from stackbounce.version import __version__
    from stackbounce.web import LIMITS
    from stackbounce.web.serve import serve

    def tell(address: str) -> None:
        told = json_text({"stackbounce": __version__, "address": address})
        typer.echo(told if as_json else f"The explorer: {address} (Ctrl+C ends it)")

    by_default = min(max((os.cpu_count() or 1) // 2, 2), 4)
    count = by_default if workers is None else whole("--workers", workers, 1, 64)
    limits = dataclasses.replace(LIMITS, workers=count)
    serve(host, port, limits, browser=browser, tell=tell)


def _export(path: Path, as_json: bool) -> None:
    """Write the explorer as one file, and tell its size."""
    from stackbounce.files import check_place, write_file
    from stackbounce.version import __version__
    from stackbounce.web.page.one_file import one_file

    check_place(path)
    content = one_file().encode()
    write_file(path, content)
    told = json_text({"stackbounce": __version__, "file": str(path), "bytes": len(content)})
    typer.echo(told if as_json else f"{path}: the explorer, {len(content) / 1e3:.0f} kB")
