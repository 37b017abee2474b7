"""The command ``stackbounce app``: the explorer in the browser, as one file, or as a folder."""

import dataclasses
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from stackbounce.cli.output import print_json
from stackbounce.errors import InvalidValue, whole
from stackbounce.explorer.framing import frame_rule, read_origin
from stackbounce.version import __version__

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
    framed_by = [read_origin(origin) for origin in embed or ()]
    if export is not None:
        _write(export, framed_by, overwrite, as_json)
        return
    from stackbounce.explorer import LIMITS
    from stackbounce.explorer.serve import serve
    from stackbounce.extras import is_installed

    measures = is_installed("app")

    def tell(address: str, others: "list[Place]") -> None:
        if as_json:
            known = {"address": address, "others": [place.address for place in others]}
            print_json({"stackbounce": __version__, **known, "measures": measures})
            return
        typer.echo(f"The explorer: {address} (Ctrl+C ends it)")
        if not measures:
            typer.echo("It plays. To measure and fit in it: pip install 'stackbounce[app]'")
        if others:
            code = " (the page shows a QR code)" if measures else ""
            typed = " or ".join(place.address for place in others)
            typer.echo(f"For others on the same network: {typed}{code}")
        elif host in ("0.0.0.0", "::"):
            typer.echo("This machine is in no network: others cannot open the page.")

    by_default = min(max((os.cpu_count() or 1) // 2, 2), 4)
    count = by_default if workers is None else whole("--workers", workers, 1, 64)
    limits = dataclasses.replace(LIMITS, workers=count)
    serve(host, port, limits, browser=browser, tell=tell, framed_by=framed_by)


def _write(path: str, framed_by: list[str], overwrite: bool, as_json: bool) -> None:
    """Write the explorer as one file or as a folder, and tell its size and who may frame it."""
    from stackbounce.explorer.made import folder_files, one_file
    from stackbounce.files import check_place, prepare_folder, write_file, write_folder

    if not path:  # Path("") is the current folder
        raise InvalidValue("--export must name a file that ends in .html, or a folder, got ''")
    out = Path(path)
    if path.lower().endswith(".html"):
        kind, files = "file", {out.name: one_file().encode()}
        check_place(out)
        write_file(out, files[out.name], overwrite)
        size = out.stat().st_size  # with its seal
    else:
        kind, files = "folder", folder_files()
        prepare_folder(out, files, overwrite)
        write_folder(out, files, overwrite)
        size = sum(map(len, files.values()))
    header = f"Content-Security-Policy: {frame_rule(framed_by)}" if framed_by else None
    if as_json:
        known = {} if header is None else {"header": header}
        print_json({"stackbounce": __version__, kind: path, "bytes": size, **known})
        return
    count = "" if kind == "file" else f" in {len(files)} files"
    typer.echo(f"{path}: the explorer{count}, {size / 1e3:.0f} kB")
    if header is not None:
        typer.echo(
            "A browser takes the sites that may frame a page from the web server alone. "
            f"Let yours send this header with the page:\n{header}"
        )
