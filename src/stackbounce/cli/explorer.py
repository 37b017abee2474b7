"""The command ``stackbounce app``: the explorer in the browser, as one file, or as a folder."""

import os
from collections.abc import Sequence
from pathlib import Path
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
        _write(export, framed_by, overwrite, as_json)
        return
    import dataclasses

    from stackbounce.errors import whole
    from stackbounce.explorer import LIMITS
    from stackbounce.explorer.serve import serve
    from stackbounce.extras import is_installed
    from stackbounce.version import __version__

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
    from stackbounce.errors import InvalidValue
    from stackbounce.explorer.framing import frame_rule
    from stackbounce.version import __version__

    if not path:  # Path("") is the current folder
        raise InvalidValue("--export must name a file that ends in .html, or a folder, got ''")
    is_file = path.lower().endswith(".html")
    sizes = (_write_file if is_file else _write_folder)(Path(path), overwrite)
    size = sum(sizes)
    kind = "file" if is_file else "folder"
    header = f"Content-Security-Policy: {frame_rule(framed_by)}" if framed_by else None
    if as_json:
        known = {} if header is None else {"header": header}
        print_json({"stackbounce": __version__, kind: path, "bytes": size, **known})
        return
    files = "" if is_file else f" in {len(sizes)} files"
    typer.echo(f"{path}: the explorer{files}, {size / 1e3:.0f} kB")
    if header is not None:
        typer.echo(
            "A browser takes the sites that may frame a page from the web server alone. "
            f"Let yours send this header with the page:\n{header}"
        )


def _write_file(path: Path, overwrite: bool) -> list[int]:
    """Write the explorer as one file; return its size."""
    from stackbounce.explorer.made import one_file
    from stackbounce.files import check_own, check_place, write_file

    check_place(path)
    check_own(path, overwrite)
    write_file(path, one_file().encode(), overwrite)
    return [path.stat().st_size]


def _write_folder(folder: Path, overwrite: bool) -> list[int]:
    """Write the explorer as a folder of files; return their sizes."""
    from stackbounce.explorer.made import folder_files
    from stackbounce.files import prepare_folder, write_folder

    files = folder_files()
    prepare_folder(folder, files, overwrite)
    write_folder(folder, files, overwrite)
    return [len(content) for content in files.values()]
