"""Sphinx extension: notebooks show what each cell ends with, pictures once, and nothing else."""

from pathlib import Path
from typing import Any

from nbformat import NO_CONVERT, read
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError


def setup(app: Sphinx) -> dict[str, Any]:
    """Check the notebooks once they have run, and the pages are written."""
    app.connect("build-finished", _check)
    return {"version": "1", "parallel_read_safe": True}


def _check(app: Sphinx, exception: Exception | None) -> None:
    if exception is not None or app.builder.format != "html":
        return
    for path in sorted((Path(app.srcdir) / "notebooks").glob("*.md")):
        run = Path(app.outdir).parent / "jupyter_execute" / "notebooks" / f"{path.stem}.ipynb"
        cells = [cell for cell in read(run, NO_CONVERT).cells if cell.cell_type == "code"]
        kinds = {output.output_type for cell in cells for output in cell.outputs}
        pictures = [cell.outputs for cell in cells if "\nsb.plots." in f"\n{cell.source}"]
        is_shown = all(len(own) == 1 and "image/png" in own[0].data for own in pictures)
        if kinds != {"execute_result"} or not pictures or not is_shown:
            raise ExtensionError(
                f"{path.name}: its cells must show nothing but what they end with, got "
                f"{', '.join(sorted(kinds))}, and at least one a picture, once"
            )
