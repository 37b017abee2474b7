"""Sphinx extension: the explorer as one file among the pages, which docs/app.md shows."""

from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

NAME = "explorer.html"


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the file once the pages are written."""
    app.connect("build-finished", _write)
    return {"version": "1", "parallel_read_safe": True}


def _write(app: Sphinx, exception: Exception | None) -> None:
    from stackbounce.web.page.one_file import one_file

    if exception is None and app.builder.format == "html":
        (Path(app.outdir) / NAME).write_text(one_file(), "utf-8")
