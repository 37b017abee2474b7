"""What ``stackbounce app --export`` writes: the explorer as one file, or as a folder."""

from pathlib import Path

import typer

from stackbounce.cli.output import print_json


def write(path: str, framed_by: list[str], overwrite: bool, as_json: bool) -> None:
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
    from stackbounce.explorer.page.one_file import one_file
    from stackbounce.files import check_own, check_place, write_file

    check_place(path)
    check_own(path, overwrite)
    write_file(path, one_file().encode(), overwrite)
    return [path.stat().st_size]


def _write_folder(folder: Path, overwrite: bool) -> list[int]:
    """Write the explorer as a folder of files; return their sizes."""
    from stackbounce.explorer.page.folder import folder_files
    from stackbounce.files import prepare_folder, write_folder

    files = folder_files()
    prepare_folder(folder, files, overwrite)
    write_folder(folder, files, overwrite)
    return [len(content) for content in files.values()]
